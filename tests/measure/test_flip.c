/* FLIP by the papers' equations as they are written, and where they can be worked out by hand. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "measure/flip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double ppd = 0.7 * 3840 / 0.7 * M_PI / 180;

typedef struct vec {
    double v[3];
} vec;

/* IEC 61966-2-1 and D65, in more digits than it takes. */
static vec xyz(vec c)
{
    static const double m[3][3] = {
        {10135552, 8788810, 4435075}, {2613072, 8788810, 887015}, {1425312, 8788810, 70074185}};
    static const double divisors[3] = {24577794, 12288897, 73733382};
    vec r = {{0}};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            r.v[i] += m[i][k] / divisors[i] * c.v[k];
    return r;
}

static vec white(void)
{
    return xyz((vec){{1, 1, 1}});
}

/* Solves xyz(rgb) = c by Cramer's rule. */
static double determinant(vec a, vec b, vec c)
{
    return a.v[0] * (b.v[1] * c.v[2] - b.v[2] * c.v[1]) -
           b.v[0] * (a.v[1] * c.v[2] - a.v[2] * c.v[1]) +
           c.v[0] * (a.v[1] * b.v[2] - a.v[2] * b.v[1]);
}

static vec rgb(vec c)
{
    vec r = xyz((vec){{1, 0, 0}}), g = xyz((vec){{0, 1, 0}}), b = xyz((vec){{0, 0, 1}});
    double whole = determinant(r, g, b);
    return (vec){
        {determinant(c, g, b) / whole, determinant(r, c, b) / whole, determinant(r, g, c) / whole}};
}

static vec ycxcz(vec c)
{
    vec p = xyz(c), w = white();
    return (vec){{116 * p.v[1] / w.v[1] - 16, 500 * (p.v[0] / w.v[0] - p.v[1] / w.v[1]),
                  200 * (p.v[1] / w.v[1] - p.v[2] / w.v[2])}};
}

static vec rgb_of_ycxcz(vec c)
{
    vec w = white();
    double y = (c.v[0] + 16) / 116;
    return rgb((vec){{(y + c.v[1] / 500) * w.v[0], y * w.v[1], (y - c.v[2] / 200) * w.v[2]}});
}

static double lab_f(double t)
{
    const double d = 6.0 / 29;
    return t > d * d * d ? cbrt(t) : t / (3 * d * d) + 4.0 / 29;
}

static vec hunt(vec c)
{
    vec p = xyz(c), w = white();
    double x = lab_f(p.v[0] / w.v[0]), y = lab_f(p.v[1] / w.v[1]), z = lab_f(p.v[2] / w.v[2]);
    double lightness = 116 * y - 16;
    return (vec){{lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)}};
}

static double hyab(vec a, vec b)
{
    return fabs(a.v[0] - b.v[0]) + hypot(a.v[1] - b.v[1], a.v[2] - b.v[2]);
}

static double colour_error(vec a, vec b)
{
    double largest = pow(hyab(hunt((vec){{0, 1, 0}}), hunt((vec){{0, 0, 1}})), 0.7);
    double error = pow(hyab(a, b), 0.7), knee = 0.4 * largest;
    return error < knee ? 0.95 / knee * error : 0.95 + (error - knee) / (largest - knee) * 0.05;
}

enum { WIDTH = 29, HEIGHT = 23, PIXELS = WIDTH * HEIGHT };

static vec pixel(const float *picture, int x, int y)
{
    x = x < 0 ? 0 : x < WIDTH ? x : WIDTH - 1;
    y = y < 0 ? 0 : y < HEIGHT ? y : HEIGHT - 1;
    const float *p = picture + 3 * (y * WIDTH + x);
    return (vec){{(double)p[0], (double)p[1], (double)p[2]}};
}

/* Equation by equation in the plane, nothing separated. */
static vec seen(const float *picture, int x, int y)
{
    static const double a[3][2] = {{1, 0}, {1, 0}, {34.1, 13.5}};
    static const double b[3][2] = {{0.0047, 1e-5}, {0.0053, 1e-5}, {0.04, 0.025}};
    int radius = (int)ceil(3 * sqrt(0.04 / (2 * M_PI * M_PI)) * ppd);
    vec sum = {{0}}, weights = {{0}};
    for (int j = -radius; j <= radius; j++)
        for (int i = -radius; i <= radius; i++) {
            double square = (i * i + j * j) / (ppd * ppd);
            vec c = ycxcz(pixel(picture, x + i, y + j));
            for (int k = 0; k < 3; k++) {
                double g = 0;
                for (int t = 0; t < 2; t++)
                    g += a[k][t] * sqrt(M_PI / b[k][t]) * exp(-M_PI * M_PI / b[k][t] * square);
                sum.v[k] += g * c.v[k];
                weights.v[k] += g;
            }
        }
    for (int k = 0; k < 3; k++)
        sum.v[k] /= weights.v[k];
    vec c = rgb_of_ycxcz(sum);
    for (int k = 0; k < 3; k++)
        c.v[k] = fmin(fmax(c.v[k], 0), 1);
    return hunt(c);
}

