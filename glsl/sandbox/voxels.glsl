/* The scene as voxels, for user shaders. Lengths and positions are those of normalised space unless stated
 * otherwise. */
#ifndef LSF_SANDBOX_VOXELS
#define LSF_SANDBOX_VOXELS

#include "lib/voxel_trace.glsl"

layout(binding = LSF_UNIT_VOXEL_ALBEDO) uniform usampler3D sandbox_voxel_albedo;
layout(binding = LSF_UNIT_VOXEL_NORMAL) uniform usampler3D sandbox_voxel_normal;

ivec3 lsf_voxel_size()
{
    return ivec3(grid.size.xyz);
}

vec3 lsf_voxel_from(vec3 position)
{
    return voxel_from_position(position);
}

vec3 lsf_voxel_to(vec3 voxel)
{
    return voxel_to_position(voxel);
}

bool lsf_voxel_occupied(ivec3 cell)
{
    return voxel_inside(cell) && voxel_occupied(cell);
}

bool lsf_voxel_trace(vec3 position, vec3 direction, float end, out ivec3 cell, out float distance)
{
    voxel_ray ray;
    bool met = voxel_ray_begin(voxel_from_position(position), direction, ray) &&
               voxel_ray_trace(ray, end * grid.size.w);
    cell = ray.cell;
    distance = ray.distance * grid.origin.w;
    return met;
}

/* A plane of unit normal n touches cells up to |n|_1 of a cell above it; curved surfaces touch a little more. */
vec3 lsf_voxel_leave(vec3 position, vec3 normal)
{
    vec3 tilt = abs(normal);
    return position + normal * ((tilt.x + tilt.y + tilt.z + 0.5) * grid.origin.w);
}

vec3 lsf_voxel_albedo(ivec3 cell)
{
    return voxel_albedo_unpack(texelFetch(sandbox_voxel_albedo, cell, 0).r);
}

vec3 lsf_voxel_normal(ivec3 cell)
{
    return voxel_normal_unpack(texelFetch(sandbox_voxel_normal, cell, 0).r);
}

#endif
