/* Draws the transmitting surfaces that are present in this iteration. Switches of lib/material.glsl. */
#include "lib/chance.glsl"
#include "lib/hemisphere_texel.glsl"
#include "lib/material.glsl"
#include "lib/straight.glsl"

void main()
{
    vec2 slope = texel_slope();
    surface s;
    vec3 emission;
    bool front;
    if (!material_evaluate(-vertex_position, s, emission, front) ||
        chance_number(uvec3(floatBitsToUint(gl_FragCoord.z), uvec2(gl_FragCoord.xy))) <
            straight_chance(straight_transmittance(s, -vertex_position)))
        discard;
    draw_texel(slope);
}
