/* The glTF BRDF of a G-buffer surface, split into its two lobes; formulas in shared/brdf.h.
 * Switches LSF_SPECULAR, LSF_SPECULAR_TINT, LSF_COAT, LSF_SHEEN,
 * LSF_ANISOTROPY, LSF_TRANSMISSION; LSF_CLAMP_RADIANCE where samples are sparse. */
#ifndef LSF_LIB_BRDF
#define LSF_LIB_BRDF

#include "lib/branch.glsl"
#include "lib/gbuffer.glsl"
#include "shared/albedo.h"
#if LSF_SHEEN
#include "shared/sheen.h"
#endif

struct brdf_value {
    float diffuse; /* the diffuse lobe is surface_diffuse(s) / pi times this [1] */
    vec3 specular; /* [1/sr] */
};

#if LSF_SCATTER
/* Transmission tint of a thin wall, without the factor for what its surface reflects. */
vec3 wall_tint(surface s)
{
    return s.base_color * (s.transmission * (1.0 - s.metallic));
}
#endif

/* Diffuse reflectance k_d. */
vec3 surface_diffuse(surface s)
{
#if LSF_SCATTER
    if (s.through)
        return vec3(0.0);
#endif
#if LSF_TRANSMISSION
    return (1.0 - s.transmission) * (1.0 - s.metallic) * s.base_color;
#elif LSF_SPECULAR
    return (1.0 - s.metallic) * s.base_color;
#else
    return s.base_color;
#endif
}

/* The larger of the roughnesses along tangent and bitangent. */
float surface_widest_roughness(surface s)
{
#if LSF_ANISOTROPY
    return sqrt(lsf_alpha_along_tangent(s.roughness * s.roughness, s.anisotropy));
#else
    return s.roughness;
#endif
}

/* Number of paths that begin at a visible surface: `range.x` at roughness 0, `range.y` at roughness 1 and where all
 * light passes, because such paths go on from surface to surface and choose at each between passing and reflecting. */
float surface_path_count(surface s, vec2 range)
{
    float spread = surface_widest_roughness(s);
#if LSF_TRANSMISSION
    spread = max(spread, s.transmission);
#endif
    return floor(mix(range.x, range.y, spread) + 0.5);
}

/* Schlick's Fresnel term for the side from which the surface is seen. */
float surface_fresnel(surface s, float f0, float f90, float vh)
{
#if LSF_TRANSMISSION
    return lsf_fresnel_interface_to(f0, f90, vh, s.eta);
#else
    return lsf_fresnel_schlick_to(f0, f90, vh);
#endif
}

/* Share of light that the dielectric does not pass on to the diffuse lobe below it. */
float surface_dielectric_fresnel(surface s, float vh)
{
    return surface_fresnel(s, largest(surface_f0(s)), surface_f90(s), vh);
}

/* f0 and f90 of the specular lobe. Of a wall through which the eye looks: its transmittance at normal incidence,
 * and at grazing angles that of its brightest channel. */
vec3 surface_specular_f0(surface s)
{
#if LSF_SCATTER
    if (s.through)
        return wall_tint(s) * (1.0 - largest(surface_f0(s)));
#endif
    return mix(surface_f0(s), s.base_color, s.metallic);
}

float surface_specular_f90(surface s)
{
#if LSF_SCATTER
    if (s.through)
        return largest(wall_tint(s)) * (1.0 - surface_f90(s));
#endif
    return 1.0 - (1.0 - surface_f90(s)) * (1.0 - s.metallic);
}

/* Fresnel term of the specular lobe, or transmittance of such a wall, where view and half vector meet under the
 * cosine vh. */
vec3 surface_specular_fresnel(surface s, float vh)
{
#if LSF_SCATTER
    if (s.through)
        return wall_tint(s) * (1.0 - surface_dielectric_fresnel(s, vh));
#endif
    vec3 f0 = surface_specular_f0(s);
    float f90 = surface_specular_f90(s);
    return vec3(surface_fresnel(s, f0.r, f90, vh), surface_fresnel(s, f0.g, f90, vh),
                surface_fresnel(s, f0.b, f90, vh));
}

/* The view for which the lobes are evaluated. A thin wall transmits by its reflection lobe mirrored at its plane
 * (KHR_materials_transmission), so that the view is mirrored instead. */
vec3 surface_view(surface s, vec3 to_viewer)
{
#if LSF_SCATTER
    if (s.through)
        return to_viewer - 2.0 * dot(to_viewer, s.normal) * s.normal;
#endif
    return to_viewer;
}

vec3 brdf_sum(surface s, brdf_value f)
{
    return surface_diffuse(s) * (f.diffuse / LSF_PI) + f.specular;
}

/* A shading normal may face away from the viewer. The view is then lifted to its horizon, because the lobe is
 * unbounded for negative cosines. */
vec3 lift_to_horizon(vec3 view, vec3 normal)
{
    float nv = dot(normal, view);
    return nv >= LSF_COSINE_MIN ? view : normalize(view + (LSF_COSINE_MIN - nv) * normal);
}

