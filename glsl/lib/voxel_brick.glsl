/* Work groups on occupied bricks. Most voxels of a brick are empty: its invocations share the occupied ones, so
 * that busy lanes are adjacent. */
#ifndef LSF_LIB_VOXEL_BRICK
#define LSF_LIB_VOXEL_BRICK

#include "lib/voxel.glsl"

/* Invocations per brick. */
#ifndef VOXEL_BRICK_LANES
#define VOXEL_BRICK_LANES LSF_VOXEL_BRICK_LANES
#endif

layout(local_size_x = VOXEL_BRICK_LANES * LSF_VOXEL_GROUP_BRICKS) in;

/* Shaders that write to the block define it as restrict. */
#ifndef VOXEL_BRICK_ACCESS
#define VOXEL_BRICK_ACCESS readonly
#endif

layout(std430, binding = LSF_BINDING_BRICKS) VOXEL_BRICK_ACCESS buffer lsf_brick_block
{
    uint brick_groups_x, brick_groups_y, brick_groups_z, brick_count;
    lsf_voxel_brick_data bricks[];
};

/* The invocation's number among those of its brick. */
int voxel_brick_lane()
{
    return int(gl_LocalInvocationID.x % uint(VOXEL_BRICK_LANES));
}

/* The brick's index in the list; false past the end of the list. */
bool voxel_brick_listed(out uint at)
{
    uint group = gl_WorkGroupID.x + gl_WorkGroupID.y * (LSF_VOXEL_LIST_ROW / LSF_VOXEL_GROUP_BRICKS);
    at = group * LSF_VOXEL_GROUP_BRICKS + gl_LocalInvocationID.x / VOXEL_BRICK_LANES;
    return at < brick_count;
}

/* Position of the set bit that follows n others, by bisection. */
int nth_bit(uint word, int n)
{
    int position = 0;
    for (int width = 16; width > 0; width >>= 1) {
        int below = bitCount(bitfieldExtract(word, position, width));
        bool above = n >= below;
        n -= above ? below : 0;
        position += above ? width : 0;
    }
    return position;
}

int voxel_brick_voxels(lsf_voxel_brick_data brick)
{
    return bitCount(brick.low) + bitCount(brick.high);
}

/* The n-th occupied voxel of the brick. */
ivec3 voxel_brick_cell(lsf_voxel_brick_data brick, int n)
{
    int in_low = bitCount(brick.low);
    bool above = n >= in_low;
    int bit = nth_bit(above ? brick.high : brick.low, above ? n - in_low : n);
    return voxel_brick_unpack(brick.cell) * LSF_VOXEL_BRICK +
           ivec3(bit & 3, (bit >> 2) & 3, 2 * int(above) + (bit >> 4));
}

/* Splits n into an item of the brick and one of its slices. */
void voxel_brick_side(lsf_voxel_brick_data brick, int n, out int thing, out int slice)
{
    int sides = bitCount(brick.sides);
    thing = int((float(n) + 0.5) / float(sides)); /* exact, and SIMD units have no integer division */
    slice = nth_bit(brick.sides, n - thing * sides);
}

#endif