static double feature(const float *picture, int x, int y, bool point)
{
    double sigma = 0.5 * 0.082 * ppd, sums[2] = {0};
    int radius = (int)ceil(3 * sigma);
    for (int axis = 0; axis < 2; axis++) {
        double positive = 0, negative = 0, above = 0, below = 0;
        for (int j = -radius; j <= radius; j++)
            for (int i = -radius; i <= radius; i++) {
                double along = axis ? j : i;
                double g = exp(-(i * i + j * j) / (2 * sigma * sigma)) *
                           (point ? along * along / (sigma * sigma) - 1 : -along);
                double luma = (ycxcz(pixel(picture, x + i, y + j)).v[0] + 16) / 116;
                if (g > 0) {
                    positive += g;
                    above += g * luma;
                } else {
                    negative -= g;
                    below += g * luma;
                }
            }
        sums[axis] = above / positive + below / negative;
    }
    return hypot(sums[0], sums[1]);
}

static double slow_flip(const float *test, const float *reference, int x, int y)
{
    double colours = colour_error(seen(test, x, y), seen(reference, x, y));
    double edges = fabs(feature(test, x, y, false) - feature(reference, x, y, false));
    double points = fabs(feature(test, x, y, true) - feature(reference, x, y, true));
    return pow(colours, 1 - sqrt(fmax(edges, points) / M_SQRT2));
}

static const double close_enough = 2e-5; /* single precision, and a root of small differences */

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.12g is not %.12g", value, expected);
}

static float random_value(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (float)(*state >> 40) / 16777216.0f;
}

static void fill(float *picture, float r, float g, float b)
{
    for (int i = 0; i < PIXELS; i++)
        memcpy(picture + 3 * i, (float[]){r, g, b}, 3 * sizeof(float));
}

static void check_map(const float *test, const float *reference)
{
    float map[PIXELS];
    assert_true(lsf_flip(&(lsf_flip_pair){test, reference, WIDTH, HEIGHT}, map));
    for (int y = 0; y < HEIGHT; y += 3) /* the slow way is slow */
        for (int x = 0; x < WIDTH; x += 4)
            assert_near((double)map[y * WIDTH + x], slow_flip(test, reference, x, y), close_enough);
}

static void test_the_slow_way(void **state)
{
    (void)state;
    float test[3 * PIXELS], reference[3 * PIXELS];
    uint64_t random = 3;
    for (int i = 0; i < 3 * PIXELS; i++) { /* stripes and noise */
        reference[i] = 0.2f + 0.5f * (float)(i / 3 % WIDTH / 5 % 2) + 0.3f * random_value(&random);
        test[i] = fminf(reference[i] * (0.6f + 0.8f * random_value(&random)), 1.0f);
    }
    check_map(test, reference);
}

static void test_one_point(void **state)
{
    (void)state;
    float test[3 * PIXELS], reference[3 * PIXELS];
    fill(test, 0.1f, 0.1f, 0.1f);
    fill(reference, 0.1f, 0.1f, 0.1f);
    test[3 * (11 * WIDTH + 12)] = 1.0f;
    check_map(test, reference);
}

static void test_edges_are_features(void **state)
{
    (void)state;
    float test[3 * PIXELS], reference[3 * PIXELS];
    fill(reference, 0.3f, 0.3f, 0.3f);
    for (int i = 0; i < 3 * PIXELS; i++)
        test[i] = i / 3 % WIDTH < WIDTH / 2 ? 0.25f : 0.35f;
    check_map(test, reference);
}

/* Without features the map is the compressed difference of colours: filters keep what is constant.
 */
