/* Directions sampled from the BRDF of lib/brdf.glsl: the diffuse lobe by the cosine, the specular lobe by visible
 * normals, one of them chosen by Schlick's Fresnel term. The density is that of both together, whichever was
 * chosen. With LSF_TRANSMISSION a microfacet of the specular lobe may transmit instead of reflecting.
 * reference/bsdf.c and math/sampling.c do the same. Switches LSF_SPECULAR, LSF_ANISOTROPY, LSF_TRANSMISSION. */
#ifndef LSF_LIB_BRDF_SAMPLE
#define LSF_LIB_BRDF_SAMPLE

#include "lib/brdf.glsl"
#include "lib/cosine.glsl"
#include "lib/visible_normal.glsl"

/* Least probability of each lobe where both reflect: neither can stand in for the other. */
#define LOBE_LEAST 0.1

struct brdf_sampler {
    vec3 normal, tangent, bitangent;
#if LSF_SPECULAR
    vec3 view; /* in this frame, above its horizon */
    float alpha_t, alpha;
    float specular; /* probability of choosing this lobe */
#endif
#if LSF_COAT
    float coat; /* probability of choosing the coat's lobe, before all others */
    vec3 coat_tangent, coat_bitangent, coat_normal, coat_view; /* the view in this frame, above its horizon */
    float coat_alpha;
#endif
#if LSF_TRANSMISSION
    vec2 dielectric, reflecting; /* dielectric's reflectance f0 and f90; luminance of the lobe's f0 and f90 */
    float passing;               /* luminance of what is transmitted where nothing is reflected */
    float eta;
#endif
};

#if LSF_TRANSMISSION
float brdf_interface(brdf_sampler p, vec2 f, float vh)
{
    return lsf_fresnel_interface_to(f.x, f.y, vh, p.eta);
}

/* Probability with which a microfacet that is drawn reflects rather than transmits. */
float brdf_reflected_share(brdf_sampler p, float vh)
{
    float passes = p.passing * (1.0 - brdf_interface(p, p.dielectric, vh));
    float reflects = brdf_interface(p, p.reflecting, vh);
    return passes > 0.0 ? reflects / (reflects + passes) : 1.0;
}
#endif

/* `view` as for brdf_evaluate. With `both`, diffuse and specular light are summed apart, so that each lobe counts
 * even if the surface reflects nothing by it. */
brdf_sampler brdf_sampler_of(surface s, vec3 view, bool both)
{
    brdf_sampler p;
    p.normal = s.normal;
    orthonormal_basis(s.normal, p.tangent, p.bitangent);
#if LSF_SPECULAR
    p.alpha = p.alpha_t = lsf_alpha_from_roughness(s.roughness);
#if LSF_ANISOTROPY
    float angle = 2.0 * LSF_PI * s.anisotropy_angle;
    p.tangent = cos(angle) * p.tangent + sin(angle) * p.bitangent;
    p.bitangent = cross(p.normal, p.tangent);
    p.alpha_t = lsf_alpha_along_tangent(p.alpha, s.anisotropy);
#endif
    vec3 lifted = lift_to_horizon(view, s.normal);
    p.view = vec3(dot(p.tangent, lifted), dot(p.bitangent, lifted),
                  max(dot(p.normal, lifted), LSF_COSINE_MIN));
    /* The share of light that each lobe would reflect if the surface were smooth. */
    const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
    float f0 = dot(surface_specular_f0(s), luminance), f90 = surface_specular_f90(s);
    float nv = min(p.view.z, 1.0), through = 1.0 - surface_dielectric_fresnel(s, nv);
    float specular = surface_fresnel(s, f0, f90, nv);
    float matte = dot(surface_diffuse(s), luminance) * (1.0 - largest(surface_f0(s)));
    float diffuse = matte > 0.0 ? dot(surface_diffuse(s), luminance) * through : 0.0;
#if LSF_SHEEN
    /* A sheen is broad and is sampled by the diffuse lobe. */
    float sheen = dot(s.sheen.rgb, luminance);
    matte += sheen;
    diffuse += sheen * min(lsf_sheen_albedo(nv, s.sheen.a), 1.0);
#endif
#if LSF_TRANSMISSION
    p.dielectric = vec2(largest(surface_f0(s)), surface_f90(s));
    p.reflecting = vec2(f0, f90);
    /* Where light passes straight on, stochastic transparency has already decided whether it does. */
    p.passing =
        LSF_STRAIGHT != 0 ? 0.0 : s.transmission * (1.0 - s.metallic) * dot(s.base_color, luminance);
    p.eta = s.eta;
    specular += p.passing * through;
#endif
    p.specular = clamp(specular / max(specular + diffuse, 1e-6), LOBE_LEAST, 1.0 - LOBE_LEAST);
    if (!both && matte <= 0.0)
        p.specular = 1.0;
#if LSF_COAT
    p.coat_normal = s.coat_normal;
    orthonormal_basis(s.coat_normal, p.coat_tangent, p.coat_bitangent);
    vec3 above = lift_to_horizon(view, s.coat_normal);
    p.coat_view = vec3(dot(p.coat_tangent, above), dot(p.coat_bitangent, above),
                       max(dot(p.coat_normal, above), LSF_COSINE_MIN));
    p.coat_alpha = lsf_alpha_from_roughness(s.coat_roughness);
    float reflects = 1.0 - lsf_coat_passes(s.coat, p.coat_view.z);
    float below = (1.0 - reflects) * (specular + diffuse);
    p.coat = s.coat == 0.0 ? 0.0 : clamp(reflects / (reflects + below), LOBE_LEAST, 1.0 - LOBE_LEAST);
#endif
#endif
    return p;
}

