/* Darkens the bricks that were occupied. */
#include "passes/voxel_light.glsl"

void main()
{
    ivec3 cell;
    if (!voxel_of_invocation(cell))
        return;
    for (int slice = 0; slice < LSF_VOXEL_SIDES; slice++)
        imageStore(radiance_image, slice_texel(cell, slice), vec4(0.0));
}
