/* A reflective shadow map. Switches LSF_THIN_WALLS, where some transmit, and those of lib/material.glsl. */
#include "lib/chance.glsl"
#include "lib/light_projection.glsl"
#include "lib/material.glsl"
#include "lib/straight.glsl"

layout(location = 0) out vec2 gradient_out;
layout(location = 1) out uvec4 surface_out;
#if LSF_SPECULAR_PARAMS
layout(location = 2) out uvec4 specular_params_out;
#endif

void main()
{
    /* Derivatives come before any discard, while the whole quad is alive. */
    float z = gl_FragCoord.z;
    gradient_out = vec2(dFdx(z), dFdy(z)) / light_projection_depth_unit(z);
    surface s;
    vec3 emission;
    bool front;
    vec3 to_light = light_projection_perspective() ? -vertex_position : -light.direction.xyz;
    if (!material_evaluate(to_light, s, emission, front))
        discard;
#if LSF_THIN_WALLS
    bool passable = !s.volume || light.intensity.w > 0.0; /* for a lamp, or for the sky */
    if (passable && chance_number(uvec3(floatBitsToUint(z), uvec2(gl_FragCoord.xy))) <
                         straight_chance(straight_transmittance(s, to_light)))
        discard;
#endif
    surface_out = surface_pack(s);
#if LSF_SPECULAR_PARAMS
    specular_params_out = specular_params_pack(s);
#endif
}