#if LSF_SPECULAR
/* Lets it draw from the specular lobes alone. Sheen is as broad as a diffuse lobe, and is found by that. */
void brdf_keep_lobes(inout brdf_sampler p)
{
#if LSF_SHEEN
    p.specular = 1.0 - LOBE_LEAST;
#else
    p.specular = 1.0;
#endif
#if LSF_TRANSMISSION
    p.passing = 0.0;
#endif
}
#endif

/* The unit vector of the direction that has these coordinates in the sampler's frame. */
vec3 brdf_from_frame(brdf_sampler p, vec3 local)
{
    return normalize(local.x * p.tangent + local.y * p.bitangent + local.z * p.normal);
}

#if LSF_SPECULAR
vec3 brdf_visible_normal(brdf_sampler p, vec2 disc)
{
    return visible_normal(p.view, p.alpha_t, p.alpha, disc);
}
#endif

#if LSF_TRANSMISSION
/* The direction from which a microfacet of normal h transmits light to the view, in the sampler's frame. It lies below
 * the horizon; if not, the microfacet sends the light back to the side that it comes from, as rough surfaces do. `gain`:
 * f cos / p of visible normals without the Fresnel term, which is the masking of the light's direction. */
vec3 brdf_transmitted(brdf_sampler p, vec3 h, float vh, out float gain)
{
    vec3 local;
    if (p.eta == 1.0) {
        local = 2.0 * vh * h - p.view;
        vec3 stretched = vec3(p.alpha_t, p.alpha, 1.0) * p.view;
        gain = 2.0 * local.z * (p.view.z + length(stretched)) *
               lsf_ggx_v_anisotropic(local.z, p.view.z, local.x, local.y, p.view.x, p.view.y, p.alpha_t,
                                     p.alpha);
        local.z = -local.z;
    } else {
        local = (vh / p.eta - lsf_refracted_cosine(vh, p.eta)) * h - p.view / p.eta;
        gain = lsf_ggx_g1(-local.z, local.x, local.y, p.alpha_t, p.alpha);
    }
    return local;
}

/* What sheen and coat leave of light that passes the surface along a direction. */
float brdf_layers_pass(brdf_sampler p, surface s, vec3 direction)
{
    float left = sheen_leaves(s, p.view.z, abs(dot(p.normal, direction)));
#if LSF_COAT
    left *= lsf_coat_passes(s.coat, p.coat_view.z) * lsf_coat_passes(s.coat, abs(dot(p.coat_normal, direction)));
#endif
    return left;
}

/* Whether the numbers that brdf_draw would take choose transmission; then the direction and its weight f cos / p,
 * with p over all strategies that may draw the direction. The weight is 0 where the microfacet does not transmit. */
