/* Numbers that decide by chance, anew in each iteration. */
#ifndef LSF_LIB_CHANCE
#define LSF_LIB_CHANCE

#include "lib/hash.glsl"
#include "shared/scene_data.h"

layout(location = LSF_LOCATION_CHANCE) uniform uvec2 chance; /* seed, iteration; lsf_iteration_set_chance */

/* 0 <= u < 1; the same for the same key. */
float chance_number(uvec3 key)
{
    return hash_unit(hash(key ^ hash(uvec3(chance, 0u)))).x;
}

/* scramble_reversed of math/sampling.c. */
uint chance_scramble(uint x, uint seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/* Above 0 and below 1. The iterations' numbers for one key are a scrambled and shuffled van der Corput sequence,
 * those of different keys are independent (S. Laine, T. Karras, "Stratified Sampling for Stochastic
 * Transparency", EGSR 2011). */
float chance_even_number(uvec3 key)
{
    uvec3 seeds = hash(uvec3(key.x ^ chance.x, key.yz));
    uint index = bitfieldReverse(chance_scramble(bitfieldReverse(chance.y), seeds.x));
    uint bits = bitfieldReverse(chance_scramble(index, seeds.y));
    return (float(bits >> 9) + 0.5) * (1.0 / 8388608.0);
}

#endif
