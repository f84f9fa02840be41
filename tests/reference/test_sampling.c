/* src/math: every sampler against its density, every distribution against its weights. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "chi_square.h"
#include "math/distribution.h"
#include "math/sampling.h"
#include "shared/brdf.h"

/* The first 2^k points of a scrambled (0,2)-sequence fill each elementary interval once. */
static void sobol_is_stratified(void **unused)
{
    (void)unused;
    enum { K = 8, N = 1 << K };
    for (uint32_t seed = 0; seed < 20; seed++) {
        for (uint32_t block = 0; block < 3; block++) {
            for (int split = 0; split <= K; split++) {
                bool seen[N] = {false};
                for (uint32_t i = 0; i < N; i++) {
                    float p[2];
                    lsf_sobol_2d(block * N + i, seed, p);
                    assert_true(p[0] >= 0.0f && p[0] < 1.0f && p[1] >= 0.0f && p[1] < 1.0f);
                    uint32_t x = (uint32_t)(p[0] * (float)(1 << split));
                    uint32_t y = (uint32_t)(p[1] * (float)(1 << (K - split)));
                    uint32_t cell = y << split | x;
                    assert_false(seen[cell]);
                    seen[cell] = true;
                }
            }
        }
    }
}

/* A single point is uniform over the seeds, and so is the pair that two seeds give. */
static void sobol_is_uniform_over_seeds(void **unused)
{
    (void)unused;
    enum { BINS = 16, N = 200000 };
    for (uint32_t index = 0; index < 5; index++) {
        double single[BINS * BINS] = {0}, pair[BINS * BINS] = {0};
        double expected[BINS * BINS];
        for (uint32_t i = 0; i < N; i++) {
            float p[2], q[2];
            lsf_sobol_2d(index, lsf_hash(7, i), p);
            lsf_sobol_2d(index, lsf_hash(8, i), q);
            single[(int)(p[0] * BINS) * BINS + (int)(p[1] * BINS)]++;
            pair[(int)(p[0] * BINS) * BINS + (int)(q[0] * BINS)]++;
        }
        for (int i = 0; i < BINS * BINS; i++)
            expected[i] = (double)N / (BINS * BINS);
        assert_true(chi_square_z(single, expected, BINS * BINS, 5.0) < 4.0);
        assert_true(chi_square_z(pair, expected, BINS * BINS, 5.0) < 4.0);
    }
}

static double smooth(double x, double y)
{
    return exp(-x) * sin(3.0 * y);
}

/* Root mean squared error of the mean of `n` values over many seeds. */
static void integration_error(uint32_t n, double *sobol, double *random)
{
    const double exact = (1.0 - exp(-1.0)) * (1.0 - cos(3.0)) / 3.0;
    double squares[2] = {0.0, 0.0};
    enum { SEEDS = 400 };
    for (uint32_t seed = 0; seed < SEEDS; seed++) {
        double sum[2] = {0.0, 0.0};
        for (uint32_t i = 0; i < n; i++) {
            float p[2];
            lsf_sobol_2d(i, lsf_hash(99, seed), p);
            sum[0] += smooth((double)p[0], (double)p[1]);
            sum[1] += smooth((double)lsf_random_float(seed, 2 * i),
                             (double)lsf_random_float(seed, 2 * i + 1));
        }
        for (int k = 0; k < 2; k++)
            squares[k] += (sum[k] / n - exact) * (sum[k] / n - exact) / SEEDS;
    }
    *sobol = sqrt(squares[0]);
    *random = sqrt(squares[1]);
}

static void sobol_beats_random(void **unused)
{
    (void)unused;
    double sobol[2], random[2];
    integration_error(16, &sobol[0], &random[0]);
    integration_error(256, &sobol[1], &random[1]);
    print_message("error of 16 points: %.2e scrambled Sobol, %.2e random; of 256: %.2e, %.2e\n",
                  sobol[0], random[0], sobol[1], random[1]);
    assert_true(sobol[0] < 0.35 * random[0]);
    assert_true(sobol[1] < 0.05 * random[1]);
}

