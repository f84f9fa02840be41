/* Writes a fragment's key to a map of the environment. */
#ifndef LSF_LIB_SKY_MAP_TEXEL
#define LSF_LIB_SKY_MAP_TEXEL

#include "lib/sky_map.glsl"

layout(location = 0) uniform int map;

in float map_depth; /* not clamped */
layout(location = 0) out uint key_out;

/* Call this before any discard, while the whole quad is alive. */
void draw_texel()
{
    vec2 gradient = vec2(dFdx(map_depth), dFdy(map_depth));
    key_out = sky_map_key(map_depth, sky_map_slopes(map, gradient));
}

#endif
