/* Empties listed bricks. */
#include "lib/voxel.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(binding = 0, rgba16f) uniform writeonly image3D radiance_image;
layout(std430, binding = LSF_BINDING_BRICKS) readonly buffer lsf_brick_block
{
    uint bricks[];
};

void main()
{
    uint at = gl_WorkGroupID.x + gl_WorkGroupID.y * uint(LSF_VOXEL_LIST_ROW);
    if (at >= bricks[LSF_VOXEL_LIST_HEADER - 1])
        return;
    ivec3 cell = voxel_brick_unpack(bricks[uint(LSF_VOXEL_LIST_HEADER) + at]) * LSF_VOXEL_BRICK +
                 ivec3(gl_LocalInvocationID);
    for (int slice = 0; slice < LSF_SIDES; slice++)
        imageStore(radiance_image, cell + ivec3(0, 0, slice * int(grid.size.z)), vec4(0.0));
}
