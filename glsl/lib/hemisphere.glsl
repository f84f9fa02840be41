/* The map of a hemisphere: hemi-octahedral (Cigolle et al. 2014, "A Survey of Efficient
 * Representations for Independent Unit Vectors"). With a point's coordinates (x, y, z) along the
 * light block's map_right[0], map_up[0] and map_forward[0], z >= 0, and m = |x| + |y| + z, its place
 * on the map, -1..1, is (x + y, x - y) / m and its depth near / m.
 *
 * In an octant, where the signs of x and y are given, m is linear: there it is an ordinary
 * perspective projection, whose three axes are only not at right angles. Triangles drawn octant
 * by octant come out exact. */
#ifndef LSF_LIB_HEMISPHERE
#define LSF_LIB_HEMISPHERE

#include "lib/light_map.glsl"

/* The octants meet on the map's diagonals, on which texel centres lie: they are shifted by this
 * many texels, so that each centre is in one. */
#define HEMISPHERE_SHIFT 0.0625

vec3 hemisphere_local(vec3 v)
{
    return vec3(dot(light.map_right[0].xyz, v), dot(light.map_up[0].xyz, v),
                dot(light.map_forward[0].xyz, v));
}

/* Projective coordinates in an octant, which is given by the signs of x and y, +-1: its place is
 * xy / z, its depth near / z. */
vec3 hemisphere_project(vec2 octant, vec3 local)
{
    return vec3(local.x + local.y, local.x - local.y, dot(octant, local.xy) + local.z);
}

/* The same for a plane's normal n: the plane n.local = c is n'.projected = c. */
vec3 hemisphere_project_normal(vec2 octant, vec3 n)
{
    vec2 inclined = n.xy - octant * n.z;
    return vec3(0.5 * (inclined.x + inclined.y), 0.5 * (inclined.x - inclined.y), n.z);
}

vec2 hemisphere_octant(vec3 local)
{
    return vec2(local.x >= 0.0 ? 1.0 : -1.0, local.y >= 0.0 ? 1.0 : -1.0);
}

/* The octant that a texel's centre is in, exactly. */
vec2 hemisphere_octant_of_texel(ivec2 texel, int texels)
{
    return vec2(texel.x + texel.y + 1 >= texels ? 1.0 : -1.0, texel.x >= texel.y ? 1.0 : -1.0);
}

#endif
