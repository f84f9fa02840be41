/* From radiance to an 8-bit display: exposure, Khronos PBR Neutral tone mapping, sRGB encoding. One
 * definition for the image writer and for the tonemap pass.
 *
 * Tone mapping: Khronos Group, "PBR Neutral Tone Mapper Specification", 2024. With f = 0.04 (the
 * reflectance of a dielectric, which is taken off as a grey veil), k_s = 0.8 - f, k_d = 0.15, m the
 * smallest and p the largest of R, G, B:
 *
 *   o   = m - m^2 / 4f where m <= 2f, else f
 *   p'  = p - o;  below k_s the result is c - o
 *   p_n = 1 - (1 - k_s)^2 / (p' + 1 - 2 k_s)
 *   g   = 1 / (k_d (p' - p_n) + 1)
 *   result = (c - o) p_n / p' g + p_n (1 - g)
 *
 * Encoding: IEC 61966-2-1, the exact two-piece curve. */
#ifndef LSF_SHARED_TONEMAP_H
#define LSF_SHARED_TONEMAP_H

#include "shared/shared.h"

#define LSF_TONEMAP_VEIL 0.04f
#define LSF_TONEMAP_KNEE 0.76f
#define LSF_TONEMAP_DESATURATION 0.15f

/* Where exposed radiance is cut off: the curve is within 1e-6 of white there, and further up its
 * products would overflow. */
#define LSF_TONEMAP_LARGEST 1e6f

/* `exposure_scale` is 2^EV. Negative values and NaN become 0. */
LSF_SHARED_FUNCTION float lsf_tonemap_expose(float radiance, float exposure_scale)
{
    float exposed = radiance * exposure_scale;
    return exposed > 0.0f ? min(exposed, LSF_TONEMAP_LARGEST) : 0.0f;
}

/* Maps one channel of an exposed pixel, whose smallest and largest channels are given, to 0..1. */
LSF_SHARED_FUNCTION float lsf_tonemap_neutral(float value, float smallest, float largest)
{
    float veil = smallest < 2.0f * LSF_TONEMAP_VEIL
                     ? smallest - smallest * smallest / (4.0f * LSF_TONEMAP_VEIL)
                     : LSF_TONEMAP_VEIL;
    float peak = largest - veil;
    if (peak < LSF_TONEMAP_KNEE)
        return value - veil;
    float range = 1.0f - LSF_TONEMAP_KNEE;
    float new_peak = 1.0f - range * range / (peak + range - LSF_TONEMAP_KNEE);
    float keep = 1.0f / (LSF_TONEMAP_DESATURATION * (peak - new_peak) + 1.0f);
    return (value - veil) * (new_peak / peak) * keep + new_peak * (1.0f - keep);
}

LSF_SHARED_FUNCTION float lsf_srgb_encode(float linear_value)
{
    float low = linear_value * 12.92f;
    float high = 1.055f * pow(max(linear_value, 0.0031308f), 1.0f / 2.4f) - 0.055f;
    return min(max(linear_value <= 0.0031308f ? low : high, 0.0f), 1.0f);
}

LSF_SHARED_FUNCTION float lsf_srgb_decode(float encoded)
{
    float high = pow(max(encoded + 0.055f, 0.0f) / 1.055f, 2.4f);
    return encoded <= 0.04045f ? encoded / 12.92f : high;
}

/* Exposed value to display code value in 0..1; times 255 and rounded it is the byte. */
LSF_SHARED_FUNCTION float lsf_tonemap_display(float value, float smallest, float largest)
{
    return lsf_srgb_encode(lsf_tonemap_neutral(value, smallest, largest));
}

#include "shared/shared_end.h"
#endif