/* Factor by which a sheen attenuates the layers below it, from the cosines of both directions. */
float sheen_leaves(surface s, float nv, float nl)
{
#if LSF_SHEEN
    return lsf_sheen_leaves(largest(s.sheen.rgb), lsf_sheen_albedo(nv, s.sheen.a),
                            lsf_sheen_albedo(nl, s.sheen.a));
#else
    return 1.0;
#endif
}

#if LSF_SHEEN
vec3 sheen_reflects(surface s, vec3 view, vec3 light)
{
    float nv = clamp(dot(s.normal, view), LSF_COSINE_MIN, 1.0), nl = clamp(dot(s.normal, light), LSF_COSINE_MIN, 1.0);
#if LSF_SCATTER
    if (s.through)
        return vec3(0.0);
#endif
    vec3 nxh = cross(s.normal, normalize(view + light));
    float most = max(lsf_sheen_albedo(nv, s.sheen.a), lsf_sheen_albedo(nl, s.sheen.a));
    return s.sheen.rgb * (lsf_sheen_lobe(nv, nl, dot(nxh, nxh), s.sheen.a) / max(most, 1.0));
}
#endif

/* Factor by which a clear coat attenuates the layers below it; `view` and `light` are unit vectors. */
float coat_passes(surface s, vec3 view, vec3 light)
{
#if LSF_COAT
    return lsf_coat_passes(s.coat, dot(s.coat_normal, view)) * lsf_coat_passes(s.coat, dot(s.coat_normal, light));
#else
    return 1.0;
#endif
}

/* The least alpha for samples that are `kernel` apart (brdf_evaluate), at most 1, the roughest lobe. `reflects` is
 * the Fresnel term and `spread` = sqrt(alpha^2 + (1 - alpha^2) nv^2), both for the view's mirror image, where V nl
 * = 1 / (4 spread). */
float kernel_alpha(float kernel, float reflects, float spread)
{
    return min(sqrt(kernel * reflects / (4.0 * LSF_PI * spread)), 1.0);
}

#if LSF_COAT
/* Reflection of the coat itself, for light at the cosine `nl` to the surface's own normal. `kernel` as in
 * brdf_evaluate. */
float coat_reflects(surface s, vec3 view_direction, vec3 light, float nl, float kernel)
{
    vec3 n = s.coat_normal, view = lift_to_horizon(view_direction, n);
    float coat_nl = dot(n, light);
    if (s.coat == 0.0 || coat_nl <= 0.0 || nl <= 0.0)
        return 0.0;
#if LSF_SCATTER
    if (s.through)
        return 0.0;
#endif
    float nv = max(dot(n, view), LSF_COSINE_MIN), alpha = lsf_alpha_from_roughness(s.coat_roughness);
    vec3 h = normalize(view + light);
    float reflects = s.coat * lsf_fresnel_schlick(LSF_COAT_F0, clamp(dot(view, h), 0.0, 1.0));
    float spread = sqrt(mix(nv * nv, 1.0, alpha * alpha));
    float wide = kernel_alpha(kernel, s.coat * lsf_fresnel_schlick(LSF_COAT_F0, nv), spread);
    BRANCH(kernel > 0.0 && wide > alpha) {
        reflects *= lsf_specular_albedo(LSF_COAT_F0, 1.0, nv, sqrt(alpha)) /
                    lsf_specular_albedo(LSF_COAT_F0, 1.0, nv, sqrt(wide));
        alpha = wide;
    }
    vec3 nxh = cross(n, h);
    float d = lsf_ggx_d(clamp(dot(n, h), 0.0, 1.0), dot(nxh, nxh), alpha);
    return reflects * d * lsf_ggx_v(coat_nl, nv, alpha) * (coat_nl / nl);
}
#endif

#if LSF_SPECULAR
/* The specular lobe: Fresnel term, and distribution and visibility apart. */
struct specular_lobe {
    vec3 normal, tangent, bitangent, h, view, light;
    float nl, nv;
};

float lobe_distribution(specular_lobe l, float alpha_t, float alpha)
{
    float nh = clamp(dot(l.normal, l.h), 0.0, 1.0);
#if LSF_ANISOTROPY
    return lsf_ggx_d_anisotropic(nh, dot(l.tangent, l.h), dot(l.bitangent, l.h), alpha_t, alpha);
#else
    vec3 nxh = cross(l.normal, l.h);
    return lsf_ggx_d(nh, dot(nxh, nxh), alpha);
#endif
}

/* `spread` of kernel_alpha. With two alphas it is taken along tangent and bitangent. */
float mirror_spread(specular_lobe l, float alpha_t, float alpha)
{
#if LSF_ANISOTROPY
    return length(vec3(alpha_t * dot(l.tangent, l.view), alpha * dot(l.bitangent, l.view), l.nv));
#else
    return sqrt(mix(l.nv * l.nv, 1.0, alpha * alpha));
#endif
}

