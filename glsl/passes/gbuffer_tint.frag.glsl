/* Tint of the absent surfaces in front of the visible one: the product over all of them, in any order. Switch
 * LSF_ABSORPTION: there are media. */
#include "passes/gbuffer_fragment.glsl"
#include "lib/straight.glsl"

layout(binding = LSF_UNIT_SEEN_DEPTH) uniform sampler2D depth_texture;

layout(location = 0) out vec4 tint_out; /* multiplied into the target; alpha 0 marks that there was a surface */
#if LSF_ABSORPTION
layout(location = 1) out vec4 absorption_out; /* added */
#endif

void main()
{
    vec3 to_viewer = fragment_to_viewer();
    surface s;
    vec3 emission;
    bool front;
    bool present = material_evaluate(to_viewer, s, emission, front);
    float seen = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    if (!present || gl_FragCoord.z <= seen)
        discard;
    vec3 transmittance = straight_transmittance(s, to_viewer);
    float passes = seen_through_chance(s, to_viewer, transmittance);
#if LSF_SCATTER
    float share = scattered_share(s);
    transmittance *= (1.0 - share) / max(1.0 - scattered_chance(share), 1e-6);
    passes = look_through_chance(passes, share);
#endif
    tint_out = vec4(transmittance / max(passes, 1e-6), 0.0);
#if LSF_ABSORPTION
    /* The path enters the medium at its front and leaves it at its back. Behind all surfaces the position does not
     * matter, because media are closed. */
    vec3 ray = view_ray_direction(sample_ndc(gl_FragCoord.xy));
    float path_length = ((seen > 0.0 ? view_depth(seen) : 0.0) - view_depth(gl_FragCoord.z)) * length(ray);
    absorption_out = vec4(0.0);
    if (s.volume)
        absorption_out.rgb = materials[s.material].absorption.rgb * (front ? path_length : -path_length);
#endif
}
