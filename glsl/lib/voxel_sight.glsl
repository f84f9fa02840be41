/* Rays between surfaces in the grid. They start, and end, as far above a surface as a voxel of it reaches
 * (voxel_lift), so that occupied voxels at the start belong to other surfaces, which join it in a corner or
 * pass close by. */
#ifndef LSF_LIB_VOXEL_SIGHT
#define LSF_LIB_VOXEL_SIGHT

#include "lib/voxel_trace.glsl"

layout(binding = LSF_UNIT_VOXEL_POINT) uniform usampler3D voxel_point;
layout(binding = LSF_UNIT_VOXEL_NORMAL) uniform usampler3D voxel_normal; /* r: of the plane */

/* How far a voxel's plane may be from its surface [voxels]: places are kept to 2^-11, normals to about
 * 2^-11 in direction, over three voxels at most. */
#define VOXEL_PLANE (1.0 / 256.0)

/* A voxel that touches a plane with the unit normal n reaches |n_x| + |n_y| + |n_z| above it at most. */
vec3 voxel_lift(vec3 n)
{
    return (abs(n.x) + abs(n.y) + abs(n.z)) * n;
}

/* Height of the ray's origin above the surface in the cell, and how fast the ray rises above it. */
vec2 voxel_height(ivec3 cell, voxel_ray ray)
{
    vec3 n = voxel_normal_unpack(texelFetch(voxel_normal, cell, 0).r);
    vec3 q = vec3(cell) + voxel_point_unpack(texelFetch(voxel_point, cell, 0).r);
    return vec2(dot(n, ray.origin - q), dot(n, ray.direction));
}

/* Takes the ray out of the voxels that it starts in, but for one whose surface lies ahead. False: it leaves
 * the grid. */
bool voxel_leave_start(inout voxel_ray ray)
{
    int steps = voxel_ray_steps();
    for (int i = 0; i < steps && voxel_occupied(ray.cell); i++) {
        vec2 height = voxel_height(ray.cell, ray);
        if (height.x * height.y < 0.0)
            return true;
        voxel_ray_step(ray, ray.cell, ivec3(1));
        if (!voxel_inside(ray.cell))
            return false;
    }
    return true;
}

/* Whether heights at two distances along a ray are on both sides of a plane, or on it. */
bool voxel_crossed(vec2 height, float first, float last)
{
    float before = height.x + first * height.y, after = height.x + last * height.y;
    return min(abs(before), abs(after)) < VOXEL_PLANE || before * after < 0.0;
}

/* Below this cosine between the normals of two voxels beside each other surfaces meet in an edge. */
#define VOXEL_EDGE 0.7

/* Whether the ray, between two distances within a cell, crosses the surface there. Where surfaces meet or bend,
 * either has won the voxel, and those of the six cells about it count, too, as far as they are known to be on the
 * side of the cell's own plane that the ray is on: round an edge they are not. `corners`: an edge that is on the
 * ray's side, as those of a room are from within, is closed, whatever the ray crosses: where three surfaces
 * meet, none of the seven voxels may hold the third. */
bool voxel_blocks(ivec3 cell, voxel_ray ray, float first, float last, bool corners)
{
    vec3 n = voxel_normal_unpack(texelFetch(voxel_normal, cell, 0).r);
    vec3 q = vec3(cell) + voxel_point_unpack(texelFetch(voxel_point, cell, 0).r);
    vec2 own = vec2(dot(n, ray.origin - q), dot(n, ray.direction));
    if (voxel_crossed(own, first, last))
        return true;
    float ray_side = own.x + first * own.y;
    for (int side = 0; side < 6; side++) {
        ivec3 beside = cell;
        beside[side >> 1] += 2 * (side & 1) - 1;
        if (!voxel_inside(beside) || !voxel_occupied(beside))
            continue;
        vec3 beside_n = voxel_normal_unpack(texelFetch(voxel_normal, beside, 0).r);
        vec3 beside_q = vec3(beside) + voxel_point_unpack(texelFetch(voxel_point, beside, 0).r);
        float beside_side = dot(n, beside_q - q);
        if (abs(beside_side) >= VOXEL_PLANE && ray_side * beside_side <= 0.0)
            continue;
        vec2 height = vec2(dot(beside_n, ray.origin - beside_q), dot(beside_n, ray.direction));
        if ((corners && abs(dot(n, beside_n)) < VOXEL_EDGE) || voxel_crossed(height, first, last))
            return true;
    }
    return false;
}

/* On to the first surface that the ray crosses before `end`, in the voxel `met`; the ray is then beyond that.
 * False: there is none. `corners` as above. */
bool voxel_ray_meet(inout voxel_ray ray, float end, bool corners, out ivec3 met)
{
    int steps = voxel_ray_steps();
    for (int i = 0; i < steps && voxel_ray_trace(ray, end); i++) {
        float entry = ray.distance;
        met = ray.cell;
        voxel_ray_step(ray, met, ivec3(1));
        if (voxel_blocks(met, ray, entry, min(ray.distance, end), corners))
            return true;
        if (!voxel_inside(ray.cell))
            return false;
    }
    return false;
}

/* Whether one point of surface sees another [voxels]; with their unit normals. Where the lifted ends have
 * passed each other, the grid cannot tell what is between. */
bool voxel_sees(vec3 from, vec3 from_normal, vec3 to, vec3 to_normal)
{
    vec3 start = from + voxel_lift(from_normal);
    vec3 span = to + voxel_lift(to_normal) - start;
    float end = length(span);
    voxel_ray ray;
    if (dot(span, to - from) <= 0.0 || !voxel_ray_begin(start, span / end, ray))
        return true;
    ivec3 met;
    return !voxel_ray_meet(ray, end, false, met);
}

#endif
