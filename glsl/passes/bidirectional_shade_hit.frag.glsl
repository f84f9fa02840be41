/* Light that a ray-bundle brings to the vertices from its hits (x2): emission, or the environment where there is
 * no hit, and reflected light of the current punctual light. With LSF_CONTINUE the hit becomes the next vertex. */
#include "lib/bundle_pdf.glsl"
#include "lib/environment.glsl"
#include "lib/mis.glsl"
#include "lib/ray_bundle.glsl"
#include "lib/shading_vertex.glsl"
#include "lib/straight.glsl"
#if LSF_PUNCTUAL
#include "lib/emission_pdf.glsl"
#include "lib/light.glsl"
#include "lib/shadow.glsl"
#endif

layout(binding = 4) uniform usampler2D hit_texture;
/* Whether emission, and light of the current light, are added (0 or 1); number of bundles that begin a path;
 * density with which VPLs find an emitter, per unit of its luminance. */
layout(location = LSF_LOCATION_ADDED) uniform vec4 added;
#if LSF_ENVIRONMENT
/* xy: weight of the environment along the bundle and against it, beside directions drawn by its radiance; zw:
 * kernel of suppression for both, without that of the previous vertex. */
layout(location = LSF_LOCATION_SKY_CHANCE) uniform vec4 sky;
#endif

#define DIRECT_TARGET (1 + LSF_SPECULAR)
#define VERTEX_TARGET (DIRECT_TARGET + LSF_SPLIT_DIRECT * (1 + LSF_SPECULAR))

layout(location = 0) out vec4 irradiance_out;
#if LSF_SPECULAR
layout(location = 1) out vec4 specular_out;
#endif
#if LSF_SPLIT_DIRECT
layout(location = DIRECT_TARGET) out vec4 direct_irradiance_out;
#if LSF_SPECULAR
layout(location = DIRECT_TARGET + 1) out vec4 direct_specular_out;
#endif
#endif
#if LSF_CONTINUE
layout(location = VERTEX_TARGET) out vec4 position_out;
layout(location = VERTEX_TARGET + 1) out uvec4 surface_out;
layout(location = VERTEX_TARGET + 2) out uvec4 throughput_out;
#if LSF_SPECULAR_PARAMS
layout(location = VERTEX_TARGET + 3) out uvec4 specular_params_out;
#endif
#endif

/* Radiance along the bundle that reaches the vertex, and the kernel of suppression for it (brdf_evaluate). */
struct arriving_light {
    vec3 radiance;
    float kernel;
};

#if LSF_PUNCTUAL
/* Light of x0 that x2 reflects to the vertex, weighted against VPLs, and the kernel of suppression at the vertex. */
arriving_light reflected_light(vec3 direction, float distance2_3, vec3 position, surface x2)
{
    arriving_light r = arriving_light(vec3(0.0), 0.0);
    vec3 irradiance;
    float distance2_0;
    vec3 to_light = light_direction(position, irradiance, distance2_0);
    float cosine_0 = dot(x2.geometric_normal, to_light);
    float cosine_3 = -dot(x2.geometric_normal, direction);
    float shading_cosine_0 = dot(x2.normal, to_light);
    bool transmits = false;
    shadow_raster_error = bundle_raster_error(x2.geometric_normal);
#if LSF_SHADOW_TINT
    transmits = x2.transmission > 0.0 && (!x2.volume || light.intensity.w > 0.0);
#endif
    if (x2.unlit || cosine_0 <= 0.0 || shading_cosine_0 <= 0.0 ||
        max(irradiance.r, max(irradiance.g, irradiance.b)) <= 0.0 ||
        shadow_visibility(position, x2.geometric_normal, transmits) == 0.0)
        return r;
#if LSF_SHADOW_TINT
    irradiance *= shadow_tint(position, x2.geometric_normal, straight_tint_or_one(x2, to_light));
#endif
    path_density p =
        path_density_at(cosine_0, max(distance2_0, LSF_LIGHT_DISTANCE2_MIN), cosine_3, distance2_3,
                        emission_pdf(position) * suppression.w,
                        bundle_pdf(direction) * suppression.w);
    float density = p.vpl + p.bundle;
    float kernel_3 = suppression_kernel(density, cosine_3, distance2_3);
    float kernel_0 = light_projection_perspective()
                         ? suppression_kernel(density, cosine_0, distance2_0)
                         : 0.0;
    brdf_value f_2 = brdf_evaluate(x2, -direction, to_light, hidden_kernel(kernel_0, kernel_3));
    r.radiance = irradiance * brdf_sum(x2, f_2) *
                 (shading_cosine_0 * mis_weight(p.bundle, p.vpl) * strategy.w / (bundle.forward.w * suppression.w));
    r.kernel = kernel_3;
    return r;
}
#endif

#if LSF_EMITTERS
/* Weights the emission of x2 against VPLs placed on it; both strategies suppress the lobe equally. */
void weigh_emission(vec3 direction, float distance2_3, surface x2, inout arriving_light emission)
{
    float luminance = dot(emission.radiance, vec3(0.2126, 0.7152, 0.0722));
    float cosine_3 = -dot(x2.geometric_normal, direction);
    if (luminance <= 0.0)
        return;
    path_density p =
        emitter_density_at(added.w * luminance, cosine_3, distance2_3, bundle_pdf(direction));
    emission.radiance *= mis_weight(p.bundle, p.vpl);
    emission.kernel = suppression_kernel(p.vpl + p.bundle, cosine_3, distance2_3);
}
#endif