/* Owen scrambling: the error of smooth integrands falls as N^-3/2. */
static void sobol_converges(void **unused)
{
    (void)unused;
    double a, b, ignored;
    integration_error(64, &a, &ignored);
    integration_error(1024, &b, &ignored);
    double slope = log(b / a) / log(1024.0 / 64.0);
    print_message("slope of the error: %.2f\n", slope);
    assert_true(slope < -1.3);
}

static void cosine_hemisphere_and_sphere(void **unused)
{
    (void)unused;
    enum { N = 400000, ROWS = 8, COLUMNS = 16 };
    double cosine[ROWS * COLUMNS] = {0}, sphere[ROWS * COLUMNS] = {0}, even[ROWS * COLUMNS];
    for (uint32_t i = 0; i < N; i++) {
        float u = lsf_random_float(1, i), v = lsf_random_float(2, i);
        lsf_float3 d = lsf_sample_cosine_hemisphere(u, v);
        assert_true(d.z >= 0.0f && fabsf(lsf_f3_length(d) - 1.0f) < 1e-5f);
        /* sin^2 is uniform under the cosine density */
        double row = fmin((double)(d.x * d.x + d.y * d.y), 0.999999);
        cosine[(int)(row * ROWS) * COLUMNS + angle_bin(d.x, d.y, COLUMNS)]++;
        d = lsf_sample_sphere(u, v);
        assert_true(fabsf(lsf_f3_length(d) - 1.0f) < 1e-5f);
        row = fmin(0.5 * ((double)d.z + 1.0), 0.999999);
        sphere[(int)(row * ROWS) * COLUMNS + angle_bin(d.x, d.y, COLUMNS)]++;
    }
    for (int i = 0; i < ROWS * COLUMNS; i++)
        even[i] = (double)N / (ROWS * COLUMNS);
    assert_true(chi_square_z(cosine, even, ROWS * COLUMNS, 5.0) < 4.0);
    assert_true(chi_square_z(sphere, even, ROWS * COLUMNS, 5.0) < 4.0);
}

static void triangle_is_uniform(void **unused)
{
    (void)unused;
    /* The four triangles that join the middles of the sides are hit alike; in each of them, too. */
    enum { N = 160000 };
    double counts[16] = {0}, expected[16];
    for (uint32_t i = 0; i < N; i++) {
        float b1, b2;
        lsf_sample_triangle(lsf_random_float(3, i), lsf_random_float(4, i), &b1, &b2);
        float b0 = 1.0f - b1 - b2;
        assert_true(b0 >= -1e-6f && b1 >= 0.0f && b2 >= 0.0f);
        int cell = 0;
        for (int level = 0; level < 2; level++) {
            int part = b0 > 0.5f ? 0 : b1 > 0.5f ? 1 : b2 > 0.5f ? 2 : 3;
            if (part == 3) {
                b0 = 1.0f - 2.0f * b0;
                b1 = 1.0f - 2.0f * b1;
                b2 = 1.0f - 2.0f * b2;
            } else {
                b0 = 2.0f * b0 - (part == 0 ? 1.0f : 0.0f);
                b1 = 2.0f * b1 - (part == 1 ? 1.0f : 0.0f);
                b2 = 2.0f * b2 - (part == 2 ? 1.0f : 0.0f);
            }
            cell = 4 * cell + part;
        }
        counts[cell]++;
    }
    for (int i = 0; i < 16; i++)
        expected[i] = N / 16.0;
    assert_true(chi_square_z(counts, expected, 16, 5.0) < 4.0);
}

static void rotation_is_orthonormal_and_uniform(void **unused)
{
    (void)unused;
    enum { N = 100000, BINS = 16 };
    double counts[3][BINS] = {{0}}, expected[BINS];
    for (uint32_t i = 0; i < N; i++) {
        float m[9];
        lsf_sample_rotation(lsf_random_float(5, i), lsf_random_float(6, i), lsf_random_float(7, i),
                            m);
        lsf_float3 x = lsf_f3_load(m), y = lsf_f3_load(m + 3), z = lsf_f3_load(m + 6);
        lsf_float3 c = lsf_f3_sub(lsf_f3_cross(x, y), z);
        assert_true(lsf_f3_max_abs(c) < 1e-5f && fabsf(lsf_f3_length(x) - 1.0f) < 1e-5f);
        /* Each component of a uniform direction is uniform in -1..1. */
        for (int k = 0; k < 3; k++)
            counts[k][(int)fminf((m[4 * k] + 1.0f) * 0.5f * BINS, BINS - 1)]++;
    }
    for (int i = 0; i < BINS; i++)
        expected[i] = (double)N / BINS;
    for (int k = 0; k < 3; k++)
        assert_true(chi_square_z(counts[k], expected, BINS, 5.0) < 4.0);
}

