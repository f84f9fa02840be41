/* Clears the radiance of voxels that were occupied. */
#include "lib/voxel_sides.glsl"

void main()
{
    uint at;
    if (!voxel_brick_listed(at))
        return;
    lsf_voxel_brick_data brick = bricks[at];
    int count = voxel_brick_voxels(brick) * bitCount(brick.sides);
    for (int n = voxel_brick_lane(); n < count; n += VOXEL_BRICK_LANES) {
        int voxel, slice;
        voxel_brick_side(brick, n, voxel, slice);
        imageStore(radiance_image, slice_texel(voxel_brick_cell(brick, voxel), slice), vec4(0.0));
    }
}
