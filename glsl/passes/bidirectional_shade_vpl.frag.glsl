/* Connects the vertices to one VPL: path (x0, x1, x3), or (x0, x1, x2, x3) with LSF_DEEP. Both
 * parts of the light are added to the targets; alpha holds the luminance that a bound took away. */
#include "lib/bundle_pdf.glsl"
#include "lib/mis.glsl"
#include "lib/shading_vertex.glsl"
#include "lib/shadow.glsl"
#include "shared/light.h"
#include "shared/vpl_data.h"

layout(std430, binding = LSF_BINDING_VPL) readonly buffer lsf_vpl_block
{
    lsf_vpl_data vpls[];
};
layout(location = LSF_LOCATION_VPL) uniform uint vpl_index;

layout(location = 0) out vec4 irradiance_out;
#if LSF_SPECULAR
layout(location = 1) out vec4 specular_out;
#endif

surface vpl_surface(lsf_vpl_data vpl)
{
    surface s;
    s.geometric_normal = vpl.geometric_normal.xyz;
    s.normal = vpl.normal.xyz;
    s.base_color = vpl.base_color.rgb;
    s.metallic = vpl.normal.w;
    s.roughness = vpl.gloss.x;
    s.f0 = vpl.gloss.y;
    s.anisotropy = vpl.gloss.z;
    s.anisotropy_turn = vpl.gloss.w;
    s.unlit = false;
    return s;
}

float luminance(vec3 c)
{
    return dot(c, vec3(0.2126, 0.7152, 0.0722));
}

void main()
{
    lsf_vpl_data vpl = vpls[vpl_index];
    shading_vertex v;
    if (vpl.position.w == 0.0 || !vertex_load(v))
        discard;
    surface x1 = vpl_surface(vpl);
    vec3 to_vpl = vpl.position.xyz - v.position;
    float distance2 = max(dot(to_vpl, to_vpl), LSF_LIGHT_DISTANCE2_MIN);
    vec3 direction = to_vpl * inversesqrt(distance2);
    float cosine_0 = dot(x1.geometric_normal, vpl.to_light.xyz);
    float cosine_3 = -dot(x1.geometric_normal, direction);
    float shading_cosine_0 = dot(x1.normal, vpl.to_light.xyz);
    if (cosine_3 <= 0.0 || cosine_0 <= 0.0 || shading_cosine_0 <= 0.0 ||
        dot(x1.normal, direction) >= 0.0 || dot(v.s.normal, direction) <= 0.0 ||
        dot(v.s.geometric_normal, direction) <= 0.0)
        discard;
    if (shadow_visibility(v.position, v.s.geometric_normal) == 0.0)
        discard;

    float p_e = vpl.geometric_normal.w;
    path_density p = path_density_at(cosine_0, vpl.to_light.w, cosine_3, distance2, p_e,
                                     bundle_pdf(direction) * suppression.w);
    float density = p.vpl + p.bundle;
    float kernel_3 = suppression_kernel(density, cosine_3, distance2);
    /* The rays of a directional light do not part. */
    float kernel_0 = vpl.base_color.w != 0.0
                         ? 0.0
                         : suppression_kernel(density, cosine_0, vpl.to_light.w);
    brdf_value f_1 = brdf_evaluate(x1, -direction, vpl.to_light.xyz, kernel_0 + kernel_3);
    light_parts f_3 = vertex_reflect(v, direction, kernel_3 + suppression.z);

    /* Its density by area is p_e cosine_0 / d0^2, the light's irradiance I shading_cosine_0 / d0^2,
     * and it is seen from x3 under cosine_3 / distance2 for each area. */
    vec3 power = vpl.intensity.rgb * brdf_sum(x1, f_1) *
                 (shading_cosine_0 / cosine_0 * mis_weight(p.vpl, p.bundle) * strategy.w / p_e);
    float geometry = cosine_3 / distance2;
    float bounded = cosine_3 / max(distance2, suppression.y);
    vec3 irradiance = f_3.irradiance * power;
    irradiance_out = vec4(irradiance * bounded, luminance(irradiance) * (geometry - bounded));
#if LSF_SPECULAR
    vec3 specular = f_3.specular * power;
    specular_out = vec4(specular * bounded, luminance(specular) * (geometry - bounded));
#endif
}
