/* How many voxels each instance has won, or, when that is known, which. */
#include "lib/voxel_brick.glsl"
#include "passes/voxelize_list.glsl"

layout(location = 25) uniform bool place;

void main()
{
    voxel_brick brick;
    if (!voxel_brick_of_group(brick))
        return;
    for (int n = int(gl_LocalInvocationID.x); n < brick.count; n += LSF_VOXEL_BRICK_GROUP) {
        ivec3 cell = voxel_brick_cell(brick, n);
        uint draw = draw_of(winner(cell));
        if (place) {
            uint at = draws[draw].first + atomicAdd(draws[draw].listed, 1u);
            if (at < uint(won.length()))
                won[at] = voxel_brick_pack(cell);
        } else {
            atomicAdd(draws[draw].count, 1u);
        }
    }
}
