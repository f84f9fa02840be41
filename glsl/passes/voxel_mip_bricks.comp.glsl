/* Levels 1 and 2 where the scene is: a work group for each listed brick of 4^3 voxels, which holds
 * eight texels of level 1 and one of level 2. */
#include "passes/voxel_mip.glsl"

layout(local_size_x = 8 * LSF_VOXEL_SIDES) in;

layout(std430, binding = LSF_BINDING_BRICKS) readonly buffer lsf_brick_block
{
    uint bricks[];
};
layout(location = 0) uniform int level;
layout(location = 1) uniform bool empty; /* clear instead */

void main()
{
    uint index = gl_WorkGroupID.y * uint(LSF_VOXEL_LIST_ROW) + gl_WorkGroupID.x;
    int side = int(gl_LocalInvocationIndex) % LSF_VOXEL_SIDES;
    int child = int(gl_LocalInvocationIndex) / LSF_VOXEL_SIDES;
    if (index >= bricks[LSF_VOXEL_LIST_HEADER - 1] || (level == 2 && child > 0))
        return;
    ivec3 brick = voxel_brick_unpack(bricks[uint(LSF_VOXEL_LIST_HEADER) + index]);
    ivec3 cell = level == 2 ? brick : 2 * brick + (ivec3(child, child >> 1, child >> 2) & 1);
    mip_write(cell, side, level, empty);
}
