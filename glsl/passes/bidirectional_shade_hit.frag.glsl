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

#if LSF_PUNCTUAL
/* Light of x0 that x2 reflects to the vertex, weighted against VPLs; both parts. */
light_parts reflected_light(shading_vertex v, vec3 direction, float distance2_3, vec3 position,
                            surface x2, light_parts through)
{
    light_parts r;
    r.irradiance = r.specular = vec3(0.0);
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
    brdf_value f_2 = brdf_evaluate(x2, -direction, to_light, kernel_0 + kernel_3);
#if LSF_SPECULAR
    through = vertex_reflect(v, direction, kernel_3 + suppression.z);
#endif
    vec3 radiance = irradiance * brdf_sum(x2, f_2) *
                    (shading_cosine_0 * mis_weight(p.bundle, p.vpl) * strategy.w /
                     (bundle.forward.w * suppression.w));
    r.irradiance = through.irradiance * radiance;
    r.specular = through.specular * radiance;
    return r;
}
#endif

#if LSF_EMITTERS
/* Weights the emission of x2 against VPLs placed on it; both strategies suppress the lobe equally. */
void weigh_emission(shading_vertex v, vec3 direction, float distance2_3, surface x2,
                    inout vec3 emission, inout light_parts through)
{
    float luminance = dot(emission, vec3(0.2126, 0.7152, 0.0722));
    float cosine_3 = -dot(x2.geometric_normal, direction);
    if (luminance <= 0.0)
        return;
    path_density p =
        emitter_density_at(added.w * luminance, cosine_3, distance2_3, bundle_pdf(direction));
    emission *= mis_weight(p.bundle, p.vpl);
#if LSF_SPECULAR
    float kernel_3 = suppression_kernel(p.vpl + p.bundle, cosine_3, distance2_3);
    through = vertex_reflect(v, direction, kernel_3 + suppression.z);
#endif
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
    light_parts through = vertex_reflect(v, direction, kernel + suppression.z);
    vec3 arriving = vec3(0.0); /* emission */
    light_parts through_emission = through;
    light_parts reflected;
    reflected.irradiance = reflected.specular = vec3(0.0);
#if LSF_STRAIGHT
    /* Transmittance on the way from the hit, over the probability that the hit is present. */
    vec3 left = bundle_tint(v.position, direction, hit.y == LSF_NO_NODE ? 1e30 : uintBitsToFloat(hit.x));
#endif
    if (hit.y == LSF_NO_NODE) {
#if LSF_ENVIRONMENT
        arriving = environment_radiance(direction) * (along ? sky.x : sky.y);
#endif
    } else {
        surface x2 = bundle_surface(hit.y, direction, arriving);
#if LSF_STRAIGHT
        left *= straight_weight(x2, direction);
#endif
        vec3 position = bundle_position(hit.y, v.position);
        float distance_3 = distance(position, v.position);
#if LSF_EMITTERS
        if (!x2.unlit && added.w > 0.0)
            weigh_emission(v, direction, distance_3 * distance_3, x2, arriving, through_emission);
#endif
#if LSF_PUNCTUAL
        if (added.y != 0.0)
            reflected = reflected_light(v, direction, distance_3 * distance_3, position, x2, through);
#endif
#if LSF_CONTINUE
        if (!x2.unlit) {
            light_parts t;
            t.irradiance = through.irradiance / p_r;
            t.specular = through.specular / p_r;
#if LSF_STRAIGHT
            t.irradiance *= left;
            t.specular *= left;
#endif
            position_out = vec4(position, max(bundle_raster_error(x2.geometric_normal), 1e-9)); /* 0: no vertex */
            surface_out = surface_pack(x2);
            throughput_out = uvec4(throughput_pack(t), 0u);
#if LSF_SPECULAR_PARAMS
            specular_params_out = specular_params_pack(x2);
#endif
        }
#endif
    }
#if LSF_STRAIGHT
    reflected.irradiance *= left;
    reflected.specular *= left;
    arriving *= left;
#endif
    vec3 emitted = added.x != 0.0 ? arriving * (strategy.w / p_r) : vec3(0.0);
#if LSF_SPLIT_DIRECT
    direct_irradiance_out.rgb = through_emission.irradiance * emitted;
#if LSF_SPECULAR
    direct_specular_out.rgb = through_emission.specular * emitted;
#endif
#else
    reflected.irradiance += through_emission.irradiance * emitted;
    reflected.specular += through_emission.specular * emitted;
#endif
    irradiance_out.rgb = reflected.irradiance;
#if LSF_SPECULAR
    specular_out.rgb = reflected.specular;
#endif
}