float lobe_visibility(specular_lobe l, float alpha_t, float alpha)
{
#if LSF_ANISOTROPY
    return lsf_ggx_v_anisotropic(l.nl, l.nv, dot(l.tangent, l.light), dot(l.bitangent, l.light),
                                 dot(l.tangent, l.view), dot(l.bitangent, l.view), alpha_t, alpha);
#else
    return lsf_ggx_v(l.nl, l.nv, alpha);
#endif
}
#endif

#if LSF_SPECULAR
/* Directional albedo of the lobe by the product of both alphas; an approximation for views at an angle to the
 * tangent. */
vec3 lobe_albedo(vec3 f0, float f90, float nv, float alpha2)
{
    float roughness = sqrt(sqrt(alpha2));
    return f0 * lsf_specular_albedo(1.0, 0.0, nv, roughness) + f90 * lsf_specular_albedo(0.0, 1.0, nv, roughness);
}
#endif

/* Both directions are unit vectors that point away from the surface, the view as by surface_view; the specular lobe
 * is zero where light comes from behind the normal.
 *
 * `kernel` is m'/d [sr]: light comes in samples of density d, and the distribution D, taken as a density kernel over
 * m = m' F V nl of them, must not exceed d / m (Tokuyoshi and Ogaki 2012, equation 9). For GGX, whose peak is
 * 1 / (pi alpha_t alpha_b), the roughness is raised until that holds, with F V nl of the view's mirror image, so that
 * all samples of a density see the same lobe; the lobe is then scaled to the directional albedo of the narrow one.
 * With LSF_CLAMP_RADIANCE, D is clamped to the bound instead. 0: exact light; where it is a constant, compilers leave
 * the widening out. */
brdf_value brdf_evaluate(surface s, vec3 view_direction, vec3 light, float kernel)
{
    brdf_value f;
    f.specular = vec3(0.0);
#if LSF_SPECULAR
    specular_lobe l;
    l.normal = s.normal;
    l.light = light;
    l.view = lift_to_horizon(view_direction, s.normal);
    l.nl = dot(s.normal, light);
    l.nv = max(dot(s.normal, l.view), LSF_COSINE_MIN);
    l.h = normalize(l.view + light);
    float vh = clamp(dot(l.view, l.h), 0.0, 1.0);
    f.diffuse = 1.0 - surface_dielectric_fresnel(s, vh);
    if (l.nl > 0.0) {
        float alpha = lsf_alpha_from_roughness(s.roughness);
        float alpha_t = alpha;
#if LSF_ANISOTROPY
        vec3 basis_t, basis_b;
        orthonormal_basis(s.normal, basis_t, basis_b);
        float angle = 2.0 * LSF_PI * s.anisotropy_angle;
        l.tangent = cos(angle) * basis_t + sin(angle) * basis_b;
        l.bitangent = cross(s.normal, l.tangent);
        alpha_t = lsf_alpha_along_tangent(alpha, s.anisotropy);
#endif
        vec3 f0 = surface_specular_f0(s);
        float f90 = surface_specular_f90(s);
        vec3 fresnel = surface_specular_fresnel(s, vh);
        float v = lobe_visibility(l, alpha_t, alpha);
#if defined(LSF_CLAMP_RADIANCE) && LSF_CLAMP_RADIANCE
        float sharpest = kernel * largest(fresnel) * v * l.nl / LSF_PI;
        float d = lobe_distribution(l, alpha_t, alpha);
        d = sharpest > 0.0 ? min(d, 1.0 / (LSF_PI * sharpest)) : d;
#else
        vec3 mirrored = surface_specular_fresnel(s, l.nv);
        float wide = kernel_alpha(kernel, largest(mirrored), mirror_spread(l, alpha_t, alpha));
        BRANCH(kernel > 0.0 && wide > min(alpha, alpha_t)) {
            vec3 narrow_albedo = lobe_albedo(f0, f90, l.nv, alpha * alpha_t);
            alpha = max(alpha, wide);
            alpha_t = max(alpha_t, wide);
            v = lobe_visibility(l, alpha_t, alpha);
#if LSF_TRANSMISSION
            if (s.eta >= 1.0) /* from within, the albedo is another */
#endif
                fresnel *= narrow_albedo / max(lobe_albedo(f0, f90, l.nv, alpha * alpha_t), 1e-6);
        }
        float d = lobe_distribution(l, alpha_t, alpha);
#endif
        f.specular = d * v * fresnel;
    }
#if LSF_SHEEN
    if (l.nl > 0.0 && s.sheen.rgb != vec3(0.0)) {
        float leaves = sheen_leaves(s, l.nv, l.nl);
        f.diffuse *= leaves;
        f.specular = f.specular * leaves + sheen_reflects(s, l.view, light);
    }
#endif
#if LSF_COAT
    float passes = coat_passes(s, view_direction, light);
    f.diffuse *= passes;
    f.specular = f.specular * passes + coat_reflects(s, view_direction, light, l.nl, kernel);
#endif
#else
    f.diffuse = 1.0;
#endif
    return f;
}

#endif
