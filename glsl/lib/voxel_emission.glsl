/* Emission of voxels, in the grid's unit. Switches LSF_EMISSION: surfaces emit; LSF_EMITTERS: points are drawn on
 * them. */
#ifndef LSF_LIB_VOXEL_EMISSION
#define LSF_LIB_VOXEL_EMISSION

#include "lib/voxel_sight.glsl"

#if LSF_EMISSION
layout(binding = LSF_UNIT_VOXEL_EMISSION) uniform usampler3D voxel_emission;
#endif

/* Emission of one side of the voxel; `side`: 0 on that of its normal, else 1. */
vec3 voxel_emission_at(ivec3 cell, int side)
{
#if LSF_EMISSION
    if (side == 0 || voxel_emits_both(texelFetch(voxel_point, cell, 0).r))
        return voxel_emission_unpack(texelFetch(voxel_emission, cell, 0).r);
#endif
    return vec3(0.0);
}

/* The part of it that points drawn on emitters find, too: none of unlit surfaces, which are not drawn. */
vec3 voxel_emission_drawn(ivec3 cell, int side)
{
#if LSF_EMITTERS
    if (!voxel_unlit(texelFetch(voxel_point, cell, 0).r))
        return voxel_emission_at(cell, side);
#endif
    return vec3(0.0);
}

#endif
