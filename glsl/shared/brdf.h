/* The glTF 2.0 metallic-roughness BRDF, one definition for the shaders and for the reference.
 * glTF 2.0 specification, appendix B; KHR_materials_ior; KHR_materials_anisotropy;
 * KHR_materials_specular; KHR_materials_clearcoat; KHR_materials_transmission;
 * KHR_materials_volume.
 *
 *   f = (1 - metallic) (1 - F(f0_dielectric)) ((1 - t) base / pi  +  t base f_t)  +  F(f0) V D
 *   f0_dielectric = ((ior - 1) / (ior + 1))^2,  f0 = mix(f0_dielectric, base, metallic)
 *
 * KHR_materials_specular tints and weights the dielectric's reflection: f0_dielectric = w min(tint
 * ((ior - 1) / (ior + 1))^2, 1), which grows to w at grazing angles; the lobes below are attenuated
 * by the largest of its channels. A clear coat (KHR_materials_clearcoat) of weight w reflects w
 * F_c(v.h) V D with a normal and a roughness of its own; light passes it twice, so that the layers
 * below are multiplied by (1 - w F_c(n.v)) (1 - w F_c(n.l)): the extension's own sum has the first
 * of the two factors alone and is not reciprocal.
 *
 * F: Schlick, D: Trowbridge-Reitz (GGX), V: height-correlated Smith visibility, G / (4 nl nv).
 * t is the material's transmission and f_t the specular lobe on the surface's other side: for a
 * thin wall the mirrored reflection lobe; for a medium, Walter, Marschner, Li and Torrance 2007,
 * "Microfacet Models for Refraction through Rough Surfaces". Seen from within a denser medium, F is
 * that of the angle outside, and 1 where light cannot leave.
 *
 * All radiance is divided by the square of the index of the medium that it is in: it is then the
 * same on both sides of a surface that transmits all light (E. Veach 1997, section 5.2), and
 * unchanged for lights and cameras in air.
 *
 * All cosines are of unit vectors and clamped by the caller to (0, 1]; every function stays finite
 * there for alpha >= LSF_ALPHA_MIN. `h` is the half vector, `t` and `b` the tangent frame. */
#ifndef LSF_SHARED_BRDF_H
#define LSF_SHARED_BRDF_H

#include "shared/shared.h"

#define LSF_PI 3.14159265358979323846f

/* Floor of alpha = roughness^2: roughness 0.0316. D then peaks at 1 / (pi alpha^2) = 3.2e5. Below
 * it, a punctual light's highlight is too narrow for any pixel to resolve. */
#define LSF_ALPHA_MIN 0.001f

/* Floor of cosines that stand in a denominator. */
#define LSF_COSINE_MIN 1e-4f

LSF_SHARED_FUNCTION float lsf_alpha_from_roughness(float roughness)
{
    return max(roughness * roughness, LSF_ALPHA_MIN);
}

/* KHR_materials_anisotropy: alpha along the tangent; along the bitangent it remains `alpha`. */
LSF_SHARED_FUNCTION float lsf_alpha_along_tangent(float alpha, float strength)
{
    return alpha + (1.0f - alpha) * strength * strength;
}

LSF_SHARED_FUNCTION float lsf_f0_from_ior(float ior)
{
    float r = (ior - 1.0f) / (ior + 1.0f);
    return r * r;
}

LSF_SHARED_FUNCTION float lsf_fresnel_schlick(float f0, float vh)
{
    float m = 1.0f - vh;
    float m2 = m * m;
    return f0 + (1.0f - f0) * (m2 * m2 * m);
}

/* The same, reaching f90 at grazing angles. */
LSF_SHARED_FUNCTION float lsf_fresnel_schlick_to(float f0, float f90, float vh)
{
    float m = 1.0f - vh;
    float m2 = m * m;
    return f0 + (f90 - f0) * (m2 * m2 * m);
}

/* Rays are not refracted by indices nearer to 1 than this: the half vector of the directions on
 * both sides has lost too many digits. */
#define LSF_SPECULAR_PATH_MIN (1.0f / 128.0f)

/* Index behind a surface over the index in front of it; `ior` is that of the medium behind the
 * surface's front. 1: rays go straight on. */
LSF_SHARED_FUNCTION float lsf_relative_ior(float ior, bool front)
{
    if (ior < 1.0f + LSF_SPECULAR_PATH_MIN)
        return 1.0f;
    return front ? ior : 1.0f / ior;
}

