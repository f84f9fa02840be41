/* Connects the vertices to one VPL: path (x0, x1, x3), or (x0, x1, x2, x3) with LSF_DEEP; without x0 where x1
 * emits light itself. Both parts of the light are added to the targets; alpha holds the luminance that a bound
 * removed. Switches LSF_PUNCTUAL and LSF_EMITTERS: there are VPLs of that kind. */
#include "lib/bundle_pdf.glsl"
#include "lib/luminance.glsl"
#include "lib/mis.glsl"
#include "lib/shading_vertex.glsl"
#include "lib/shadow.glsl"
#include "lib/straight.glsl"
#include "shared/light.h"
#include "shared/vpl_data.h"

layout(binding = LSF_UNIT_VPL) uniform samplerBuffer vpl_fetch;
layout(location = LSF_LOCATION_VPL) uniform uint vpl_index;

layout(location = 0) out vec4 irradiance_out;
#if LSF_SPECULAR
layout(location = 1) out vec4 specular_out;
#endif

/* Software GL fetches texels for all lanes at once, storage buffers lane by lane. */
lsf_vpl_data current_vpl()
{
    vec4 t[7];
    for (int i = 0; i < 7; i++)
        t[i] = texelFetch(vpl_fetch, 7 * int(vpl_index) + i);
    return lsf_vpl_data(t[0], t[1], t[2], t[3], t[4], t[5], t[6]);
}

/* Intensity of the VPL towards the vertex per unit of solid angle that it covers there, divided by its density by
 * area, times its weight. */
struct vpl_light {
    vec3 power;
    float kernel_3; /* kernel of suppression at the vertex */
    float density;  /* of VPLs by area */
};

#if LSF_PUNCTUAL
surface vpl_surface(lsf_vpl_data vpl)
{
    surface s;
    s.geometric_normal = vpl.geometric_normal.xyz;
    s.normal = vpl.normal.xyz;
    s.base_color = vpl.base_color.rgb;
    s.metallic = vpl.normal.w;
    s.roughness = vpl.specular_params.x;
    s.f0 = vpl.specular_params.y;
    s.anisotropy = vpl.specular_params.z;
    s.anisotropy_angle = vpl.specular_params.w;
    s.unlit = false;
    lobes_none(s);
#if LSF_TRANSMISSION
    transmission_none(s);
    s.transmission = vpl.intensity.w;
#endif
    return s;
}

vpl_light reflected_power(lsf_vpl_data vpl, vec3 direction, float cosine_3, float distance2)
{
    vpl_light l;
    l.power = vec3(0.0);
    l.kernel_3 = 0.0;
    l.density = 1.0;
    surface x1 = vpl_surface(vpl);
    float cosine_0 = dot(x1.geometric_normal, vpl.to_light.xyz);
    float shading_cosine_0 = dot(x1.normal, vpl.to_light.xyz);
    if (cosine_0 <= 0.0 || shading_cosine_0 <= 0.0)
        return l;
    float p_e = vpl.geometric_normal.w;
    path_density p = path_density_at(cosine_0, vpl.to_light.w, cosine_3, distance2, p_e,
                                     bundle_pdf(direction) * suppression.w);
    l.density = p.vpl;
    float density = p.vpl + p.bundle;
    l.kernel_3 = suppression_kernel(density, cosine_3, distance2);
    /* The rays of a directional light are parallel, so that their kernel is 0. */
    float kernel_0 = vpl.base_color.w != 0.0
                         ? 0.0
                         : suppression_kernel(density, cosine_0, vpl.to_light.w);
    brdf_value f_1 = brdf_evaluate(x1, -direction, vpl.to_light.xyz, hidden_kernel(kernel_0, l.kernel_3));
    /* Its density by area is p_e cosine_0 / d0^2, the light's irradiance I shading_cosine_0 / d0^2. */
    l.power = vpl.intensity.rgb * brdf_sum(x1, f_1) *
              (shading_cosine_0 / cosine_0 * mis_weight(p.vpl, p.bundle) / p_e);
    return l;
}
#endif

#if LSF_EMITTERS
vpl_light emitted_power(lsf_vpl_data vpl, vec3 direction, float cosine_3, float distance2)
{
    path_density p =
        emitter_density_at(vpl.intensity.w, cosine_3, distance2, bundle_pdf(direction));
    vpl_light l;
    l.kernel_3 = suppression_kernel(p.vpl + p.bundle, cosine_3, distance2);
    l.density = p.vpl;
    l.power = vpl.intensity.rgb * (mis_weight(p.vpl, p.bundle) / vpl.geometric_normal.w);
    return l;
}
#endif

void main()
{
    lsf_vpl_data vpl = current_vpl();
    shading_vertex v;
    if (vpl.position.w == LSF_VPL_DARK || !vertex_load(v))
        discard;
    vec3 to_vpl = vpl.position.xyz - v.position;
    float distance2 = max(dot(to_vpl, to_vpl), LSF_LIGHT_DISTANCE2_MIN);
    vec3 direction = to_vpl * inversesqrt(distance2);
    float cosine_3 = -dot(vpl.geometric_normal.xyz, direction);
    if (cosine_3 <= 0.0 || dot(v.s.normal, direction) <= 0.0 ||
        dot(v.s.geometric_normal, direction) <= 0.0)
        discard;
    shadow_raster_error = v.raster_error;
    if (shadow_visibility(v.position, v.s.geometric_normal) == 0.0)
        discard;
#if LSF_PUNCTUAL && LSF_EMITTERS
    vpl_light l;
    if (vpl.position.w == LSF_VPL_EMITS)
        l = emitted_power(vpl, direction, cosine_3, distance2);
    else
        l = reflected_power(vpl, direction, cosine_3, distance2);
#elif LSF_EMITTERS
    vpl_light l = emitted_power(vpl, direction, cosine_3, distance2);
#else
    vpl_light l = reflected_power(vpl, direction, cosine_3, distance2);
#endif

    /* Seen from x3, an area covers the solid angle cosine_3 / distance2 per unit. */
    light_parts f_3 = vertex_reflect(v, direction, l.kernel_3 + suppression.z);
    vec3 power = l.power * strategy.w;
#if LSF_SHADOW_TINT
    power *= shadow_tint(v.position, v.s.geometric_normal, straight_tint_or_one(v.s, direction));
#endif
    float geometry = cosine_3 / distance2;
    float bounded = cosine_3 / max(distance2, suppression.y / max(l.density, 1e-30));
    vec3 irradiance = f_3.irradiance * power;
    irradiance_out = vec4(irradiance * bounded, luminance(irradiance) * (geometry - bounded));
#if LSF_SPECULAR
    vec3 specular = f_3.specular * power;
    specular_out = vec4(specular * bounded, luminance(specular) * (geometry - bounded));
#endif
}
