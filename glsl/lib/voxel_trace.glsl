/* Finds the first occupied voxel that a ray enters: a walk from cell to cell (Amanatides and Woo 1987, "A Fast
 * Voxel Traversal Algorithm for Ray Tracing") that takes an empty part of the grid in one step.
 *
 * Cells are integers, and every step leaves a box of cells through one of its faces, which is exact: rounding
 * cannot stop a ray, reverse it, or let it slip between two voxels. Each step advances by at least a cell and
 * never goes back along an axis, so that a ray takes at most size.x + size.y + size.z steps. */
#ifndef LSF_LIB_VOXEL_TRACE
#define LSF_LIB_VOXEL_TRACE

#include "lib/voxel.glsl"

layout(binding = LSF_UNIT_VOXEL_OCCUPANCY) uniform usampler3D occupancy_voxels;
layout(binding = LSF_UNIT_VOXEL_OCCUPANCY + 1) uniform usampler3D occupancy_bricks;

struct voxel_ray {
    vec3 origin, direction; /* [voxels]; the direction is a unit vector */
    vec3 inverse;           /* 1 / direction, finite */
    ivec3 up;               /* 1 along axes on which the ray ascends, else 0 */
    ivec3 cell;
    float distance; /* at which it entered the cell, from 0 [voxels] */
};

/* Larger than any distance in a grid. */
#define VOXEL_FAR 1e18

/* False where the ray misses the grid. */
bool voxel_ray_begin(vec3 origin, vec3 direction, out voxel_ray ray)
{
    bvec3 up = greaterThanEqual(direction, vec3(0.0));
    vec3 least = mix(vec3(-1.0 / VOXEL_FAR), vec3(1.0 / VOXEL_FAR), up);
    ivec3 size = ivec3(grid.size.xyz);
    ray.origin = origin;
    ray.direction = direction;
    ray.inverse = 1.0 / mix(direction, least, lessThan(abs(direction), vec3(1.0 / VOXEL_FAR)));
    ray.up = ivec3(up);
    ray.cell = ivec3(floor(clamp(origin, vec3(-1.0), vec3(size))));
    ray.distance = 0.0;
    if (voxel_inside(ray.cell))
        return true;
    vec3 enter = (vec3((1 - ray.up) * size) - origin) * ray.inverse;
    vec3 leave = (vec3(ray.up * size) - origin) * ray.inverse;
    float first = max(enter.x, max(enter.y, enter.z));
    if (!(first >= 0.0 && first < min(leave.x, min(leave.y, leave.z))))
        return false;
    ray.distance = first;
    ray.cell = clamp(ivec3(floor(origin + direction * first)), ivec3(0), size - 1);
    ray.cell = mix(ray.cell, (1 - ray.up) * (size - 1), equal(enter, vec3(first)));
    return true;
}

/* Leaves the box of cells that begins at `low` and holds the ray's cell, into the cell beyond. */
void voxel_ray_step(inout voxel_ray ray, ivec3 low, ivec3 extent)
{
    ivec3 face = low + ray.up * extent;
    vec3 to_face = (vec3(face) - ray.origin) * ray.inverse;
    float t = min(to_face.x, min(to_face.y, to_face.z));
    ivec3 ahead = low + ray.up * (extent - 1), beyond = face - 1 + ray.up;
    ivec3 next = clamp(ivec3(floor(ray.origin + ray.direction * t)), min(ray.cell, ahead),
                       max(ray.cell, ahead));
    /* The ray crosses one face at a time: where two meet, there is a voxel between. */
    if (to_face.x == t)
        next.x = beyond.x;
    else if (to_face.y == t)
        next.y = beyond.y;
    else
        next.z = beyond.z;
    ray.cell = next;
    ray.distance = max(ray.distance, t);
}

bool occupancy_holds(uint word, ivec3 cell)
{
    return (word & occupancy_bit(cell)) != 0u;
}

bool voxel_occupied(ivec3 cell)
{
    return occupancy_holds(texelFetch(occupancy_voxels, occupancy_texel(cell), 0).r, cell);
}

/* The bits of a word that a ray in `cell` may still reach, as it goes back along no axis. */
uint occupancy_ahead(ivec3 cell, ivec3 up)
{
    uvec3 at = uvec3(cell & ivec3(3, 3, 1)) << uvec3(0u, 2u, 4u);
    uvec3 back = uvec3(1 - up) * uvec3(3u, 12u, 0u);
    uint row = ((15u << at.x) >> back.x) & 15u;
    uint layer = ((0xffffu << at.y) >> back.y) & 0xffffu;
    uint layers = up.z == 1 ? ~0u << at.z : ~0u >> (16u - at.z);
    return (row * 0x11111111u) & (layer * 0x10001u) & layers;
}

/* Largest number of steps of a ray. */
int voxel_ray_steps()
{
    return int(grid.size.x + grid.size.y + grid.size.z);
}

/* Advances to the first occupied voxel that the ray enters before `end`, including its current cell. False: there
 * is none, or the ray leaves the grid. */
bool voxel_ray_trace(inout voxel_ray ray, float end)
{
    int steps = voxel_ray_steps();
    for (int i = 0; i < steps; i++) {
        if (ray.distance >= end)
            return false;
        ivec3 brick = ray.cell >> 2;
        uint bricks = texelFetch(occupancy_bricks, occupancy_texel(brick), 0).r;
        uint voxels = texelFetch(occupancy_voxels, occupancy_texel(ray.cell), 0).r;
        if (occupancy_holds(voxels, ray.cell))
            return true;
        /* Steps out of 4 x 4 x 2 bricks, a brick, or half a brick, whichever the two words show to be empty ahead. */
        ivec3 shift = (bricks & occupancy_ahead(brick, ray.up)) == 0u      ? ivec3(4, 4, 3)
                      : !occupancy_holds(bricks, brick)                    ? ivec3(2)
                      : (voxels & occupancy_ahead(ray.cell, ray.up)) == 0u ? ivec3(2, 2, 1)
                                                                           : ivec3(0);
        voxel_ray_step(ray, (ray.cell >> shift) << shift, ivec3(1) << shift);
        if (!voxel_inside(ray.cell))
            return false;
    }
    return false;
}

bool voxel_ray_trace(inout voxel_ray ray)
{
    return voxel_ray_trace(ray, VOXEL_FAR);
}

/* Whether the ray passes through one of the bricks whose bits are set, ignoring occlusion. */
bool voxel_ray_passes(voxel_ray ray, usampler3D bricks)
{
    int steps = voxel_ray_steps();
    for (int i = 0; i < steps; i++) {
        ivec3 brick = ray.cell >> 2;
        uint ahead = texelFetch(bricks, occupancy_texel(brick), 0).r & occupancy_ahead(brick, ray.up);
        if (occupancy_holds(ahead, brick))
            return true;
        ivec3 shift = ahead == 0u ? ivec3(4, 4, 3) : ivec3(2);
        voxel_ray_step(ray, (ray.cell >> shift) << shift, ivec3(1) << shift);
        if (!voxel_inside(ray.cell))
            return false;
    }
    return false;
}

#endif
