/* The sides of occupied voxels for which radiance is stored: slices of the texture along z. Switch
 * LSF_VOXEL_SIDES. */
#ifndef LSF_LIB_VOXEL_SIDES
#define LSF_LIB_VOXEL_SIDES

#include "lib/voxel_brick.glsl"

layout(binding = 0, rgba16f) uniform image3D radiance_image;

/* The largest half float. */
#define RADIANCE_MAX 65504.0

ivec3 slice_texel(ivec3 cell, int slice)
{
    return cell + ivec3(0, 0, slice * int(grid.size.z));
}

/* The slice that holds the lobe of a surface's front or back along an axis; `facing`: that component of the
 * front's normal. Where it is 0 each side still has one of the two slices, so that both are written and keep
 * nothing of earlier iterations. */
int lobe_slice(int axis, float facing, bool front)
{
    return 2 * axis + ((facing > 0.0) == front ? 1 : 0);
}

#endif
