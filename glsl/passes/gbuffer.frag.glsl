/* Switches LSF_SEEN_THROUGH: surfaces that transmit are there by chance; LSF_REFRACTED: those of media always. */
#include "lib/chance.glsl"
#include "passes/gbuffer_fragment.glsl"
#include "lib/straight.glsl"

layout(location = 0) out uvec4 surface_out;
#if LSF_SPECULAR_PARAMS
layout(location = LSF_SPECULAR_PARAMS_TARGET) out uvec4 specular_params_out;
#endif
#if LSF_EMISSION
layout(location = LSF_EMISSION_TARGET) out vec4 emission_out;
#endif
#if LSF_MOTION
in vec4 vertex_clip, vertex_previous_clip;
#ifdef LSF_HISTORY
flat in float vertex_instance;
layout(location = LSF_MOTION_TARGET) out vec4 motion_out;
#else
layout(location = LSF_MOTION_TARGET) out vec2 motion_out;
#endif
#endif
#ifdef LSF_SEEN_THROUGH
layout(location = LSF_TINT_TARGET) out vec4 tint_out;
#endif

void main()
{
    vec3 to_viewer = fragment_to_viewer();
    surface s;
    vec3 emission;
    bool front;
    if (!material_evaluate(to_viewer, s, emission, front))
        discard;
#ifdef LSF_SEEN_THROUGH
    float passes = seen_through_chance(s, to_viewer, straight_transmittance(s, to_viewer));
#if LSF_REFRACTED
    if (s.volume)
        passes = 0.0; /* refracted paths begin there */
#endif
    /* The random number is another than the one that decides whether a blended surface is present. */
    uint layer = ~layer_key(vertex_layer.x, vertex_layer.y, front);
    float number = chance_even_number(uvec3(layer, uvec2(gl_FragCoord.xy)));
#if LSF_SCATTER
    float share = scattered_share(s), scattered = scattered_chance(share);
    passes = look_through_chance(passes, share);
#endif
    tint_out = vec4(vec3(1.0 / (1.0 - passes)), 1.0);
#if LSF_SCATTER
    if (number >= passes * (1.0 - scattered) && number < passes) {
        surface_look_through(s);
        emission = vec3(0.0); /* the surface itself is seen in other iterations */
        tint_out.rgb = vec3(share / (passes * scattered));
    } else if (number < passes)
        discard;
#else
    if (number < passes)
        discard;
#endif
#endif
#if LSF_SPECULAR_PARAMS
    specular_params_out = specular_params_pack(s);
#endif
#if LSF_EMISSION
    emission_out = vec4(material_emits(front) ? emission : vec3(0.0), 1.0);
#endif
#if LSF_MOTION
    /* Without the jitter, which both positions share. In pixels, y up as on the image plane. */
    motion_out.xy = 0.5 * view.size.xy * (vertex_clip.xy / vertex_clip.w -
                                          vertex_previous_clip.xy / vertex_previous_clip.w);
#ifdef LSF_HISTORY
    float seen_before = vertex_previous_clip.w > 0.0 ? vertex_previous_clip.z / vertex_previous_clip.w : 0.0;
    motion_out.zw = vec2(seen_before, vertex_instance);
#endif
#endif
    surface_out = surface_pack(s);
}
