/* A work group an occupied brick, of which most voxels are empty: its invocations share the occupied
 * ones, so that lanes that work are together. */
#ifndef LSF_LIB_VOXEL_BRICK
#define LSF_LIB_VOXEL_BRICK

#include "lib/voxel.glsl"

layout(local_size_x = LSF_VOXEL_BRICK_GROUP) in;

layout(binding = LSF_UNIT_VOXEL_OCCUPANCY) uniform usampler3D occupancy_texture;
layout(std430, binding = LSF_BINDING_BRICKS) readonly buffer lsf_brick_block
{
    uint bricks[];
};

/* Place of the bit that is set after n others, by bisection. */
int nth_bit(uint word, int n)
{
    int place = 0;
    for (int width = 16; width > 0; width >>= 1) {
        int below = bitCount(bitfieldExtract(word, place, width));
        bool above = n >= below;
        n -= above ? below : 0;
        place += above ? width : 0;
    }
    return place;
}

struct voxel_brick {
    ivec3 corner;
    uint low, high; /* the voxels' bits, half a brick each */
    int in_low, count;
};

/* False past the list's end. */
bool voxel_brick_of_group(out voxel_brick brick)
{
    uint at = gl_WorkGroupID.x + gl_WorkGroupID.y * LSF_VOXEL_LIST_ROW;
    if (at >= bricks[3])
        return false;
    brick.corner = voxel_brick_unpack(bricks[LSF_VOXEL_LIST_HEADER + at]) * LSF_VOXEL_BRICK;
    ivec3 texel = occupancy_texel(brick.corner);
    brick.low = texelFetch(occupancy_texture, texel, 0).r;
    brick.high = texelFetch(occupancy_texture, texel + ivec3(1, 0, 0), 0).r;
    brick.in_low = bitCount(brick.low);
    brick.count = brick.in_low + bitCount(brick.high);
    return true;
}

/* The brick's n-th occupied voxel. */
ivec3 voxel_brick_cell(voxel_brick brick, int n)
{
    int bit = n < brick.in_low ? nth_bit(brick.low, n)
                               : 32 + nth_bit(brick.high, n - brick.in_low);
    return brick.corner + ivec3(bit & 3, (bit >> 2) & 3, bit >> 4);
}

#endif
