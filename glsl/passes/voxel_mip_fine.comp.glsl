/* Level 1, in bricks that hold voxels. */
#include "passes/voxel_mip.glsl"
#include "passes/voxel_mip_children.glsl"

layout(binding = 0, rgba16f) writeonly uniform image3D level_image;

void visit_child(ivec3 cell, int side)
{
    imageStore(level_image, mip_position(cell, side, 1), mip_texel(cell, side, 1));
}

void main()
{
    visit_children();
}
