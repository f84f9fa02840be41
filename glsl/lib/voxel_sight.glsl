/* Rays between surfaces in the grid. They start and end as far above a surface as its voxels reach (voxel_lift),
 * so that occupied voxels at the start belong to other surfaces, which meet it in a corner or pass close by. */
#ifndef LSF_LIB_VOXEL_SIGHT
#define LSF_LIB_VOXEL_SIGHT

#include "lib/voxel_trace.glsl"

layout(binding = LSF_UNIT_VOXEL_POINT) uniform usampler3D voxel_point;
layout(binding = LSF_UNIT_VOXEL_NORMAL) uniform usampler3D voxel_normal;

/* Height above the plane of a voxel that touches a plane with the unit normal n: at most |n_x| + |n_y| + |n_z|. */
vec3 voxel_lift(vec3 n)
{
    return (abs(n.x) + abs(n.y) + abs(n.z)) * n;
}

/* Height of the ray's origin above the surface in the cell, and the rate at which the ray rises above it. */
vec2 voxel_height(ivec3 cell, voxel_ray ray)
{
    vec3 n = voxel_normal_unpack(texelFetch(voxel_normal, cell, 0).r);
    vec3 q = vec3(cell) + voxel_point_unpack(texelFetch(voxel_point, cell, 0).r);
    return vec2(dot(n, ray.origin - q), dot(n, ray.direction));
}

/* Moves the ray out of the voxels in which it starts, except one whose surface lies ahead. False: it leaves the
 * grid. */
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

/* The same for a ray that starts on the surface of the medium through which it runs: it leaves the voxels in which
 * it starts, except one through which it exits the medium ahead, whose normal points along it. */
bool voxel_leave_inside(inout voxel_ray ray)
{
    int steps = voxel_ray_steps();
    for (int i = 0; i < steps && voxel_occupied(ray.cell); i++) {
        vec2 height = voxel_height(ray.cell, ray);
        if (height.y > 0.0 && height.x < 0.0)
            return true;
        voxel_ray_step(ray, ray.cell, ivec3(1));
        if (!voxel_inside(ray.cell))
            return false;
    }
    return true;
}

/* Whether the heights at two distances along a ray lie on both sides of a plane, or on it. */
bool voxel_crossed(vec2 height, float first, float last)
{
    float before = height.x + first * height.y, after = height.x + last * height.y;
    return min(abs(before), abs(after)) < VOXEL_PLANE || before * after < 0.0;
}

/* Advances to the first surface that the ray crosses before `end`, in the voxel `met`; the ray is then beyond it.
 * False: there is none. Where surfaces meet or bend, only one of them is stored in a voxel, so that those of its
 * six neighbours count, too, where they are known to be on the ray's side of the voxel's own plane; round an edge
 * they are not. `corners`: an edge on the ray's side, such as those of a room seen from within, is closed whatever
 * the ray crosses: where three surfaces meet, none of the seven voxels may store the third.
 *
 * An iteration of the loop looks at one voxel, either hit or next to it, so that rays that run in lockstep wait
 * less for each other. */
bool voxel_ray_meet(inout voxel_ray ray, float end, bool corners, out ivec3 met)
{
    int iterations = 7 * voxel_ray_steps();
    uint beside = 0u;                            /* neighbours of `met` still to be tested */
    float entry = 0.0, leave = 0.0, ahead = 0.0; /* of `met`; height above its plane at the entry */
    vec3 n = vec3(0.0), q = vec3(0.0);
    for (int i = 0; i < iterations; i++) {
        bool own = beside == 0u;
        if (own) {
            if (!voxel_inside(ray.cell) || !voxel_ray_trace(ray, end))
                return false;
            met = ray.cell;
            entry = ray.distance;
            voxel_ray_step(ray, met, ivec3(1));
            leave = min(ray.distance, end);
        }
        ivec3 cell = own ? met : voxel_beside(met, findLSB(beside));
        uint bits = texelFetch(voxel_normal, cell, 0).r;
        vec3 cell_n = voxel_normal_unpack(bits);
        vec3 cell_q = vec3(cell) + voxel_point_unpack(texelFetch(voxel_point, cell, 0).r);
        vec2 height = vec2(dot(cell_n, ray.origin - cell_q), dot(cell_n, ray.direction));
        bool counts = true;
        if (own) {
            n = cell_n;
            q = cell_q;
            ahead = height.x + entry * height.y;
            beside = bits >> VOXEL_BESIDE_SHIFT;
            uint edge = ahead > 0.0 ? VOXEL_BESIDE_EDGE_FRONT : VOXEL_BESIDE_EDGE_BACK;
            if (corners && (beside & edge) != 0u)
                return true;
            beside &= VOXEL_BESIDE_ANY;
        } else {
            float apart = dot(n, cell_q - q);
            counts = abs(apart) < VOXEL_PLANE || ahead * apart > 0.0;
            beside &= beside - 1u;
        }
        if (counts && voxel_crossed(height, entry, leave))
            return true;
    }
    return false;
}

/* Whether one surface point sees another [voxels]; with their unit normals. True where the lifted ends have passed
 * each other: the grid does not resolve what is between. */
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
