/* Tint of light that has passed what is not there, before what the map shows: of all of it the product, in any
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
    /* What is there itself lies at its own depth, but for the map's rounding. */
    if (!present || map_depth <= shown + 2.0 * SKY_MAP_DEPTH_ERROR)
        discard;
    tint_out = vec4(straight_tint(s, to_sky) *
                        map_absorption(s, enters, (map_depth - shown) * sky_maps[map].texel.z), 1.0);
}
