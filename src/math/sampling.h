/* Random numbers and sampling.
 *
 * Every number is a function of (seed, index, dimension), never of time or of what was drawn
 * before: the same seed gives the same bits, in any order and on any number of threads. */
#ifndef LSF_MATH_SAMPLING_H
#define LSF_MATH_SAMPLING_H

#include <stdint.h>

#include "math/vector.h"

/* --- hashes and plain random numbers --- */

/* A 64-bit permutation with full avalanche. */
uint64_t lsf_hash64(uint64_t x);

/* A 32-bit hash of two values. lsf_hash(lsf_hash(a, b), c) hashes three. */
static inline uint32_t lsf_hash(uint64_t a, uint64_t b)
{
    return (uint32_t)(lsf_hash64(a ^ lsf_hash64(b + 0x9e3779b97f4a7c15u)) >> 32);
}

/* The 24 high bits as a float in [0, 1). */
static inline float lsf_unit_float(uint32_t bits)
{
    return (float)(bits >> 8) * 0x1p-24f;
}

/* All 32 bits as a double in [0, 1). */
static inline double lsf_unit_double(uint32_t bits)
{
    return (double)bits * 0x1p-32;
}

/* Uniform in [0, 1). */
static inline float lsf_random_float(uint64_t seed, uint64_t index)
{
    return lsf_unit_float(lsf_hash(seed, index));
}

/* --- Owen-scrambled Sobol points --- */

/* Point `index` of a 2D (0,2)-sequence, nested-uniformly scrambled and with its order shuffled by
 * `seed`: any seed gives a sequence of its own, whose first 2^k points are stratified in every
 * elementary interval and whose points are each uniform in [0,1)^2. Sequences of different seeds
 * are independent, so further dimensions are had by padding: one seed for each pair. */
void lsf_sobol_2d_bits(uint32_t index, uint32_t seed, uint32_t bits[2]);

static inline void lsf_sobol_2d(uint32_t index, uint32_t seed, float point[2])
{
    uint32_t bits[2];
    lsf_sobol_2d_bits(index, seed, bits);
    point[0] = lsf_unit_float(bits[0]);
    point[1] = lsf_unit_float(bits[1]);
}

/* The same in one dimension: a scrambled and shuffled van der Corput sequence. */
uint32_t lsf_sobol_1d_bits(uint32_t index, uint32_t seed);

static inline float lsf_sobol_1d(uint32_t index, uint32_t seed)
{
    return lsf_unit_float(lsf_sobol_1d_bits(index, seed));
}

/* --- directions; u and v are uniform in [0, 1) --- */

/* Uniform on the unit disc, area-preserving and continuous. */
void lsf_sample_disc(float u, float v, float point[2]);

/* About z with pdf cos / pi. */
lsf_float3 lsf_sample_cosine_hemisphere(float u, float v);

/* Uniform on the unit sphere, pdf 1 / (4 pi). */
lsf_float3 lsf_sample_sphere(float u, float v);

/* A uniformly distributed rotation: `rows` of a 3x3 matrix, determinant +1. */
void lsf_sample_rotation(float u, float v, float w, float rows[9]);

/* Uniform barycentrics (of the second and third corner) of a triangle. */
void lsf_sample_triangle(float u, float v, float *b1, float *b2);

/* A microfacet normal as it is seen from `view` (local, unit, view.z > 0): pdf
 * lsf_pdf_ggx_visible_normal. */
lsf_float3 lsf_sample_ggx_visible_normal(lsf_float3 view, float alpha_t, float alpha_b, float u,
                                         float v);

/* D_v(h) = G1(v) max(0, v.h) D(h) / v.z, per steradian of `normal`. */
float lsf_pdf_ggx_visible_normal(lsf_float3 view, lsf_float3 normal, float alpha_t, float alpha_b);

/* The same per steradian of the direction that `view` is mirrored to: D_v(h) / (4 v.h), in which
 * v.h cancels. `normal` is the half vector, so that v.h is positive. */
float lsf_pdf_ggx_reflection(lsf_float3 view, lsf_float3 normal, float alpha_t, float alpha_b);

#endif
