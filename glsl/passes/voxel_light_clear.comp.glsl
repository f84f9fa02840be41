/* Darkens the bricks that were occupied. */
#include "passes/voxel_light.glsl"

void main()
{
    ivec3 cell;
    if (!voxel_of_invocation(cell))
        return;
    /* Stores are dear: most texels are empty anyhow. */
    for (int slice = 0; slice < LSF_VOXEL_SIDES; slice++)
        if (imageLoad(radiance_image, slice_texel(cell, slice)) != vec4(0.0))
            imageStore(radiance_image, slice_texel(cell, slice), vec4(0.0));
}
