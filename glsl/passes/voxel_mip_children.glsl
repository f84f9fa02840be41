/* The eight texels of level 1 in a brick that hold voxels. */
#ifndef LSF_PASSES_VOXEL_MIP_CHILDREN
#define LSF_PASSES_VOXEL_MIP_CHILDREN

#include "lib/voxel_brick.glsl"

/* Mask of two times two columns of voxels in the bits of half a brick. */
const uint corner_voxels = 0x00330033u;

/* A bit for each texel that holds voxels. */
uint brick_children(lsf_voxel_brick_data brick)
{
    uint children = 0u;
    for (int i = 0; i < 4; i++) {
        uint voxels = corner_voxels << (2 * (i & 1) + 8 * (i >> 1));
        children |= (brick.low & voxels) != 0u ? 1u << i : 0u;
        children |= (brick.high & voxels) != 0u ? 16u << i : 0u;
    }
    return children;
}

ivec3 child_cell(lsf_voxel_brick_data brick, int child)
{
    return 2 * voxel_brick_unpack(brick.cell) + ivec3(child & 1, (child >> 1) & 1, child >> 2);
}

/* The including shader defines the operation on a texel of level 1. */
void visit_child(ivec3 cell, int side);

/* Visits all texels of the bricks that hold voxels; those of a brick are shared among its lanes. */
void visit_children()
{
    uint at;
    if (!voxel_brick_listed(at))
        return;
    lsf_voxel_brick_data brick = bricks[at];
    uint children = brick_children(brick);
    int count = bitCount(children) * bitCount(brick.sides);
    for (int n = voxel_brick_lane(); n < count; n += VOXEL_BRICK_LANES) {
        int child, side;
        voxel_brick_side(brick, n, child, side);
        visit_child(child_cell(brick, nth_bit(children, child)), side);
    }
}

#endif
