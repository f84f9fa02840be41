#include "math/sampling.h"

#include "shared/brdf.h"

/* The finaliser of splitmix64: G. L. Steele, D. Lea, C. H. Flood, "Fast Splittable Pseudorandom
 * Number Generators", OOPSLA 2014 (variant 13 of D. Stafford). */
uint64_t lsf_hash64(uint64_t x)
{
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9u;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebu;
    x ^= x >> 31;
    return x;
}

static uint32_t reverse_bits(uint32_t x)
{
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    return __builtin_bswap32(x);
}

/* Owen's nested uniform scrambling as a hash: on bit-reversed values each step lets a bit change
 * only those above it, so that every digit is permuted by a function of the more significant ones.
 * B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020; S. Laine, T. Karras,
 * "Stratified Sampling for Stochastic Transparency", EGSR 2011; the constants are those that
 * N. Vegdahl found by search ("Building a Better LK Hash", 2021). */
static uint32_t scramble_reversed(uint32_t x, uint32_t seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/* Second dimension of Sobol's sequence: the direction numbers are Pascal's triangle modulo 2. */
static uint32_t sobol_second(uint32_t index)
{
    uint32_t result = 0;
    for (uint32_t v = 0x80000000u; index != 0; index >>= 1, v ^= v >> 1)
        if (index & 1u)
            result ^= v;
    return result;
}

void lsf_sobol_2d_bits(uint32_t index, uint32_t seed, uint32_t bits[2])
{
    index = reverse_bits(scramble_reversed(reverse_bits(index), lsf_hash(seed, 0)));
    /* The first dimension is the index with its bits reversed, which is the order that
     * scrambling needs. */
    bits[0] = reverse_bits(scramble_reversed(index, lsf_hash(seed, 1)));
    bits[1] = reverse_bits(scramble_reversed(reverse_bits(sobol_second(index)), lsf_hash(seed, 2)));
}

uint32_t lsf_sobol_1d_bits(uint32_t index, uint32_t seed)
{
    index = reverse_bits(scramble_reversed(reverse_bits(index), lsf_hash(seed, 0)));
    return reverse_bits(scramble_reversed(index, lsf_hash(seed, 1)));
}

/* P. Shirley, K. Chiu, "A Low Distortion Map Between Disk and Square", JGT 2(3), 1997. */
void lsf_sample_disc(float u, float v, float point[2])
{
    float a = 2.0f * u - 1.0f, b = 2.0f * v - 1.0f;
    float r, phi;
    if (a == 0.0f && b == 0.0f) {
        r = 0.0f;
        phi = 0.0f;
    } else if (fabsf(a) > fabsf(b)) {
        r = a;
        phi = LSF_PI / 4.0f * (b / a);
    } else {
        r = b;
        phi = LSF_PI / 2.0f - LSF_PI / 4.0f * (a / b);
    }
    point[0] = r * cosf(phi);
    point[1] = r * sinf(phi);
}

lsf_float3 lsf_sample_cosine_hemisphere(float u, float v)
{
    float p[2];
    lsf_sample_disc(u, v, p);
    return lsf_f3(p[0], p[1], sqrtf(fmaxf(0.0f, 1.0f - p[0] * p[0] - p[1] * p[1])));
}

lsf_float3 lsf_sample_sphere(float u, float v)
{
    float z = 1.0f - 2.0f * u;
    float r = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    float phi = 2.0f * LSF_PI * v;
    return lsf_f3(r * cosf(phi), r * sinf(phi), z);
}

/* K. Shoemake, "Uniform Random Rotations", Graphics Gems III, 1992: a uniform unit quaternion. */
void lsf_sample_rotation(float u, float v, float w, float rows[9])
{
    float r1 = sqrtf(1.0f - u), r2 = sqrtf(u);
    float x = r1 * sinf(2.0f * LSF_PI * v), y = r1 * cosf(2.0f * LSF_PI * v);
    float z = r2 * sinf(2.0f * LSF_PI * w), s = r2 * cosf(2.0f * LSF_PI * w);
    rows[0] = 1.0f - 2.0f * (y * y + z * z);
    rows[1] = 2.0f * (x * y - s * z);
    rows[2] = 2.0f * (x * z + s * y);
    rows[3] = 2.0f * (x * y + s * z);
    rows[4] = 1.0f - 2.0f * (x * x + z * z);
    rows[5] = 2.0f * (y * z - s * x);
    rows[6] = 2.0f * (x * z - s * y);
    rows[7] = 2.0f * (y * z + s * x);
    rows[8] = 1.0f - 2.0f * (x * x + y * y);
}

/* E. Heitz, "A Low-Distortion Map Between Triangle and Square", 2019. */
void lsf_sample_triangle(float u, float v, float *b1, float *b2)
{
    if (v > u) {
        u *= 0.5f;
        v -= u;
    } else {
        v *= 0.5f;
        u -= v;
    }
    *b1 = u;
    *b2 = v;
}

/* E. Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018: the ellipsoid is
 * stretched to a hemisphere, whose projection along the view is a disc of which one half shrinks
 * by the cosine. */
lsf_float3 lsf_sample_ggx_visible_normal(lsf_float3 view, float alpha_t, float alpha_b, float u,
                                         float v)
{
    lsf_float3 stretched = lsf_f3_normalize(lsf_f3(alpha_t * view.x, alpha_b * view.y, view.z));
    lsf_basis frame = lsf_basis_about(stretched);
    /* The shrunk half must lie where the hemisphere ends: the frame's b axis points up in z. */
    float side = hypotf(stretched.x, stretched.y);
    if (side > 1e-7f) {
        frame.t = lsf_f3(-stretched.y / side, stretched.x / side, 0.0f);
        frame.b = lsf_f3_cross(stretched, frame.t);
    }
    float p[2];
    lsf_sample_disc(u, v, p);
    float s = 0.5f * (1.0f + stretched.z);
    p[1] = (1.0f - s) * sqrtf(fmaxf(0.0f, 1.0f - p[0] * p[0])) + s * p[1];
    float pz = sqrtf(fmaxf(0.0f, 1.0f - p[0] * p[0] - p[1] * p[1]));
    lsf_float3 n = lsf_basis_to_world(&frame, lsf_f3(p[0], p[1], pz));
    return lsf_f3_normalize(lsf_f3(alpha_t * n.x, alpha_b * n.y, fmaxf(1e-7f, n.z)));
}

float lsf_pdf_ggx_reflection(lsf_float3 view, lsf_float3 normal, float alpha_t, float alpha_b)
{
    if (normal.z <= 0.0f || view.z <= 0.0f)
        return 0.0f;
    float d = lsf_ggx_d_anisotropic(normal.z, normal.x, normal.y, alpha_t, alpha_b);
    float vt = alpha_t * view.x, vb = alpha_b * view.y;
    /* G1 / (4 v.z) */
    return 0.5f * d / (view.z + sqrtf(view.z * view.z + vt * vt + vb * vb));
}

float lsf_pdf_ggx_visible_normal(lsf_float3 view, lsf_float3 normal, float alpha_t, float alpha_b)
{
    float vh = lsf_f3_dot(view, normal);
    return vh > 0.0f ? 4.0f * vh * lsf_pdf_ggx_reflection(view, normal, alpha_t, alpha_b) : 0.0f;
}
