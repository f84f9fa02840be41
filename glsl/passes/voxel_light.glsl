/* An occupied voxel, and the texels of its sides. */
#include "lib/voxel_brick.glsl"

layout(binding = 0, rgba16f) uniform image3D radiance_image;
layout(binding = LSF_UNIT_VOXEL_ALBEDO) uniform usampler3D albedo_texture;
layout(binding = LSF_UNIT_VOXEL_NORMAL) uniform usampler3D normal_texture;
layout(binding = LSF_UNIT_VOXEL_GLOSS) uniform usampler3D point_texture;
#if LSF_EMISSION
layout(binding = LSF_UNIT_VOXEL_EMISSION) uniform usampler3D emission_texture;
#endif

/* The largest half float. */
#define RADIANCE_MAX 65504.0

ivec3 slice_texel(ivec3 cell, int slice)
{
    return cell + ivec3(0, 0, slice * int(grid.size.z));
}

/* The slice that holds a side's lobe along an axis; `facing`: that component of the side's normal. */
int lobe_slice(int axis, float facing)
{
    return 2 * axis + (facing > 0.0 ? 1 : 0);
}
