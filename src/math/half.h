/* Numbers of 16 bits: IEEE 754 binary16, as GLSL packs them. */
#ifndef LSF_MATH_HALF_H
#define LSF_MATH_HALF_H

#include <stdint.h>
#include <string.h>

/* The largest of them that is finite. */
#define LSF_HALF_MOST 65504.0f

static inline float lsf_half_to_float(uint16_t half)
{
    uint32_t sign = (uint32_t)(half & 0x8000u) << 16, rest = half & 0x7fffu, bits;
    if (rest >= 0x7c00u)
        bits = (rest << 13) + 0x70000000u; /* infinity and what is not a number */
    else if (rest >= 0x0400u)
        bits = (rest << 13) + 0x38000000u; /* exponents of floats begin 112 lower */
    else {
        float small = (float)rest * 0x1p-24f;
        memcpy(&bits, &small, sizeof bits);
    }
    bits |= sign;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* To the nearest, and of two as near to the even one; beyond LSF_HALF_MOST infinity. */
static inline uint16_t lsf_float_to_half(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    uint32_t sign = bits >> 16 & 0x8000u, rest = bits & 0x7fffffffu;
    if (rest > 0x7f800000u)
        return (uint16_t)(sign | 0x7e00u);
    if (rest >= 0x477ff000u)
        return (uint16_t)(sign | 0x7c00u);
    if (rest < 0x38800000u) { /* below 2^-14: adding 1/2 rounds to multiples of 2^-24 */
        float magnitude;
        memcpy(&magnitude, &rest, sizeof magnitude);
        magnitude += 0.5f;
        memcpy(&bits, &magnitude, sizeof bits);
        return (uint16_t)(sign | (bits - 0x3f000000u));
    }
    rest += 0xfffu + (rest >> 13 & 1u);
    return (uint16_t)(sign | ((rest - 0x38000000u) >> 13));
}

#endif
