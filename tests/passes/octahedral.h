/* Unit vectors as lib/octahedral.glsl packs them: two signed normalised 16-bit numbers. */
#ifndef LSF_TESTS_PASSES_OCTAHEDRAL_H
#define LSF_TESTS_PASSES_OCTAHEDRAL_H

#include <math.h>
#include <stdint.h>

#include "math/vector.h"

static inline uint32_t octahedral_encode(lsf_float3 n)
{
    float sum = fabsf(n.x) + fabsf(n.y) + fabsf(n.z);
    float x = n.x / sum, y = n.y / sum;
    if (n.z < 0.0f) {
        float folded = (1.0f - fabsf(y)) * (x >= 0.0f ? 1.0f : -1.0f);
        y = (1.0f - fabsf(x)) * (y >= 0.0f ? 1.0f : -1.0f);
        x = folded;
    }
    return ((uint32_t)(int32_t)lrintf(x * 32767.0f) & 0xffffu) |
           (uint32_t)(int32_t)lrintf(y * 32767.0f) << 16;
}

static inline lsf_float3 octahedral_decode(uint32_t bits)
{
    float x = fmaxf((float)(int16_t)(bits & 0xffffu) / 32767.0f, -1.0f);
    float y = fmaxf((float)(int16_t)(bits >> 16) / 32767.0f, -1.0f);
    lsf_float3 n = {x, y, 1.0f - fabsf(x) - fabsf(y)};
    if (n.z < 0.0f) {
        n.x = (1.0f - fabsf(y)) * (x >= 0.0f ? 1.0f : -1.0f);
        n.y = (1.0f - fabsf(x)) * (y >= 0.0f ? 1.0f : -1.0f);
    }
    return lsf_f3_normalize(n);
}

#endif
