/* Writes the voxels that each instance has won to the instance's part of the list. */
#define VOXELIZE_LIST_ACCESS coherent
#include "lib/voxel_brick.glsl"
#include "passes/voxelize_list.glsl"

void main()
{
    uint at;
    if (!voxel_brick_listed(at))
        return;
    lsf_voxel_brick_data brick = bricks[at];
    int voxels = voxel_brick_voxels(brick);
    for (int n = voxel_brick_lane(); n < voxels; n += VOXEL_BRICK_LANES) {
        ivec3 cell = voxel_brick_cell(brick, n);
        uint draw = draw_of(winner(cell));
        uint index = draws[draw].first + atomicAdd(draws[draw].listed, 1u);
        if (index < list_sizes.y)
            won[index] = voxel_brick_pack(cell);
    }
}
