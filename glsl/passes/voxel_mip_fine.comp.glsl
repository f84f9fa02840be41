/* Level 1, where bricks hold voxels. */
#include "passes/voxel_mip.glsl"
#include "passes/voxel_mip_children.glsl"

layout(binding = 0, rgba16f) writeonly uniform image3D level_image;

void main()
{
    uint at;
    if (!voxel_brick_listed(at))
        return;
    lsf_voxel_brick_data brick = bricks[at];
    uint children = brick_children(brick);
    int count = bitCount(children) * bitCount(brick.sides);
    for (int n = voxel_brick_lane(); n < count; n += VOXEL_BRICK_LANES) {
        int child, side;
        voxel_brick_side(brick, n, child, side);
        ivec3 cell = child_cell(brick, nth_bit(children, child));
        imageStore(level_image, mip_place(cell, side, 1), mip_texel(cell, side, 1));
    }
}
