/* Sums what the sides of each occupied brick's voxels shine. */
#include "lib/voxel_brick.glsl"
#include "passes/voxel_draw_list.glsl"

shared float sums[VOXEL_BRICK_LANES * LSF_VOXEL_GROUP_BRICKS];

void main()
{
    uint at;
    bool listed = voxel_brick_listed(at);
    lsf_voxel_brick_data brick = bricks[listed ? at : 0u];
    int count = listed ? LSF_VOXEL_SIDES * voxel_brick_voxels(brick) : 0;
    float sum = 0.0;
    for (int n = voxel_brick_lane(); n < count; n += VOXEL_BRICK_LANES)
        sum += side_weight(voxel_brick_cell(brick, n / LSF_VOXEL_SIDES), n % LSF_VOXEL_SIDES);
    sums[gl_LocalInvocationID.x] = sum;
    barrier();
    if (!listed || voxel_brick_lane() != 0)
        return;
    for (uint i = 1u; i < uint(VOXEL_BRICK_LANES); i++)
        sum += sums[gl_LocalInvocationID.x + i];
    brick_sums[brick_index(voxel_brick_unpack(brick.cell))] = sum;
}