/* Normals are looked at where GGX is stretched to a hemisphere, in which even the smoothest
 * surface fills many bins: s = normalise(h_t / alpha_t, h_b / alpha_b, h_n), and back
 * d omega_h / d omega_s = alpha_t alpha_b / |(alpha_t s_t, alpha_b s_b, s_n)|^3. */
static double stretched_pdf(lsf_float3 view, double z, double phi, float alpha_t, float alpha_b)
{
    double r = sqrt(1.0 - z * z);
    double x = alpha_t * r * cos(phi), y = alpha_b * r * sin(phi);
    double length = sqrt(x * x + y * y + z * z);
    lsf_float3 h = lsf_f3((float)(x / length), (float)(y / length), (float)(z / length));
    return (double)lsf_pdf_ggx_visible_normal(view, h, alpha_t, alpha_b) * alpha_t * alpha_b /
           (length * length * length);
}

static void check_ggx(float alpha_t, float alpha_b, float cosine, float azimuth)
{
    enum { N = 200000, ROWS = 12, COLUMNS = 24, FINE = 24 };
    float sine = sqrtf(1.0f - cosine * cosine);
    lsf_float3 view = lsf_f3(sine * cosf(azimuth), sine * sinf(azimuth), cosine);
    double counts[ROWS * COLUMNS] = {0}, expected[ROWS * COLUMNS] = {0}, total = 0.0;
    for (uint32_t i = 0; i < N; i++) {
        float u[2] = {lsf_random_float(11, i), lsf_random_float(12, i)};
        lsf_float3 h = lsf_sample_ggx_visible_normal(view, alpha_t, alpha_b, u[0], u[1]);
        assert_true(fabsf(lsf_f3_length(h) - 1.0f) < 1e-5f);
        lsf_float3 s = lsf_f3_normalize(lsf_f3(h.x / alpha_t, h.y / alpha_b, h.z));
        int row = (int)fminf(s.z * ROWS, ROWS - 1);
        counts[row * COLUMNS + angle_bin(s.x, s.y, COLUMNS)]++;
    }
    for (int row = 0; row < ROWS * FINE; row++) {
        for (int column = 0; column < COLUMNS * FINE; column++) {
            double z = (row + 0.5) / (ROWS * FINE);
            double phi = (column + 0.5) / (COLUMNS * FINE) * 2.0 * M_PI - M_PI;
            double part = stretched_pdf(view, z, phi, alpha_t, alpha_b) * 2.0 * M_PI /
                          ((double)ROWS * FINE * COLUMNS * FINE);
            expected[row / FINE * COLUMNS + column / FINE] += part * N;
            total += part;
        }
    }
    double z = chi_square_z(counts, expected, ROWS * COLUMNS, 8.0);
    if (fabs(total - 1.0) > 2e-3 || z > 4.0)
        fail_msg("alpha %g x %g, cosine %g, azimuth %g: density integrates to %.5f, z = %.2f",
                 (double)alpha_t, (double)alpha_b, (double)cosine, (double)azimuth, total, z);
}

static void ggx_visible_normals(void **unused)
{
    (void)unused;
    static const float alphas[] = {LSF_ALPHA_MIN, 0.01f, 0.09f, 0.25f, 0.64f, 1.0f};
    static const float cosines[] = {1.0f, 0.95f, 0.7f, 0.3f, 0.05f};
    for (size_t a = 0; a < sizeof alphas / sizeof *alphas; a++)
        for (size_t c = 0; c < sizeof cosines / sizeof *cosines; c++)
            check_ggx(alphas[a], alphas[a], cosines[c], 0.7f);
    static const float pairs[][2] = {{0.01f, 0.3f}, {0.9f, 0.04f}, {0.25f, 1.0f}};
    for (size_t p = 0; p < 3; p++)
        for (size_t c = 0; c < sizeof cosines / sizeof *cosines; c++)
            for (float azimuth = -2.5f; azimuth < 3.0f; azimuth += 1.25f)
                check_ggx(pairs[p][0], pairs[p][1], cosines[c], azimuth);
}

