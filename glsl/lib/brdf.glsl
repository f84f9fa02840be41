/* The glTF BRDF of a G-buffer surface, split into its two lobes; formulas in shared/brdf.h.
 * Switches LSF_SPECULAR, LSF_ANISOTROPY. */
#ifndef LSF_LIB_BRDF
#define LSF_LIB_BRDF

#include "lib/gbuffer.glsl"

struct brdf_value {
    vec3 diffuse, specular; /* [1/sr] */
};

/* A bent normal may look away from the viewer; the view is then lifted to its horizon, for with a
 * negative cosine the lobe is unbounded. */
vec3 lift_to_horizon(vec3 view, vec3 normal)
{
    float nv = dot(normal, view);
    return nv >= LSF_COSINE_MIN ? view : normalize(view + (LSF_COSINE_MIN - nv) * normal);
}

/* Both directions are unit vectors that point away from the surface; the specular lobe is zero
 * where light comes from behind the normal. */
brdf_value brdf_evaluate(surface s, vec3 view_direction, vec3 light)
{
    brdf_value f;
    float nl = dot(s.normal, light);
    vec3 view = lift_to_horizon(view_direction, s.normal);
    float nv = max(dot(s.normal, view), LSF_COSINE_MIN);
    f.specular = vec3(0.0);
#if LSF_SPECULAR
    vec3 h = normalize(view + light);
    float vh = clamp(dot(view, h), 0.0, 1.0);
    f.diffuse = (1.0 - s.metallic) * (1.0 - lsf_fresnel_schlick(s.f0, vh)) / LSF_PI * s.base_color;
    if (nl > 0.0) {
        float alpha = lsf_alpha_from_roughness(s.roughness);
        float nh = clamp(dot(s.normal, h), 0.0, 1.0);
        float dv;
#if LSF_ANISOTROPY
        vec3 basis_t, basis_b;
        orthonormal_basis(s.normal, basis_t, basis_b);
        float angle = 2.0 * LSF_PI * s.anisotropy_turn;
        vec3 t = cos(angle) * basis_t + sin(angle) * basis_b;
        vec3 b = cross(s.normal, t);
        float alpha_t = lsf_alpha_along_tangent(alpha, s.anisotropy);
        dv = lsf_ggx_d_anisotropic(nh, dot(t, h), dot(b, h), alpha_t, alpha) *
             lsf_ggx_v_anisotropic(nl, nv, dot(t, light), dot(b, light), dot(t, view),
                                   dot(b, view), alpha_t, alpha);
#else
        vec3 nxh = cross(s.normal, h);
        dv = lsf_ggx_d(nh, dot(nxh, nxh), alpha) * lsf_ggx_v(nl, nv, alpha);
#endif
        vec3 f0 = mix(vec3(s.f0), s.base_color, s.metallic);
        vec3 fresnel = vec3(lsf_fresnel_schlick(f0.r, vh), lsf_fresnel_schlick(f0.g, vh),
                            lsf_fresnel_schlick(f0.b, vh));
        f.specular = dv * fresnel;
    }
#else
    f.diffuse = s.base_color / LSF_PI;
#endif
    return f;
}

#endif
