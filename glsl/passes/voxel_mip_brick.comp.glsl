/* Level 2, of which a brick is one texel. */
#define VOXEL_BRICK_LANES 1
#include "lib/voxel_brick.glsl"
#include "passes/voxel_mip.glsl"

layout(binding = 0, rgba16f) writeonly uniform image3D level_image;

void main()
{
    uint at;
    if (!voxel_brick_listed(at))
        return;
    lsf_voxel_brick_data brick = bricks[at];
    ivec3 cell = voxel_brick_unpack(brick.cell);
    for (uint sides = brick.sides; sides != 0u; sides &= sides - 1u) {
        int side = findLSB(sides);
        imageStore(level_image, mip_position(cell, side, 2), mip_texel(cell, side, 2));
    }
}
