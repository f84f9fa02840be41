/* Empties the bricks that were occupied, a work group each. */
#include "lib/voxel.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(binding = 0, r32ui) writeonly uniform uimage3D key_image;
layout(binding = 1, r32ui) writeonly uniform uimage3D occupancy_image[LSF_VOXEL_OCCUPANCY_LEVELS];
layout(std430, binding = LSF_BINDING_BRICKS) readonly buffer lsf_brick_block
{
    uint bricks[];
};

void main()
{
    uint at = gl_WorkGroupID.x + gl_WorkGroupID.y * LSF_VOXEL_LIST_ROW;
    if (at >= bricks[3])
        return;
    ivec3 cell = voxel_brick_unpack(bricks[LSF_VOXEL_LIST_HEADER + at]) * LSF_VOXEL_BRICK +
                 ivec3(gl_LocalInvocationID);
    imageStore(key_image, cell, uvec4(0u));
    imageStore(occupancy_image[0], occupancy_texel(cell), uvec4(0u));
    imageStore(occupancy_image[1], occupancy_texel(cell >> 2), uvec4(0u));
    imageStore(occupancy_image[2], occupancy_texel(cell >> 4), uvec4(0u));
}
