/* Tint of light that has passed the absent surfaces in front of the map's: the product over all of them, in any
 * order. Switches LSF_ABSORPTION (there are media) and those of lib/material.glsl. */
#include "lib/material.glsl"
#include "lib/sky_map.glsl"
#include "lib/straight.glsl"
#include "lib/map_absorption.glsl"

layout(location = 0) uniform int map;
layout(binding = LSF_UNIT_SEEN_DEPTH) uniform usampler2DArray map_texture;

in float map_depth;
layout(location = 0) out vec4 tint_out; /* multiplied */

void main()
{
    vec3 to_sky = sky_maps[map].to_sky.xyz;
    surface s;
    vec3 emission;
    bool front;
    bool present = material_evaluate(to_sky, s, emission, front);
    bool enters = map_light_enters(front, to_sky);
    float shown = sky_map_depth(texelFetch(map_texture, ivec3(gl_FragCoord.xy, map), 0).r);
    /* A surface that is present lies at its own depth in the map, within the map's rounding. */
    if (!present || map_depth <= shown + 2.0 * SKY_MAP_DEPTH_ERROR)
        discard;
    tint_out = vec4(straight_tint(s, to_sky) *
                        map_absorption(s, enters, (map_depth - shown) * sky_maps[map].texel.z), 1.0);
}
