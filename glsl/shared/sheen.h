/* The sheen of cloth (KHR_materials_sheen), one definition for the shaders and for the reference:
 * fibres that stand on the surface. A. Conty Estevez, C. Kulla, "Production Friendly Microfacet
 * Sheen BRDF", SIGGRAPH 2017 course:
 *
 *   f = color D V / max(1, E(n.v), E(n.l)),  D = (2 + 1 / a) sin^(1/a) / (2 pi),  a = roughness^2
 *   V = 1 / ((1 + L(n.v) + L(n.l)) 4 n.v n.l)
 *
 * Layers below are multiplied by min(1 - c E'(n.v), 1 - c E'(n.l)) with c the largest channel of
 * the color, E the directional albedo of D V and E' = min(E, 1). The divisor is 1 where E is below
 * 1: L is a fit, with which sharp lobes would reflect more light than arrives at grazing angles (E
 * reaches 2.8). */
#ifndef LSF_SHARED_SHEEN_H
#define LSF_SHARED_SHEEN_H

#include "shared/brdf.h"
#include "shared/shared.h"

/* Floor of the roughness: 1 / a is then 204. */
#define LSF_SHEEN_ROUGHNESS_MIN 0.07f

#define LSF_SHEEN_SIDE 16

/* E at roughness 0.07 + 0.93 j / 15 (rows) and cosine (i / 15)^2, by quadrature with 600 x 360
 * directions. */
/* clang-format off */
LSF_SHARED_CONSTANT float lsf_sheen_table[LSF_SHEEN_SIDE * LSF_SHEEN_SIDE] = {
    2.6769f, 2.8295f, 2.0962f, 1.3169f, 0.7201f, 0.3363f, 0.1288f, 0.0381f,
    0.0080f, 0.0011f, 0.0001f, 0.0000f, 0.0000f, 0.0000f, 0.0000f, 0.0000f,
    1.4688f, 1.6572f, 1.4050f, 1.0675f, 0.7552f, 0.4989f, 0.3051f, 0.1698f,
    0.0841f, 0.0358f, 0.0125f, 0.0033f, 0.0006f, 0.0001f, 0.0000f, 0.0000f,
    1.0518f, 1.2212f, 1.0937f, 0.8945f, 0.6955f, 0.5180f, 0.3686f, 0.2487f,
    0.1572f, 0.0915f, 0.0479f, 0.0217f, 0.0081f, 0.0022f, 0.0003f, 0.0000f,
    0.8533f, 1.0087f, 0.9318f, 0.7933f, 0.6487f, 0.5142f, 0.3950f, 0.2928f,
    0.2078f, 0.1397f, 0.0876f, 0.0501f, 0.0254f, 0.0105f, 0.0029f, 0.0002f,
    0.7471f, 0.8948f, 0.8436f, 0.7369f, 0.6219f, 0.5122f, 0.4122f, 0.3231f,
    0.2455f, 0.1793f, 0.1244f, 0.0809f, 0.0484f, 0.0253f, 0.0101f, 0.0016f,
    0.6898f, 0.8343f, 0.7981f, 0.7095f, 0.6117f, 0.5170f, 0.4292f, 0.3493f,
    0.2774f, 0.2137f, 0.1583f, 0.1114f, 0.0740f, 0.0445f, 0.0220f, 0.0062f,
    0.6622f, 0.8067f, 0.7799f, 0.7022f, 0.6147f, 0.5292f, 0.4490f, 0.3750f,
    0.3072f, 0.2456f, 0.1902f, 0.1414f, 0.1007f, 0.0665f, 0.0380f, 0.0150f,
    0.6547f, 0.8012f, 0.7807f, 0.7093f, 0.6279f, 0.5477f, 0.4722f, 0.4019f,
    0.3367f, 0.2764f, 0.2210f, 0.1708f, 0.1277f, 0.0902f, 0.0570f, 0.0279f,
    0.6617f, 0.8111f, 0.7949f, 0.7270f, 0.6487f, 0.5715f, 0.4985f, 0.4302f,
    0.3663f, 0.3066f, 0.2509f, 0.1996f, 0.1547f, 0.1146f, 0.0779f, 0.0441f,
    0.6792f, 0.8319f, 0.8183f, 0.7519f, 0.6748f, 0.5987f, 0.5267f, 0.4592f,
    0.3958f, 0.3361f, 0.2798f, 0.2274f, 0.1810f, 0.1390f, 0.0997f, 0.0626f,
    0.7038f, 0.8592f, 0.8471f, 0.7807f, 0.7035f, 0.6273f, 0.5554f, 0.4879f,
    0.4244f, 0.3643f, 0.3073f, 0.2537f, 0.2061f, 0.1626f, 0.1214f, 0.0820f,
    0.7318f, 0.8890f, 0.8775f, 0.8102f, 0.7321f, 0.6552f, 0.5828f, 0.5148f,
    0.4509f, 0.3902f, 0.3324f, 0.2779f, 0.2293f, 0.1847f, 0.1423f, 0.1015f,
    0.7589f, 0.9166f, 0.9049f, 0.8365f, 0.7573f, 0.6796f, 0.6065f, 0.5381f,
    0.4737f, 0.4126f, 0.3543f, 0.2991f, 0.2499f, 0.2047f, 0.1616f, 0.1201f,
    0.7800f, 0.9367f, 0.9248f, 0.8556f, 0.7756f, 0.6975f, 0.6242f, 0.5558f,
    0.4914f, 0.4302f, 0.3718f, 0.3165f, 0.2672f, 0.2218f, 0.1786f, 0.1370f,
    0.7892f, 0.9440f, 0.9321f, 0.8630f, 0.7834f, 0.7059f, 0.6333f, 0.5657f,
    0.5020f, 0.4416f, 0.3838f, 0.3291f, 0.2803f, 0.2355f, 0.1928f, 0.1518f,
    0.7810f, 0.9329f, 0.9218f, 0.8545f, 0.7770f, 0.7016f, 0.6312f, 0.5655f,
    0.5038f, 0.4452f, 0.3891f, 0.3359f, 0.2886f, 0.2451f, 0.2036f, 0.1638f};
