/* Pseudo-random numbers by hashing integers. */
#ifndef LSF_LIB_HASH
#define LSF_LIB_HASH

/* M. Jarzynski, M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020: pcg3d. */
uvec3 hash(uvec3 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

/* Uses the 24 high bits, 0 <= u < 1. */
vec3 hash_unit(uvec3 bits)
{
    return vec3(bits >> 8) * (1.0 / 16777216.0);
}

/* Owen scrambling of bit-reversed numbers; scramble_reversed of math/sampling.c. */
uvec3 scramble_reversed(uvec3 x, uvec3 seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

#endif
