/* Clears the voxels that were occupied. Switch LSF_EMISSION. */
#include "lib/voxel_brick.glsl"

layout(binding = 0, r32ui) writeonly uniform uimage3D key_image;
layout(binding = 1, r32ui) writeonly uniform uimage3D occupancy_image[LSF_VOXEL_OCCUPANCY_LEVELS];
#if LSF_EMISSION
layout(binding = 1 + LSF_VOXEL_OCCUPANCY_LEVELS, r32ui) writeonly uniform uimage3D shining_image;
#endif

void main()
{
    uint at;
    if (!voxel_brick_listed(at))
        return;
    lsf_voxel_brick_data brick = bricks[at];
    ivec3 corner = voxel_brick_unpack(brick.cell);
    int voxels = voxel_brick_voxels(brick), lane = voxel_brick_lane();
    for (int n = lane; n < voxels; n += VOXEL_BRICK_LANES)
        imageStore(key_image, voxel_brick_cell(brick, n), uvec4(0u));
    if (lane < 2)
        imageStore(occupancy_image[0],
                   occupancy_texel(corner * LSF_VOXEL_BRICK) + ivec3(lane, 0, 0), uvec4(0u));
    if (lane == 0) {
        imageStore(occupancy_image[1], occupancy_texel(corner), uvec4(0u));
#if LSF_EMISSION
        imageStore(shining_image, occupancy_texel(corner), uvec4(0u));
#endif
    }
}
