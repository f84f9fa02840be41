/* Rays that start above one surface in the grid, and may end above another. Both ends are as far above
 * their own surface as a voxel reaches (voxel_lift), so that occupied voxels there belong to other surfaces,
 * which join it in a corner or pass close by. Of these a ray is let through those whose surface it moves
 * away from, seen from that end, up to the first empty cell. */
#ifndef LSF_LIB_VOXEL_SIGHT
#define LSF_LIB_VOXEL_SIGHT

#include "lib/voxel_trace.glsl"

layout(binding = LSF_UNIT_VOXEL_POINT) uniform usampler3D voxel_point;
layout(binding = LSF_UNIT_VOXEL_NORMAL) uniform usampler3D voxel_normal;

/* A voxel that touches a plane with the unit normal n reaches |n_x| + |n_y| + |n_z| above it at most. */
vec3 voxel_lift(vec3 n)
{
    return (abs(n.x) + abs(n.y) + abs(n.z)) * n;
}

/* Whether the surface in the cell is ahead of a ray. */
bool voxel_ahead(ivec3 cell, vec3 origin, vec3 direction)
{
    vec3 n = voxel_normal_unpack(texelFetch(voxel_normal, cell, 0).r);
    vec3 q = vec3(cell) + voxel_point_unpack(texelFetch(voxel_point, cell, 0).r);
    return dot(n, q - origin) * dot(n, direction) > 0.0;
}

/* Takes the ray out of the voxels that it starts in. False: it leaves the grid. */
bool voxel_leave_start(inout voxel_ray ray)
{
    int steps = voxel_ray_steps();
    for (int i = 0; i < steps && voxel_occupied(ray.cell); i++) {
        if (voxel_ahead(ray.cell, ray.origin, ray.direction))
            return true;
        voxel_ray_step(ray, ray.cell, ivec3(1));
        if (!voxel_inside(ray.cell))
            return false;
    }
    return true;
}

/* Whether voxels leave the way free from one point of surface to another [voxels], with these unit normals.
 * Where the lifted ends have passed each other, the grid cannot tell what is between them. */
bool voxel_sees(vec3 from, vec3 from_normal, vec3 to, vec3 to_normal)
{
    vec3 start = from + voxel_lift(from_normal), end = to + voxel_lift(to_normal);
    vec3 span = end - start;
    float far = length(span);
    voxel_ray ray;
    if (dot(span, to - from) <= 0.0 || !voxel_ray_begin(start, span / far, ray) ||
        !voxel_leave_start(ray) || !voxel_ray_trace(ray, far))
        return true;
    /* The way back from the end leaves all voxels that there are from here on. */
    int steps = voxel_ray_steps();
    for (int i = 0; i < steps && ray.distance < far; i++) {
        if (!voxel_occupied(ray.cell) || voxel_ahead(ray.cell, end, -ray.direction))
            return false;
        voxel_ray_step(ray, ray.cell, ivec3(1));
        if (!voxel_inside(ray.cell))
            return true;
    }
    return true;
}

#endif