static void test_constant_pictures(void **state)
{
    (void)state;
    static const float colours[][3] = {{0, 0, 0}, {1, 1, 1}, {0, 1, 0}, {0, 0, 1}, {.2f, .1f, .4f}};
    enum { COLOURS = sizeof colours / sizeof colours[0] };
    float test[3 * PIXELS], reference[3 * PIXELS], map[PIXELS];
    for (int a = 0; a < COLOURS; a++)
        for (int b = 0; b < COLOURS; b++) {
            const float *p = colours[a], *q = colours[b];
            fill(test, p[0], p[1], p[2]);
            fill(reference, q[0], q[1], q[2]);
            assert_true(lsf_flip(&(lsf_flip_pair){test, reference, WIDTH, HEIGHT}, map));
            double expected = colour_error(hunt((vec){{(double)p[0], (double)p[1], (double)p[2]}}),
                                           hunt((vec){{(double)q[0], (double)q[1], (double)q[2]}}));
            assert_near((double)map[0], expected, close_enough);
            assert_near((double)map[PIXELS / 2], expected, close_enough);
        }
    /* Black and white differ by 100 in lightness, green and blue by the most there is. */
    assert_near(colour_error(hunt((vec){{0, 1, 0}}), hunt((vec){{0, 0, 1}})), 1.0, 1e-12);
}

static void test_small_pictures(void **state)
{
    (void)state;
    static const float test[6] = {1, 0, 0, 0, 1, 0}, reference[6] = {0};
    float map[2];
    assert_true(lsf_flip(&(lsf_flip_pair){test, test, 2, 1}, map));
    assert_true(map[0] == 0 && map[1] == 0);
    assert_true(lsf_flip(&(lsf_flip_pair){test, reference, 1, 2}, map));
    assert_true(map[0] > 0.5f && map[0] <= 1 && map[1] > 0.5f && map[1] <= 1);
}

/* A reference of 1 with one pixel of 8: from 3 EV below where the curve reaches 0.85 to there. */
static void test_exposures(void **state)
{
    (void)state;
    float reference[3 * PIXELS];
    uint8_t compared[PIXELS];
    memset(compared, 1, sizeof compared);
    fill(reference, 1, 1, 1);
    for (int c = 0; c < 3; c++)
        reference[3 * 100 + c] = 8;
    lsf_flip_pair pair = {reference, reference, WIDTH, HEIGHT};
    lsf_flip_exposures e;
    assert_true(lsf_flip_choose_exposures(&pair, compared, &e));
    double x = exp2((double)e.stop) * 0.6;
    assert_near((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.85, 1e-5);
    assert_near((double)(e.stop - e.start), 3, 1e-5);
    assert_true(e.count == 3 || e.count == 4); /* rounding decides */
    compared[100] = 0;
    assert_true(lsf_flip_choose_exposures(&pair, compared, &e));
    assert_near((double)(e.stop - e.start), 0, 1e-5);
    assert_int_equal(e.count, 2);
    /* Mostly black: the median of what is not. */
    memset(reference, 0, sizeof reference / 2 + sizeof(float) * 60);
    assert_true(lsf_flip_choose_exposures(&pair, compared, &e));
    assert_int_equal(e.count, 2);
    memset(reference, 0, sizeof reference);
    assert_true(lsf_flip_choose_exposures(&pair, compared, &e));
    assert_int_equal(e.count, 0);
}

/* The largest of the maps, each by the curve as it is written. */
static void test_hdr_is_the_largest(void **state)
{
    (void)state;
    float test[3 * PIXELS], reference[3 * PIXELS], map[PIXELS], largest[PIXELS] = {0};
    uint64_t random = 8;
    for (int i = 0; i < 3 * PIXELS; i++) {
        reference[i] = powf(2.0f, 6.0f * (float)(i / 3 % WIDTH) / WIDTH);
        test[i] = reference[i] * (0.5f + random_value(&random));
    }
    const lsf_flip_exposures e = {-5, -1, 3};
    assert_true(lsf_flip_hdr(&(lsf_flip_pair){test, reference, WIDTH, HEIGHT}, &e, map));
    for (int step = 0; step < 3; step++) {
        float shown[2][3 * PIXELS], one[PIXELS];
        for (int i = 0; i < 6 * PIXELS; i++) {
            double x = (double)(i < 3 * PIXELS ? test : reference)[i % (3 * PIXELS)];
            x *= 0.6 * exp2(-5 + 2 * step);
            shown[i / (3 * PIXELS)][i % (3 * PIXELS)] =
                (float)fmin((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 1.0);
        }
        assert_true(lsf_flip(&(lsf_flip_pair){shown[0], shown[1], WIDTH, HEIGHT}, one));
        for (int i = 0; i < PIXELS; i++)
            largest[i] = fmaxf(largest[i], one[i]);
    }
    for (int i = 0; i < PIXELS; i++)
        assert_near((double)map[i], (double)largest[i], 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_slow_way),       cmocka_unit_test(test_one_point),
        cmocka_unit_test(test_edges_are_features), cmocka_unit_test(test_constant_pictures),
        cmocka_unit_test(test_small_pictures),     cmocka_unit_test(test_exposures),
        cmocka_unit_test(test_hdr_is_the_largest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
