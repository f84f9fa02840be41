/* Shading normals of voxels. Switch LSF_VOXEL_BENT: some differ from the planes' normals. */
#ifndef LSF_LIB_VOXEL_SHADING
#define LSF_LIB_VOXEL_SHADING

#include "lib/voxel.glsl"

#if LSF_VOXEL_BENT
layout(binding = LSF_UNIT_VOXEL_SHADING) uniform usampler3D voxel_shading;
#endif

/* Bits of the shading normal, seen from the surface's front, and with LSF_VOXEL_BENT of the tangent's rotation;
 * `normal`: the bits of the plane's normal. */
uint voxel_shading_bits(ivec3 cell, uint normal)
{
#if LSF_VOXEL_BENT
    return texelFetch(voxel_shading, cell, 0).r;
#else
    return normal;
#endif
}

#endif
