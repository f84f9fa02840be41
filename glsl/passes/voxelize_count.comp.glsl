/* Lists each brick's voxels with the brick, and counts the voxels that each instance has won. */
#define VOXEL_BRICK_ACCESS restrict
#define VOXELIZE_LIST_ACCESS coherent
#include "lib/voxel_brick.glsl"
#include "passes/voxelize_list.glsl"

layout(binding = LSF_UNIT_VOXEL_OCCUPANCY) uniform usampler3D occupancy_texture;

void main()
{
    uint at;
    if (!voxel_brick_listed(at))
        return;
    lsf_voxel_brick_data brick = bricks[at];
    ivec3 texel = occupancy_texel(voxel_brick_unpack(brick.cell) * LSF_VOXEL_BRICK);
    brick.low = texelFetch(occupancy_texture, texel, 0).r;
    brick.high = texelFetch(occupancy_texture, texel + ivec3(1, 0, 0), 0).r;
    int voxels = voxel_brick_voxels(brick), lane = voxel_brick_lane();
    for (int n = lane; n < voxels; n += VOXEL_BRICK_LANES)
        atomicAdd(draws[draw_of(winner(voxel_brick_cell(brick, n)))].count, 1u);
    if (lane == 0) {
        bricks[at].low = brick.low;
        bricks[at].high = brick.high;
    }
}
