/* A whole level, for the coarse ones, of which little is empty. */
#include "passes/voxel_mip.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(binding = 0, rgba16f) writeonly uniform image3D level_image;
layout(location = 0) uniform int level;

void main()
{
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    ivec3 size = ivec3(grid.size.xyz) >> level;
    int side = texel.z / size.z;
    if (texel.x >= size.x || texel.y >= size.y || side >= LSF_VOXEL_SIDES)
        return;
    ivec3 cell = ivec3(texel.xy, texel.z - side * size.z);
    imageStore(level_image, texel, mip_texel(cell, side, level));
}