void main()
{
#if LSF_CONTINUE
    position_out = vec4(0.0);
    surface_out = uvec4(0u);
    throughput_out = uvec4(0u);
#if LSF_SPECULAR_PARAMS
    specular_params_out = uvec4(0u);
#endif
#endif
    irradiance_out = vec4(0.0);
#if LSF_SPECULAR
    specular_out = vec4(0.0);
#endif
#if LSF_SPLIT_DIRECT
    direct_irradiance_out = vec4(0.0);
#if LSF_SPECULAR
    direct_specular_out = vec4(0.0);
#endif
#endif
    shading_vertex v;
    if (!vertex_load(v))
        return;
    uvec2 hit = texelFetch(hit_texture, ivec2(gl_FragCoord.xy), 0).xy;
    float p_r = bundle.forward.w;
    bool along = dot(v.s.geometric_normal, bundle.forward.xyz) > 0.0;
    vec3 direction = along ? bundle.forward.xyz : -bundle.forward.xyz;
    /* The density of rays from the vertex alone is N p_r (equation 14). */
    float kernel = suppression.x / (added.z * p_r);
#if LSF_ENVIRONMENT
    if (hit.y == LSF_NO_NODE)
        kernel = along ? sky.z : sky.w;
#endif
#if LSF_SPECULAR_PATHS
    if (hit.y == LSF_NO_NODE)
        v.lobe_left = 1.0;
#endif
    arriving_light emitted = arriving_light(vec3(0.0), kernel), reflected = emitted;
    bool goes_on = false;
#if LSF_STRAIGHT
    /* Transmittance on the way from the hit, over the probability that the hit is present. */
    vec3 left = bundle_tint(v.position, direction, hit.y == LSF_NO_NODE ? 1e30 : uintBitsToFloat(hit.x));
#endif
    if (hit.y == LSF_NO_NODE) {
#if LSF_ENVIRONMENT
        emitted.radiance = environment_radiance(direction) * (along ? sky.x : sky.y);
#endif
    } else {
        surface x2 = bundle_surface(hit.y, direction, emitted.radiance);
#if LSF_STRAIGHT
        left *= straight_weight(x2, direction);
#endif
        vec3 position = bundle_position(hit.y, v.position);
        float distance_3 = distance(position, v.position);
#if LSF_EMITTERS
        if (!x2.unlit && added.w > 0.0)
            weigh_emission(direction, distance_3 * distance_3, x2, emitted);
#endif
#if LSF_PUNCTUAL
        if (added.y != 0.0)
            reflected = reflected_light(direction, distance_3 * distance_3, position, x2);
#endif
#if LSF_CONTINUE
        if (!x2.unlit) {
            goes_on = true;
            position_out = vec4(position, max(bundle_raster_error(x2.geometric_normal), 1e-9)); /* 0: no vertex */
            surface_out = surface_pack(x2);
#if LSF_SPECULAR_PARAMS
            specular_params_out = specular_params_pack(x2);
#endif
        }
#endif
    }
    emitted.radiance *= added.x * (strategy.w / p_r);
#if LSF_STRAIGHT
    emitted.radiance *= left;
    reflected.radiance *= left;
#endif
    light_parts of_next, of_emitted, of_reflected;
#if LSF_SPECULAR
    /* What the vertex reflects of each differs by the kernel. One copy of the code evaluates them, as often as there
     * is light: software GL would execute all copies. */
    of_next.irradiance = of_next.specular = vec3(0.0);
    of_emitted = of_reflected = of_next;
    uint wanted = (goes_on ? 1u : 0u) | (emitted.radiance != vec3(0.0) ? 2u : 0u) |
                  (reflected.radiance != vec3(0.0) ? 4u : 0u);
    for (; wanted != 0u; wanted &= wanted - 1u) {
        int which = findLSB(wanted);
        float own = which == 0 ? kernel : which == 1 ? emitted.kernel : reflected.kernel;
        light_parts r = vertex_reflect(v, direction, own + suppression.z);
        if (which == 0)
            of_next = r;
        else if (which == 1)
            of_emitted = r;
        else
            of_reflected = r;
    }
#else
    /* A diffuse vertex has no lobe to widen, so that one kernel serves all. */
    of_next = of_emitted = of_reflected = vertex_reflect(v, direction, 0.0);
#endif
#if LSF_CONTINUE
    of_next.irradiance /= p_r;
    of_next.specular /= p_r;
#if LSF_STRAIGHT
    of_next.irradiance *= left;
    of_next.specular *= left;
#endif
    throughput_out = uvec4(throughput_pack(of_next), 0u);
#endif
    irradiance_out.rgb = of_reflected.irradiance * reflected.radiance;
#if LSF_SPLIT_DIRECT
    direct_irradiance_out.rgb = of_emitted.irradiance * emitted.radiance;
#else
    irradiance_out.rgb += of_emitted.irradiance * emitted.radiance;
#endif
#if LSF_SPECULAR
    specular_out.rgb = of_reflected.specular * reflected.radiance;
#if LSF_SPLIT_DIRECT
    direct_specular_out.rgb = of_emitted.specular * emitted.radiance;
#else
    specular_out.rgb += of_emitted.specular * emitted.radiance;
#endif
#endif
}
