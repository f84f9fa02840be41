/* Draws the transmitting surfaces that are present in this iteration. Switches of lib/material.glsl. */
#include "lib/chance.glsl"
#include "lib/material.glsl"
#include "lib/sky_map_texel.glsl"
#include "lib/straight.glsl"

void main()
{
    vec3 to_sky = sky_maps[map].to_sky.xyz;
    draw_texel();
    surface s;
    vec3 emission;
    bool front;
    if (!material_evaluate(to_sky, s, emission, front) ||
        chance_number(uvec3(floatBitsToUint(map_depth), uvec2(gl_FragCoord.xy))) <
            straight_chance(straight_transmittance(s, to_sky)))
        discard;
}