bool brdf_pass(brdf_sampler p, surface s, vec3 u, out vec3 direction, out vec3 weight)
{
    weight = vec3(0.0);
    direction = -p.normal;
    float to_coat = 0.0;
#if LSF_COAT
    to_coat = p.coat;
    if (u.z < p.coat)
        return false;
    u.z = (u.z - p.coat) / (1.0 - p.coat);
#endif
    if (u.z >= p.specular)
        return false;
    vec3 h = brdf_visible_normal(p, disc_draw(u.xy));
    float vh = min(dot(p.view, h), 1.0);
    float share = brdf_reflected_share(p, vh);
    if (u.z < p.specular * share)
        return false;
    float gain;
    vec3 local = brdf_transmitted(p, h, vh, gain);
    if (local.z >= 0.0)
        return true;
    direction = brdf_from_frame(p, local);
    float passes = s.transmission * (1.0 - s.metallic) * (1.0 - brdf_interface(p, p.dielectric, vh));
    weight = s.base_color * (passes * gain / ((1.0 - to_coat) * p.specular * (1.0 - share)));
    weight *= brdf_layers_pass(p, s, direction);
    return true;
}
#endif

/* Draws a unit vector; `u`: three numbers in [0, 1). It may lie below the horizon. */
vec3 brdf_draw(brdf_sampler p, vec3 u)
{
    vec2 disc = disc_draw(u.xy);
    vec3 local = cosine_direction(disc);
#if LSF_COAT
    if (u.z < p.coat) {
        vec3 h = visible_normal(p.coat_view, p.coat_alpha, p.coat_alpha, disc);
        local = 2.0 * dot(p.coat_view, h) * h - p.coat_view;
        return normalize(local.x * p.coat_tangent + local.y * p.coat_bitangent + local.z * p.coat_normal);
    }
    u.z = (u.z - p.coat) / (1.0 - p.coat);
#endif
#if LSF_SPECULAR
    if (u.z < p.specular) {
        vec3 h = brdf_visible_normal(p, disc);
        local = 2.0 * dot(p.view, h) * h - p.view;
    }
#endif
    return brdf_from_frame(p, local);
}

/* Density [1/sr] of a direction above the horizon. */
float brdf_pdf(brdf_sampler p, vec3 direction)
{
    float nl = dot(p.normal, direction);
#if LSF_SPECULAR
    vec3 h = normalize(p.view + vec3(dot(p.tangent, direction), dot(p.bitangent, direction), nl));
    vec3 stretched = vec3(p.alpha_t, p.alpha, 1.0) * p.view;
    float d = lsf_ggx_d_anisotropic(h.z, h.x, h.y, p.alpha_t, p.alpha);
    /* D G1 / (4 nv) */
    float specular = 0.5 * d / (p.view.z + length(stretched));
#if LSF_TRANSMISSION
    specular *= brdf_reflected_share(p, clamp(dot(p.view, h), 0.0, 1.0));
#endif
    float pdf = mix(nl / LSF_PI, specular, p.specular);
#if LSF_COAT
    vec3 l = vec3(dot(p.coat_tangent, direction), dot(p.coat_bitangent, direction),
                  dot(p.coat_normal, direction));
    vec3 coat_h = normalize(p.coat_view + l);
    float coat = 0.5 * lsf_ggx_d_anisotropic(coat_h.z, coat_h.x, coat_h.y, p.coat_alpha, p.coat_alpha) /
                 (p.coat_view.z + length(vec3(p.coat_alpha, p.coat_alpha, 1.0) * p.coat_view));
    pdf = mix(pdf, l.z > 0.0 ? coat : 0.0, p.coat);
#endif
    return pdf;
#else
    return nl / LSF_PI;
#endif
}

/* Turns a ray along `direction` that meets the surface into one that goes on from it, drawn from the BRDF with the
 * density `pdf`, and multiplies its weight into `through`. False: no light is reflected from there. */
bool brdf_follow(surface s, vec3 u, inout vec3 direction, inout vec3 through, out float pdf)
{
    vec3 view = -direction;
    brdf_sampler p = brdf_sampler_of(s, view, false);
    direction = brdf_draw(p, u);
    pdf = brdf_pdf(p, direction);
    float cosine = dot(s.normal, direction);
    if (cosine <= 0.0 || dot(s.geometric_normal, direction) <= 0.0)
        return false;
    through *= brdf_sum(s, brdf_evaluate(s, view, direction, 0.0)) * (cosine / pdf);
    return true;
}

#endif
