/* Random numbers for the vertices of paths: functions of seed, pixel, sample and vertex, never of earlier draws.
 *
 * Each vertex of a pixel's paths has its own (0,2)-sequence over the samples of all iterations: Owen-scrambled
 * Sobol points in shuffled order, as math/sampling.h has them for the host (Burley 2020, "Practical Hash-based
 * Owen Scrambling"). With LSF_RANDOM_TEXTURE they are read from a texture of uniform random numbers instead, at a
 * texel that depends on pixel, sample and vertex, and on the depth of the visible point, so that surfaces behind
 * each other use different texels. */
#ifndef LSF_LIB_PATH_RANDOM
#define LSF_LIB_PATH_RANDOM

#include "lib/hash.glsl"
#include "shared/voxel_data.h"

struct path_random_key {
    uint pixel, seed;
    ivec2 texel; /* texel of the texture that belongs to the pixel */
};

#if LSF_RANDOM_TEXTURE
layout(binding = LSF_UNIT_PATH_RANDOM) uniform sampler2D random_texture;

/* Three numbers with which the path is continued from its vertex. */
vec3 path_random(path_random_key key, uint index, uint vertex)
{
    uvec3 shift = hash(uvec3(index, vertex, key.seed));
    ivec2 size = textureSize(random_texture, 0); /* powers of two */
    return texelFetch(random_texture, (key.texel + ivec2(shift.xy & 0xffffu)) & (size - 1), 0).rgb;
}
#else
/* Sobol's second dimension, bit-reversed: its direction numbers are Pascal's triangle modulo 2, whose
 * entry (i, j) is odd where the ones of i are among those of j (Lucas); a sum over supersets. */
uint path_sobol_second(uint index)
{
    index ^= (index & 0xaaaaaaaau) >> 1;
    index ^= (index & 0xccccccccu) >> 2;
    index ^= (index & 0xf0f0f0f0u) >> 4;
    index ^= (index & 0xff00ff00u) >> 8;
    return index ^ ((index & 0xffff0000u) >> 16);
}

vec3 path_random(path_random_key key, uint index, uint vertex)
{
    uvec3 seed = hash(uvec3(key.pixel, vertex, key.seed));
    uvec3 order = hash(seed);
    /* One shuffle for the pair, one for the third number. */
    uvec3 shuffled =
        bitfieldReverse(scramble_reversed(uvec3(bitfieldReverse(index)), uvec3(order.x, order.xy)));
    return hash_unit(bitfieldReverse(scramble_reversed(
        uvec3(shuffled.x, path_sobol_second(shuffled.y), shuffled.z), seed)));
}
#endif

#endif
