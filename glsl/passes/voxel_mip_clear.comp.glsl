/* Clears levels 1 and 2 where bricks held voxels. */
#include "passes/voxel_mip.glsl"
#include "passes/voxel_mip_children.glsl"

layout(binding = 0, rgba16f) writeonly uniform image3D fine_image;
layout(binding = 1, rgba16f) writeonly uniform image3D brick_image;

void visit_child(ivec3 cell, int side)
{
    imageStore(fine_image, mip_position(cell, side, 1), vec4(0.0));
    imageStore(brick_image, mip_position(cell >> 1, side, 2), vec4(0.0));
}

void main()
{
    visit_children();
}
