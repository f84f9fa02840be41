/* A texel of a level of the radiance pyramid from the eight below it. Switch LSF_VOXEL_SIDES: 1, where the texel
 * is their mean, or LSF_VOXEL_SIDES_AXES, where it is their view along the slice's direction: in each pair the
 * nearer texel occludes the farther one, and the four pairs are averaged (Crassin, Neyret, Sainz, Green and
 * Eisemann 2011, "Interactive Indirect Illumination Using Voxel Cone Tracing", section 6.2). Radiance is
 * multiplied by opacity throughout. */
#ifndef LSF_VOXEL_MIP
#define LSF_VOXEL_MIP

#include "lib/voxel.glsl"

layout(binding = LSF_UNIT_VOXEL_RADIANCE) uniform sampler3D radiance_texture;

/* The pair of texels `front` and `front` + `onward`. */
vec4 mip_pair(ivec3 front, ivec3 onward, int level)
{
    vec4 near = texelFetch(radiance_texture, front, level);
    vec4 far = texelFetch(radiance_texture, front + onward, level);
#if LSF_VOXEL_SIDES == 1
    return near + far;
#else
    return near + (1.0 - near.a) * far;
#endif
}

/* The texel from those of the level below. */
vec4 mip_texel(ivec3 cell, int side, int level)
{
    int axis = side >> 1, slab = int(grid.size.z) >> (level - 1);
    ivec3 along = ivec3(axis == 0, axis == 1, axis == 2);
    ivec3 u = along.zxy, v = along.yzx;
    bool backward = (side & 1) != 0;
    ivec3 first = 2 * cell + ivec3(0, 0, side * slab) + (backward ? along : ivec3(0));
    ivec3 onward = backward ? -along : along;
    vec4 sum =
        mip_pair(first, onward, level - 1) + mip_pair(first + u, onward, level - 1) +
        mip_pair(first + v, onward, level - 1) + mip_pair(first + u + v, onward, level - 1);
#if LSF_VOXEL_SIDES == 1
    return 0.125 * sum;
#else
    return 0.25 * sum;
#endif
}

ivec3 mip_position(ivec3 cell, int side, int level)
{
    return cell + ivec3(0, 0, side * (int(grid.size.z) >> level));
}

#endif