/* Cosine on the far side of a surface for a ray that arrives with cosine vh: Snell's law; 0:
 * total reflection. */
LSF_SHARED_FUNCTION float lsf_refracted_cosine(float vh, float eta)
{
    return sqrt(max(0.0f, 1.0f - (1.0f - vh * vh) / (eta * eta)));
}

/* Schlick's term for a surface that light reaches from either side. */
LSF_SHARED_FUNCTION float lsf_fresnel_interface(float f0, float vh, float eta)
{
    return lsf_fresnel_schlick(f0, eta < 1.0f ? lsf_refracted_cosine(vh, eta) : vh);
}

LSF_SHARED_FUNCTION float lsf_fresnel_interface_to(float f0, float f90, float vh, float eta)
{
    return lsf_fresnel_schlick_to(f0, f90, eta < 1.0f ? lsf_refracted_cosine(vh, eta) : vh);
}

/* Ratio of the solid angle of half vectors to that of refracted directions, |d omega_h / d
 * omega_l| (Walter et al. 2007, equation 17); vh > 0 and lh < 0 are the cosines at the half
 * vector. */
LSF_SHARED_FUNCTION float lsf_refraction_jacobian(float vh, float lh, float eta)
{
    float sum = vh + eta * lh;
    return eta * eta * -lh / max(sum * sum, 1e-12f);
}

/* GGX distribution of normals [1/sr]. sin^2 of h is passed separately, because 1 - nh^2 loses
 * all its digits near the peak: sin2_h = |cross(n, h)|^2. */
LSF_SHARED_FUNCTION float lsf_ggx_d(float nh, float sin2_h, float alpha)
{
    float a2 = alpha * alpha;
    float d = nh * nh * a2 + sin2_h;
    return a2 / (LSF_PI * d * d);
}

LSF_SHARED_FUNCTION float lsf_ggx_d_anisotropic(float nh, float th, float bh, float alpha_t,
                                                float alpha_b)
{
    float t = th / alpha_t, b = bh / alpha_b;
    float d = t * t + b * b + nh * nh;
    return 1.0f / (LSF_PI * alpha_t * alpha_b * d * d);
}

/* Height-correlated Smith visibility, G / (4 nl nv). */
LSF_SHARED_FUNCTION float lsf_ggx_v(float nl, float nv, float alpha)
{
    float a2 = alpha * alpha;
    float v = nl * sqrt(nv * nv * (1.0f - a2) + a2);
    float l = nv * sqrt(nl * nl * (1.0f - a2) + a2);
    return 0.5f / max(v + l, 1e-12f);
}

LSF_SHARED_FUNCTION float lsf_ggx_v_anisotropic(float nl, float nv, float tl, float bl, float tv,
                                                float bv, float alpha_t, float alpha_b)
{
    float vt = alpha_t * tv, vb = alpha_b * bv;
    float lt = alpha_t * tl, lb = alpha_b * bl;
    float v = nl * sqrt(vt * vt + vb * vb + nv * nv);
    float l = nv * sqrt(lt * lt + lb * lb + nl * nl);
    return 0.5f / max(v + l, 1e-12f);
}

/* Reflectance of a clear coat at normal incidence, for an index of 1.5. */
#define LSF_COAT_F0 0.04f

/* Mean of a clear coat's Schlick term over a cosine-weighted hemisphere: f0 + (1 - f0) / 21. */
#define LSF_COAT_MEAN (LSF_COAT_F0 + (1.0f - LSF_COAT_F0) / 21.0f)

/* Transmittance of a clear coat of that weight under the cosine nv. */
LSF_SHARED_FUNCTION float lsf_coat_passes(float weight, float nv)
{
    return 1.0f - weight * lsf_fresnel_schlick(LSF_COAT_F0, min(max(nv, LSF_COSINE_MIN), 1.0f));
}

/* Smith's masking of one direction, whose cosine is nl. */
LSF_SHARED_FUNCTION float lsf_ggx_g1(float nl, float tl, float bl, float alpha_t, float alpha_b)
{
    float t = alpha_t * tl, b = alpha_b * bl;
    return 2.0f * nl / (nl + sqrt(t * t + b * b + nl * nl));
}

#include "shared/shared_end.h"
#endif
