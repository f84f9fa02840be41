/* From radiance to an 8-bit display: exposure, a tone curve, encoding. One definition for the image
 * writer and for the tonemap pass.
 *
 * None: sRGB of what lies in 0..1, cut off above.
 *
 * Neutral: Khronos Group, "PBR Neutral Tone Mapper Specification", 2024. With f = 0.04 (the
 * reflectance of a dielectric, which is taken off as a grey veil), k_s = 0.8 - f, k_d = 0.15, m the
 * smallest and p the largest of R, G, B:
 *
 *   o   = m - m^2 / 4f where m <= 2f, else f
 *   p'  = p - o;  below k_s the result is c - o
 *   p_n = 1 - (1 - k_s)^2 / (p' + 1 - 2 k_s)
 *   g   = 1 / (k_d (p' - p_n) + 1)
 *   result = (c - o) p_n / p' g + p_n (1 - g)
 *
 * ACES: the reference rendering and output transforms for sRGB (Academy of Motion Picture Arts and
 * Sciences, ACES 1.0), in S. Hill's fit of them: to AP1 primaries, (v (v + 0.0245786) -
 * 0.000090537) / (v (0.983729 v + 0.432951) + 0.238081) of each, and back.
 *
 * AgX: T. Sobotka, "AgX", 2022: an inset matrix, the logarithm over 16.5 stops about middle grey,
 * 0.18 2^-10 to 0.18 2^6.5, on it a sigmoid, and the outset matrix. With the pivot t = 10 / 16.5,
 * where middle grey lies, and the slope 2 there, the sigmoid is
 *
 *   1/2 + 2 (v - t) / (1 + a |v - t|^p)^(1/p),  p = 3 below t and 3.25 above
 *
 * and a lets it end in 0 and 1: with d the distance of t from that end, (1 + a d^p) = (4 d)^p. Its
 * results are code values already.
 *
 * Encoding otherwise: IEC 61966-2-1, the exact two-piece curve. */
#ifndef LSF_SHARED_TONEMAP_H
#define LSF_SHARED_TONEMAP_H

#include "shared/shared.h"

#define LSF_TONEMAP_VEIL 0.04f
#define LSF_TONEMAP_KNEE 0.76f
#define LSF_TONEMAP_DESATURATION 0.15f

/* Exposed radiance is clamped to this: the curve is within 1e-6 of white there, and beyond its
 * products would overflow. */
#define LSF_TONEMAP_LARGEST 1e6f

/* `exposure_scale` is 2^EV. Negative values and NaN become 0. */
LSF_SHARED_FUNCTION float lsf_tonemap_expose(float radiance, float exposure_scale)
{
    float exposed = radiance * exposure_scale;
    return exposed > 0.0f ? min(exposed, LSF_TONEMAP_LARGEST) : 0.0f;
}

/* Maps one channel of an exposed pixel to 0..1, given the pixel's smallest and largest channels. */
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

/* A row of a matrix times a colour. */
LSF_SHARED_FUNCTION float lsf_tonemap_row(float x, float y, float z, float r, float g, float b)
{
    return x * r + y * g + z * b;
}

/* Saturates before the square of the largest radiance would lose the ratio. */
LSF_SHARED_FUNCTION float lsf_tonemap_aces_curve(float v)
{
    return (v * (v + 0.0245786f) - 0.000090537f) / (v * (0.983729f * v + 0.432951f) + 0.238081f);
}

LSF_SHARED_FUNCTION float lsf_tonemap_aces(int channel, float r, float g, float b)
{
    float x = lsf_tonemap_aces_curve(lsf_tonemap_row(0.59719f, 0.35458f, 0.04823f, r, g, b));
    float y = lsf_tonemap_aces_curve(lsf_tonemap_row(0.07600f, 0.90834f, 0.01566f, r, g, b));
    float z = lsf_tonemap_aces_curve(lsf_tonemap_row(0.02840f, 0.13383f, 0.83777f, r, g, b));
    if (channel == 0)
        return lsf_tonemap_row(1.60475f, -0.53108f, -0.07367f, x, y, z);
    if (channel == 1)
        return lsf_tonemap_row(-0.10208f, 1.10813f, -0.00605f, x, y, z);
    return lsf_tonemap_row(-0.00327f, -0.07276f, 1.07602f, x, y, z);
}

#define LSF_AGX_STOPS 16.5f /* from 10 below middle grey on */
#define LSF_AGX_PIVOT (10.0f / LSF_AGX_STOPS)

LSF_SHARED_FUNCTION float lsf_tonemap_agx_curve(float linear_value)
{
    float stops = log2(max(linear_value, 1e-9f) / 0.18f); /* far below the darkest stop */
    float v = min(max((stops + 10.0f) / LSF_AGX_STOPS, 0.0f), 1.0f) - LSF_AGX_PIVOT;
    float power = v < 0.0f ? 3.0f : 3.25f;
    float end = v < 0.0f ? LSF_AGX_PIVOT : 1.0f - LSF_AGX_PIVOT;
    float a = (pow(4.0f * end, power) - 1.0f) / pow(end, power);
    return 0.5f + 2.0f * v * pow(1.0f + a * pow(max(abs(v), 1e-9f), power), -1.0f / power);
}

LSF_SHARED_FUNCTION float lsf_tonemap_agx(int channel, float r, float g, float b)
{
    float x =
        lsf_tonemap_agx_curve(lsf_tonemap_row(0.842479062f, 0.0784336f, 0.0792237451f, r, g, b));
    float y =
        lsf_tonemap_agx_curve(lsf_tonemap_row(0.0423282422f, 0.878468636f, 0.0791661275f, r, g, b));
    float z =
        lsf_tonemap_agx_curve(lsf_tonemap_row(0.0423756549f, 0.0784336f, 0.879142974f, r, g, b));
    if (channel == 0)
        return lsf_tonemap_row(1.196879005f, -0.0980208811f, -0.0990297441f, x, y, z);
    if (channel == 1)
        return lsf_tonemap_row(-0.0528968518f, 1.15190313f, -0.0989611768f, x, y, z);
    return lsf_tonemap_row(-0.0529716355f, -0.0980434501f, 1.151073673f, x, y, z);
}

/* As lsf_tone_curve numbers them. */
#define LSF_CURVE_NEUTRAL 0
#define LSF_CURVE_NONE 1
#define LSF_CURVE_ACES 2
#define LSF_CURVE_AGX 3

/* The code value in 0..1 of one channel, 0 to 2, of an exposed pixel. */
LSF_SHARED_FUNCTION float lsf_tonemap_code(int curve, int channel, float r, float g, float b)
{
    float value = channel == 0 ? r : channel == 1 ? g : b;
    if (curve == LSF_CURVE_NONE)
        return lsf_srgb_encode(value);
    if (curve == LSF_CURVE_ACES)
        return lsf_srgb_encode(lsf_tonemap_aces(channel, r, g, b));
    if (curve == LSF_CURVE_AGX)
        return min(max(lsf_tonemap_agx(channel, r, g, b), 0.0f), 1.0f);
    return lsf_tonemap_display(value, min(r, min(g, b)), max(r, max(g, b)));
}

#include "shared/shared_end.h"
#endif
