/* Darkens the bricks that were occupied. */
#include "lib/voxel.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(binding = 0, rgba16f) uniform image3D radiance_image;
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
    /* Most of a brick is dark already, and to look costs less than to write. */
    for (int slice = 0; slice < LSF_VOXEL_SIDES; slice++) {
        ivec3 texel = cell + ivec3(0, 0, slice * int(grid.size.z));
        if (imageLoad(radiance_image, texel).a != 0.0)
            imageStore(radiance_image, texel, vec4(0.0));
    }
}