static void distribution_follows_weights(void **unused)
{
    (void)unused;
    static const float weights[] = {0.0f, 1.0f, 0.0f, 0.0f, 2.5f, 1e-3f, 4.0f, 0.0f};
    enum { COUNT = 8, N = 100000 };
    lsf_distribution d;
    assert_true(lsf_distribution_init(&d, weights, COUNT));
    double counts[COUNT] = {0}, expected[COUNT];
    for (uint32_t i = 0; i < N; i++) {
        double rest;
        uint64_t k = lsf_distribution_sample(&d, lsf_unit_double(lsf_hash(21, i)), &rest);
        assert_true(k < COUNT && weights[k] > 0.0f && rest >= 0.0 && rest < 1.0);
        counts[k]++;
    }
    for (uint64_t i = 0; i < COUNT; i++)
        expected[i] = lsf_distribution_probability(&d, i) * N;
    assert_true(fabs(lsf_distribution_probability(&d, 4) - 2.5 / 7.501) < 1e-8);
    assert_true(chi_square_z(counts, expected, COUNT, 5.0) < 4.0);
    assert_int_equal(lsf_distribution_sample(&d, 0.0, NULL), 1);
    assert_int_equal(lsf_distribution_sample(&d, 1.0 - 0x1p-32, NULL), 6);
    lsf_distribution_finish(&d);

    static const float zeros[3] = {0};
    assert_true(lsf_distribution_init(&d, zeros, 3));
    assert_true(d.sum == 0.0);
    lsf_distribution_finish(&d);
}

static void distribution_2d_follows_weights(void **unused)
{
    (void)unused;
    enum { WIDTH = 7, HEIGHT = 5, N = 200000 };
    float weights[WIDTH * HEIGHT];
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++)
        weights[i] = i / WIDTH == 2 || i % 5 == 0 ? 0.0f : lsf_random_float(31, i);
    lsf_distribution_2d d;
    assert_true(lsf_distribution_2d_init(&d, weights, WIDTH, HEIGHT));
    double counts[WIDTH * HEIGHT] = {0}, expected[WIDTH * HEIGHT], total = 0.0;
    for (uint32_t i = 0; i < N; i++) {
        double x, y;
        double pdf = lsf_distribution_2d_sample(&d, lsf_unit_double(lsf_hash(32, i)),
                                                lsf_unit_double(lsf_hash(33, i)), &x, &y);
        assert_true(x >= 0.0 && x < 1.0 && y >= 0.0 && y < 1.0 && pdf > 0.0);
        assert_true(pdf == lsf_distribution_2d_pdf(&d, x, y));
        counts[(int)(y * HEIGHT) * WIDTH + (int)(x * WIDTH)]++;
    }
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        double pdf =
            lsf_distribution_2d_pdf(&d, (i % WIDTH + 0.5) / WIDTH, (i / WIDTH + 0.5) / HEIGHT);
        expected[i] = pdf * N / (WIDTH * HEIGHT);
        total += pdf / (WIDTH * HEIGHT);
    }
    assert_true(fabs(total - 1.0) < 1e-9);
    assert_true(chi_square_z(counts, expected, WIDTH * HEIGHT, 5.0) < 4.0);
    lsf_distribution_2d_finish(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sobol_is_stratified),
        cmocka_unit_test(sobol_is_uniform_over_seeds),
        cmocka_unit_test(sobol_beats_random),
        cmocka_unit_test(sobol_converges),
        cmocka_unit_test(cosine_hemisphere_and_sphere),
        cmocka_unit_test(triangle_is_uniform),
        cmocka_unit_test(rotation_is_orthonormal_and_uniform),
        cmocka_unit_test(ggx_visible_normals),
        cmocka_unit_test(distribution_follows_weights),
        cmocka_unit_test(distribution_2d_follows_weights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
