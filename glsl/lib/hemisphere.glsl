/* The map of a hemisphere: hemi-octahedral (Cigolle et al. 2014, "A Survey of Efficient
 * Representations for Independent Unit Vectors"). With a point's coordinates (x, y, z) along the
 * light block's map_right[0], map_up[0] and map_forward[0], z >= 0, and m = |x| + |y| + z, its position
 * on the map, -1..1, is (x + y, x - y) / m and its depth near / m.
 *
 * In an octant, where the signs of x and y are given, m is linear, and the map is an ordinary perspective
 * projection whose axes are not at right angles. Triangles drawn octant by octant are therefore exact. */
#ifndef LSF_LIB_HEMISPHERE
#define LSF_LIB_HEMISPHERE

#include "lib/light_projection.glsl"

/* The octants meet on the map's diagonals, on which texel centres lie. Octants are shifted by this many texels, so
 * that each centre is in exactly one. */
#define HEMISPHERE_SHIFT 0.0625

vec3 hemisphere_local(vec3 v)
{
    return vec3(dot(light.map_right[0].xyz, v), dot(light.map_up[0].xyz, v),
                dot(light.map_forward[0].xyz, v));
}

/* Projective coordinates in an octant, which is given by the signs of x and y, +-1: the position on the map is xy
 * / z and the depth near / z. */
vec3 hemisphere_project(vec2 octant, vec3 local)
{
    return vec3(local.x + local.y, local.x - local.y, dot(octant, local.xy) + local.z);
}

/* The same for the normal n of a plane: the plane n.local = c becomes n'.projected = c. */
vec3 hemisphere_project_normal(vec2 octant, vec3 n)
{
    vec2 inclined = n.xy - octant * n.z;
    return vec3(0.5 * (inclined.x + inclined.y), 0.5 * (inclined.x - inclined.y), n.z);
}

vec2 hemisphere_octant(vec3 local)
{
    return vec2(local.x >= 0.0 ? 1.0 : -1.0, local.y >= 0.0 ? 1.0 : -1.0);
}

/* The octant that holds a texel's centre, exactly. */
vec2 hemisphere_octant_of_texel(ivec2 texel, int texels)
{
    return vec2(texel.x + texel.y + 1 >= texels ? 1.0 : -1.0, texel.x >= texel.y ? 1.0 : -1.0);
}

/* What a texel holds of the surface nearest to the VPL: 20 bits of its depth, then 6 bits of each
 * slope, the change of the depth's logarithm along x and y of the place. The greatest value is the
 * nearest surface's, so that texels can be drawn in any order by an atomic maximum. 0: nothing.
 *
 * The depth is a float from 2^-31 on with 15 bits after the leading one, rounded: a relative error
 * of 2^-16. A slope s is kept as s / (1 + |s|), within 1/62. */
#define HEMISPHERE_DEPTH_ERROR 1.6e-5
#define HEMISPHERE_DEPTH_BASE 0x30000000u /* 2^-31 */

uint hemisphere_slope_pack(float s)
{
    float bounded = clamp(s, -1e6, 1e6);
    return uint(int(round(bounded / (1.0 + abs(bounded)) * 31.0)) + 32);
}

float hemisphere_slope_unpack(uint code)
{
    float c = clamp(float(int(code & 63u) - 32) / 31.0, -0.97, 0.97);
    return c / (1.0 - abs(c));
}

uint hemisphere_pack(float depth, vec2 slope)
{
    uint code = (floatBitsToUint(depth) - HEMISPHERE_DEPTH_BASE + 128u) >> 8;
    return (min(code, 0xfffffu) << 12) | (hemisphere_slope_pack(slope.x) << 6) |
           hemisphere_slope_pack(slope.y);
}

float hemisphere_unpack_depth(uint texel)
{
    return texel == 0u ? 0.0 : uintBitsToFloat(((texel >> 12) << 8) + HEMISPHERE_DEPTH_BASE);
}

vec2 hemisphere_unpack_slope(uint texel)
{
    return vec2(hemisphere_slope_unpack(texel >> 6), hemisphere_slope_unpack(texel));
}

#endif
