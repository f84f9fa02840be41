/* Random numbers for stochastic transparency, new in each iteration. */
#ifndef LSF_LIB_CHANCE
#define LSF_LIB_CHANCE

#include "lib/hash.glsl"
#include "shared/scene_data.h"

layout(location = LSF_LOCATION_CHANCE) uniform uvec2 chance; /* seed, iteration; lsf_iteration_set_chance */

/* 0 <= u < 1, the same for equal keys. */
float chance_number(uvec3 key)
{
    return hash_unit(hash(key ^ hash(uvec3(chance, 0u)))).x;
}

/* 0 < u < 1. Over the iterations the numbers of one key are a scrambled and shuffled van der Corput sequence;
 * those of different keys are independent (S. Laine, T. Karras, "Stratified Sampling for Stochastic Transparency",
 * EGSR 2011). */
float chance_even_number(uvec3 key)
{
    uvec3 seeds = hash(uvec3(key.x ^ chance.x, key.yz));
    uint index = bitfieldReverse(scramble_reversed(uvec3(bitfieldReverse(chance.y)), seeds).x);
    uint bits = bitfieldReverse(scramble_reversed(uvec3(index), seeds).y);
    return (float(bits >> 9) + 0.5) * (1.0 / 8388608.0);
}

#endif
