/* Voxels sorted by the instance that has won them. */
#ifndef LSF_PASSES_VOXELIZE_LIST
#define LSF_PASSES_VOXELIZE_LIST

#include "lib/voxel.glsl"

layout(binding = 0, r32ui) readonly uniform uimage3D key_image;
layout(location = 29) uniform uvec2 list_sizes; /* instances; voxels for which `won` has room */

/* An instance, in draw order. */
struct voxelize_draw {
    uint groups_x, groups_y, groups_z; /* dispatch over its voxels */
    uint first, count;                 /* range of its voxels in the list */
    uint listed;
    uint first_triangle, triangles;    /* among all */
};

/* Shaders that write to the blocks define it as coherent. */
#ifndef VOXELIZE_LIST_ACCESS
#define VOXELIZE_LIST_ACCESS readonly
#endif

layout(std430, binding = LSF_BINDING_DRAWS) VOXELIZE_LIST_ACCESS buffer lsf_draw_block
{
    voxelize_draw draws[];
};
layout(std430, binding = LSF_BINDING_WON) VOXELIZE_LIST_ACCESS buffer lsf_won_block
{
    uint won[]; /* cells, packed as bricks are */
};

uint winner(ivec3 cell)
{
    uint mask = (1u << grid.id_bits) - 1u;
    return mask - (imageLoad(key_image, cell).r & mask);
}

/* The draw to which a triangle belongs, by bisection. */
uint draw_of(uint triangle)
{
    uint low = 0u, high = list_sizes.x;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (draws[middle].first_triangle <= triangle)
            low = middle;
        else
            high = middle;
    }
    return low;
}

#endif
