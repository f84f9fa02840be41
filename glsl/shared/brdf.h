/* The glTF 2.0 metallic-roughness BRDF, one definition for the shaders and for the reference.
 * glTF 2.0 specification, appendix B; KHR_materials_ior; KHR_materials_anisotropy.
 *
 *   f = (1 - metallic) (1 - F(f0_dielectric)) base / pi  +  F(f0) V D
 *   f0_dielectric = ((ior - 1) / (ior + 1))^2,  f0 = mix(f0_dielectric, base, metallic)
 *
 * F: Schlick, D: Trowbridge-Reitz (GGX), V: height-correlated Smith visibility, G / (4 nl nv).
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

/* KHR_materials_anisotropy: alpha along the tangent; along the bitangent it stays `alpha`. */
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

/* GGX distribution of normals [1/sr]. sin^2 of h is passed apart, because 1 - nh^2 loses all its
 * digits near the peak: sin2_h = |cross(n, h)|^2. */
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

#include "shared/shared_end.h"
#endif
