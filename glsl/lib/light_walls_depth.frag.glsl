/* Depth of the thin walls that are present in a light's map. Switches LSF_GRADIENT and those of lib/material.glsl. */
#include "lib/chance.glsl"
#include "lib/light_projection.glsl"
#include "lib/material.glsl"
#include "lib/straight.glsl"

#if LSF_GRADIENT
layout(location = 0) out vec2 gradient;
#endif

void main()
{
    vec3 to_light = light_projection_perspective() ? -vertex_position : -light.direction.xyz;
#if LSF_GRADIENT
    /* Derivatives come before any discard, while the whole quad is alive. */
    float z = gl_FragCoord.z;
    gradient = vec2(dFdx(z), dFdy(z)) / light_projection_depth_unit(z);
#endif
    surface s;
    vec3 emission;
    bool front;
    if (!material_evaluate(to_light, s, emission, front) ||
        chance_number(uvec3(floatBitsToUint(gl_FragCoord.z), uvec2(gl_FragCoord.xy))) <
            straight_chance(straight_transmittance(s, to_light)))
        discard;
}