/* clang-format on */

LSF_SHARED_FUNCTION float lsf_sheen_fit(float x, float a)
{
    float t = (1.0f - a) * (1.0f - a);
    float p = 21.5473f + (25.3245f - 21.5473f) * t, q = 3.82987f + (3.32435f - 3.82987f) * t;
    float r = 0.19823f + (0.16801f - 0.19823f) * t, s = -1.97760f + (1.97760f - 1.27393f) * t;
    float u = -4.32054f + (4.32054f - 4.85967f) * t;
    return p / (1.0f + q * pow(x, r)) + s * x + u;
}

/* L. */
LSF_SHARED_FUNCTION float lsf_sheen_lambda(float cosine, float a)
{
    float exponent = cosine < 0.5f
                         ? lsf_sheen_fit(cosine, a)
                         : 2.0f * lsf_sheen_fit(0.5f, a) - lsf_sheen_fit(1.0f - cosine, a);
    return exp2(exponent * 1.44269504f);
}

/* D V; sin2_h is the squared sine of the half vector's angle with the normal. */
LSF_SHARED_FUNCTION float lsf_sheen_lobe(float nv, float nl, float sin2_h, float roughness)
{
    float r = max(roughness, LSF_SHEEN_ROUGHNESS_MIN), a = r * r;
    float d = (2.0f + 1.0f / a) * pow(max(sin2_h, 1e-12f), 0.5f / a) / (2.0f * LSF_PI);
    return d / ((1.0f + lsf_sheen_lambda(nv, a) + lsf_sheen_lambda(nl, a)) * 4.0f * nv * nl);
}

/* E. */
LSF_SHARED_FUNCTION float lsf_sheen_albedo(float cosine, float roughness)
{
    float r = min(max(roughness, LSF_SHEEN_ROUGHNESS_MIN), 1.0f);
    float x = sqrt(min(max(cosine, 0.0f), 1.0f)) * 15.0f;
    float y = (r - LSF_SHEEN_ROUGHNESS_MIN) / (1.0f - LSF_SHEEN_ROUGHNESS_MIN) * 15.0f;
    int i = LSF_SHARED_INT(min(x, 14.0f)), j = LSF_SHARED_INT(min(y, 14.0f));
    float tx = x - LSF_SHARED_FLOAT(i), ty = y - LSF_SHARED_FLOAT(j);
    int at = j * LSF_SHEEN_SIDE + i;
    float low = lsf_sheen_table[at] + (lsf_sheen_table[at + 1] - lsf_sheen_table[at]) * tx;
    at += LSF_SHEEN_SIDE;
    float high = lsf_sheen_table[at] + (lsf_sheen_table[at + 1] - lsf_sheen_table[at]) * tx;
    return low + (high - low) * ty;
}

/* Factor by which a sheen whose largest channel is `color` attenuates the layers below, from the
 * albedos of both directions. */
LSF_SHARED_FUNCTION float lsf_sheen_leaves(float color, float albedo_v, float albedo_l)
{
    return 1.0f - color * min(max(albedo_v, albedo_l), 1.0f);
}

#include "shared/shared_end.h"
#endif
