/* Three-component float vectors as values, for scalar code that reads like the formulas. */
#ifndef LSF_MATH_VECTOR_H
#define LSF_MATH_VECTOR_H

#include <math.h>

typedef struct lsf_float3 {
    float x, y, z;
} lsf_float3;

static inline lsf_float3 lsf_f3(float x, float y, float z)
{
    return (lsf_float3){x, y, z};
}

static inline lsf_float3 lsf_f3_load(const float *p)
{
    return (lsf_float3){p[0], p[1], p[2]};
}

static inline void lsf_f3_store(float *p, lsf_float3 a)
{
    p[0] = a.x;
    p[1] = a.y;
    p[2] = a.z;
}

static inline lsf_float3 lsf_f3_add(lsf_float3 a, lsf_float3 b)
{
    return (lsf_float3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline lsf_float3 lsf_f3_sub(lsf_float3 a, lsf_float3 b)
{
    return (lsf_float3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline lsf_float3 lsf_f3_mul(lsf_float3 a, lsf_float3 b)
{
    return (lsf_float3){a.x * b.x, a.y * b.y, a.z * b.z};
}

static inline lsf_float3 lsf_f3_scale(lsf_float3 a, float s)
{
    return (lsf_float3){a.x * s, a.y * s, a.z * s};
}

/* a + s b */
static inline lsf_float3 lsf_f3_mad(lsf_float3 a, lsf_float3 b, float s)
{
    return (lsf_float3){a.x + b.x * s, a.y + b.y * s, a.z + b.z * s};
}

static inline float lsf_f3_dot(lsf_float3 a, lsf_float3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline lsf_float3 lsf_f3_cross(lsf_float3 a, lsf_float3 b)
{
    return (lsf_float3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline float lsf_f3_length(lsf_float3 a)
{
    return sqrtf(lsf_f3_dot(a, a));
}

static inline float lsf_f3_max(lsf_float3 a)
{
    return fmaxf(a.x, fmaxf(a.y, a.z));
}

static inline float lsf_f3_max_abs(lsf_float3 a)
{
    return fmaxf(fabsf(a.x), fmaxf(fabsf(a.y), fabsf(a.z)));
}

/* Unit vector along `a`, or `fallback` when `a` has no direction. The largest component is
 * divided out first, so that neither tiny nor huge vectors leave the range of floats. */
static inline lsf_float3 lsf_f3_normalize_or(lsf_float3 a, lsf_float3 fallback)
{
    float m = lsf_f3_max_abs(a);
    if (!(m > 0.0f) || !isfinite(m))
        return fallback;
    a = (lsf_float3){a.x / m, a.y / m, a.z / m};
    return lsf_f3_scale(a, 1.0f / lsf_f3_length(a));
}

/* Unit vector along `a`, which must have a direction. */
static inline lsf_float3 lsf_f3_normalize(lsf_float3 a)
{
    return lsf_f3_scale(a, 1.0f / lsf_f3_length(a));
}

/* Rec.709 luminance. */
static inline float lsf_f3_luminance(lsf_float3 a)
{
    return 0.2126f * a.x + 0.7152f * a.y + 0.0722f * a.z;
}

/* A right-handed orthonormal frame about the unit vector `n`; local z is n. */
typedef struct lsf_basis {
    lsf_float3 t, b, n;
} lsf_basis;

/* T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017. */
static inline lsf_basis lsf_basis_about(lsf_float3 n)
{
    float sign = copysignf(1.0f, n.z);
    float a = -1.0f / (sign + n.z);
    float b = n.x * n.y * a;
    return (lsf_basis){
        {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

static inline lsf_float3 lsf_basis_to_world(const lsf_basis *f, lsf_float3 v)
{
    return lsf_f3_mad(lsf_f3_mad(lsf_f3_scale(f->t, v.x), f->b, v.y), f->n, v.z);
}

static inline lsf_float3 lsf_basis_to_local(const lsf_basis *f, lsf_float3 v)
{
    return lsf_f3(lsf_f3_dot(f->t, v), lsf_f3_dot(f->b, v), lsf_f3_dot(f->n, v));
}

#endif
