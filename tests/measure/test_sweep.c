/* What a measurement's numbers are made of, against closed forms and simulated pictures. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/base.h"
#include "math/sampling.h"
#include "sweep/errors.h"
#include "sweep/fit.h"
#include "sweep/front.h"
#include "sweep/grid.h"
#include "sweep/path.h"
#include "sweep/statistics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NEAR(a, b, within) assert_float_equal((float)((a) - (b)), 0.0f, (float)(within))

static void test_student(void **state)
{
    (void)state;
    static const struct {
        uint32_t degrees;
        double quantile; /* of printed tables */
    } rows[] = {{1, 12.7062}, {2, 4.3027}, {3, 3.1824}, {7, 2.3646}, {30, 2.0423}, {1000, 1.9623}};
    for (size_t i = 0; i < LSF_COUNT(rows); i++)
        NEAR(lsf_student_quantile(rows[i].degrees), rows[i].quantile, 1e-4);
    NEAR(lsf_student_probability(0.0, 5), 0.5, 1e-12);
    NEAR(lsf_student_probability(1.0, 1), 0.75, 1e-12); /* Cauchy's distribution */
    NEAR(lsf_student_probability(-1.0, 1), 0.25, 1e-12);
    NEAR(lsf_student_probability(sqrt(2.0), 2), 0.5 + 0.5 / sqrt(2.0), 1e-12);
}

static void test_means(void **state)
{
    (void)state;
    double values[] = {4.0, 1.0, 3.0, 2.0};
    lsf_estimate mean = lsf_mean_of(values, 4, 0.0);
    double half = 3.182446 * sqrt(5.0 / 3.0 / 4.0);
    NEAR(mean.value, 2.5, 1e-12);
    NEAR(mean.low, 2.5 - half, 1e-5);
    NEAR(mean.high, 2.5 + half, 1e-5);
    mean = lsf_mean_of(values, 4, 3.0);
    NEAR(mean.high - 2.5, hypot(half, 1.959964 * 3.0), 1e-5);
    assert_true(isnan(lsf_mean_of(values, 1, 0.0).low));
    assert_true(isnan(lsf_mean_of(values, 0, 0.0).value));

    lsf_quartiles quartiles = lsf_quartiles_of(values, 4);
    NEAR(quartiles.lower, 1.75, 1e-12);
    NEAR(quartiles.median, 2.5, 1e-12);
    NEAR(quartiles.upper, 3.25, 1e-12);
    assert_true(isnan(lsf_quartiles_of(values, 0).median));

    double nine[] = {9.0, 1.0, 5.0, 3.0, 7.0, 2.0, 8.0, 6.0, 4.0};
    lsf_estimate median = lsf_median_of(nine, 9);
    NEAR(median.value, 5.0, 0.0);
    NEAR(median.low, 2.0, 0.0);
    NEAR(median.high, 8.0, 0.0);
    median = lsf_median_of(nine, 6);
    NEAR(median.low, 1.0, 0.0);
    NEAR(median.high, 6.0, 0.0);
    median = lsf_median_of(nine, 5);
    NEAR(median.value, 3.0, 0.0);
    assert_true(isnan(median.low) && isnan(median.high));
    assert_true(isnan(lsf_median_of(nine, 0).value));

    /* The jackknife of a mean is the mean's own interval. */
    double left_out[] = {2.0, 3.0, 7.0 / 3.0, 8.0 / 3.0};
    lsf_estimate jackknife = lsf_jackknife(2.5, left_out, 4, 0.0);
    NEAR(jackknife.low, 2.5 - half, 1e-5);
}

/* --- pictures --- */

enum { WIDTH = 16, HEIGHT = 8, PIXELS = WIDTH * HEIGHT };

static lsf_image *new_image(void)
{
    static const char *const names[] = {"R", "G", "B"};
    lsf_image *image = lsf_image_create(WIDTH, HEIGHT, 3, names, NULL);
    assert_non_null(image);
    return image;
}

/* Rows of a Hadamard matrix: two different ones are orthogonal, each has the mean square 1. */
static float pattern(uint32_t row, uint32_t pixel)
{
    return __builtin_popcount(row & pixel) % 2 ? -1.0f : 1.0f;
}

static void test_products_of_patterns(void **state)
{
    (void)state;
    enum { SEEDS = 3 };
    lsf_image *pictures[SEEDS], *halves[2] = {new_image(), new_image()};
    for (uint32_t s = 0; s < SEEDS; s++)
        pictures[s] = new_image();
    for (uint32_t i = 0; i < PIXELS; i++)
        for (uint32_t c = 0; c < 3; c++) {
            float truth = 2.0f;
            halves[0]->pixels[3 * i + c] = truth + 0.25f * pattern(1, i);
            halves[1]->pixels[3 * i + c] = truth + 0.25f * pattern(2, i);
            for (uint32_t s = 0; s < SEEDS; s++)
                pictures[s]->pixels[3 * i + c] =
                    truth + 0.5f * pattern(4, i) + 0.125f * pattern(8 + s, i);
        }
    lsf_reference_halves reference = {WIDTH, HEIGHT, {halves[0]->pixels, halves[1]->pixels},
                                      0,     {0},    0};
    lsf_reference_halves_derive(&reference);
    NEAR(reference.mean[1], 2.0, 1e-12);
    NEAR(reference.epsilon, 0.04, 1e-12);
    NEAR(reference.rmse, 0.25 / sqrt(2.0), 1e-12);

    lsf_squared_error mse, relmse;
    lsf_errors_measure(&reference, (const lsf_image *const *)pictures, SEEDS, &mse, &relmse);
    lsf_squared_error_derive(&mse, SEEDS);
    NEAR(mse.products[0][0], 0.25 + 1.0 / 64.0, 1e-12);
    NEAR(mse.products[0][2], 0.25, 1e-12);
    NEAR(mse.products[2][1], 0.25, 1e-12);
    NEAR(mse.error.value, 0.25 + 1.0 / 64.0, 1e-12);
    NEAR(mse.squared_bias.value, 0.25, 1e-12);
    NEAR(mse.variance, 1.0 / 64.0, 1e-12);
    NEAR(mse.error.high, mse.error.value + 1.959964 * mse.reference_deviation, 1e-7);

    /* A pixel that is not finite in one picture counts in none. */
    pictures[1]->pixels[3 * 5 + 1] = NAN;
    lsf_errors_measure(&reference, (const lsf_image *const *)pictures, SEEDS, &mse, &relmse);
    assert_true(isfinite(mse.products[0][0]) && isfinite(relmse.products[1][2]));
    for (uint32_t s = 0; s < SEEDS; s++)
        lsf_image_destroy(pictures[s]);
    lsf_image_destroy(halves[0]);
    lsf_image_destroy(halves[1]);
}

/* Two frames of one scene: what moves, what is missing of it, noise of pictures and halves. */
static void test_changes(void **state)
{
    (void)state;
    lsf_image *x[2] = {new_image(), new_image()}, *halves[2][2];
    for (uint32_t f = 0; f < 2; f++)
        for (uint32_t h = 0; h < 2; h++)
            halves[f][h] = new_image();
    for (uint32_t i = 0; i < PIXELS; i++)
        for (uint32_t c = 0; c < 3; c++)
            for (uint32_t f = 0; f < 2; f++) {
                float moves = f ? 0.5f * pattern(16, i) : 0.0f;
                float noise = 1e-3f; /* so little that weights are all alike */
                x[f]->pixels[3 * i + c] = 100.0f + 0.75f * moves + 0.25f * pattern(1 + f, i);
                for (uint32_t h = 0; h < 2; h++)
                    halves[f][h]->pixels[3 * i + c] =
                        100.0f + moves + noise * pattern(4 + 2 * f + h, i);
            }
    double weight = 1.0 / (1.01 * 100.0 * 100.0);
    lsf_path_change change = lsf_path_change_of(x[1], x[0], (const lsf_image *const *)halves[1],
                                                (const lsf_image *const *)halves[0]);
    NEAR(change.motion / weight / 0.25, 1.0, 1e-3);
    NEAR(change.difference / weight / (0.125 * 0.125 + 2.0 * 0.25 * 0.25), 1.0, 1e-3);
    double flicker = lsf_path_flicker_of(x[1], x[0], (const lsf_image *const *)halves[0]);
    NEAR(flicker / weight / (0.375 * 0.375 + 2.0 * 0.25 * 0.25), 1.0, 1e-3);
    for (uint32_t f = 0; f < 2; f++) {
        lsf_image_destroy(x[f]);
        lsf_image_destroy(halves[f][0]);
        lsf_image_destroy(halves[f][1]);
    }
}

/* --- fits --- */

static void test_fit_of_a_law(void **state)
{
    (void)state;
    enum { POINTS = 5, SEEDS = 3 };
    static const double exponents[] = {1.0, 1.5, 0.5};
    for (size_t e = 0; e < LSF_COUNT(exponents); e++) {
        lsf_squared_error errors[POINTS] = {0};
        const lsf_squared_error *list[POINTS];
        uint32_t samples[POINTS];
        for (uint32_t k = 0; k < POINTS; k++) {
            samples[k] = 1u << k;
            double noise = 0.3 * pow(samples[k], -exponents[e]);
            for (uint32_t s = 0; s < SEEDS; s++)
                for (uint32_t t = 0; t < SEEDS; t++)
                    errors[k].products[s][t] = 0.02 + (s == t ? noise : 0.0);
            list[k] = &errors[k];
        }
        lsf_error_fit fit = lsf_error_fit_make(list, samples, POINTS, SEEDS);
        NEAR(fit.floor.value, 0.02, 1e-9);
        NEAR(fit.noise.value, 0.3, 1e-8);
        NEAR(fit.exponent.value, exponents[e], 1e-9);
        NEAR(fit.floor.high, 0.02, 1e-9);
        NEAR(lsf_error_fit_at(&fit, 64.0), 0.02 + 0.3 * pow(64.0, -exponents[e]), 1e-9);
        assert_true(isnan(lsf_error_fit_make(list, samples, 2, SEEDS).floor.value));
        assert_true(isnan(lsf_error_fit_make(list, samples, POINTS, 1).floor.value));
    }
}

static double normal(uint32_t seed, uint32_t *index)
{
    double u = 1.0 - (double)lsf_random_float(seed, (*index)++);
    double v = (double)lsf_random_float(seed, (*index)++);
    return sqrt(-2.0 * log(u)) * cos(2.0 * M_PI * v);
}

/* Pictures with a bias and independent noise of variance 1 / N, halves with noise of their own. */
static lsf_error_fit simulate(uint32_t experiment, double bias, uint32_t points, uint32_t seeds)
{
    lsf_squared_error mse[8], relmse[8];
    const lsf_squared_error *list[8];
    uint32_t samples[8], index = 0;
    lsf_image *halves[2] = {new_image(), new_image()}, *pictures[8] = {0};
    for (uint32_t i = 0; i < 3 * PIXELS; i++)
        for (int h = 0; h < 2; h++)
            halves[h]->pixels[i] = (float)(1.0 + 0.05 * normal(experiment, &index));
    lsf_reference_halves reference = {WIDTH, HEIGHT, {halves[0]->pixels, halves[1]->pixels},
                                      0,     {0},    0};
    for (uint32_t k = 0; k < points; k++) {
        samples[k] = 1u << k;
        for (uint32_t s = 0; s < seeds; s++) {
            pictures[s] = new_image();
            for (uint32_t i = 0; i < 3 * PIXELS; i++)
                pictures[s]->pixels[i] =
                    (float)(1.0 + bias + normal(experiment, &index) / sqrt(samples[k]));
        }
        lsf_errors_measure(&reference, (const lsf_image *const *)pictures, seeds, &mse[k],
                           &relmse[k]);
        list[k] = &mse[k];
        for (uint32_t s = 0; s < seeds; s++)
            lsf_image_destroy(pictures[s]);
    }
    lsf_image_destroy(halves[0]);
    lsf_image_destroy(halves[1]);
    return lsf_error_fit_make(list, samples, points, seeds);
}

/* Of 95 % intervals 80 of 100 hold what is true, or the chance was below 1e-6. */
static void test_intervals_hold_the_truth(void **state)
{
    (void)state;
    static const double biases[] = {0.0, 0.3};
    for (size_t b = 0; b < LSF_COUNT(biases); b++) {
        uint32_t floors = 0, exponents = 0;
        double mean = 0.0;
        for (uint32_t i = 0; i < 100; i++) {
            lsf_error_fit fit = simulate(1000 * (uint32_t)b + i, biases[b], 4, 4);
            double truth = biases[b] * biases[b];
            floors += fit.floor.low <= truth && truth <= fit.floor.high;
            exponents += fit.exponent.low <= 1.0 && 1.0 <= fit.exponent.high;
            mean += fit.floor.value / 100.0;
        }
        assert_in_range(floors, 80, 100);
        assert_in_range(exponents, 80, 100);
        NEAR(mean, biases[b] * biases[b], 0.01);
    }
}

/* --- fronts --- */

static lsf_measured_point point_of(double milliseconds, double relmse, double ssim)
{
    return (lsf_measured_point){.milliseconds = {.median = milliseconds},
                                .relmse = {.error = {.value = relmse}},
                                .ssim = {.value = ssim}};
}

static void test_front(void **state)
{
    (void)state;
    lsf_measured_point points[] = {
        point_of(1, 1.0, 0.2), point_of(2, 0.5, 0.4), point_of(2, 0.6, 0.5), point_of(3, 0.5, 0.6),
        point_of(4, 0.1, 0.8), point_of(4, 0.1, 0.8), point_of(5, NAN, 0.9)};
    static const bool expected[] = {true, true, false, false, true, true, false};
    lsf_front_mark(points, LSF_COUNT(points));
    for (size_t i = 0; i < LSF_COUNT(points); i++)
        assert_int_equal(points[i].front, expected[i]);
    lsf_front_gain(points, LSF_COUNT(points));
    assert_true(isnan(points[0].ssim_gain));
    NEAR(points[1].ssim_gain, 20.0, 1e-9);
    NEAR(points[4].ssim_gain, 20.0, 1e-9);
}

static lsf_measured_point *add_point(lsf_measurement *m, uint32_t samples, double milliseconds,
                                     double relmse)
{
    lsf_measured_point *point = lsf_measurement_add_point(m);
    assert_non_null(point);
    *point = point_of(milliseconds, relmse, 0.5);
    point->samples = samples;
    return point;
}

static void test_times_to_an_error(void **state)
{
    (void)state;
    lsf_measurement m = {0};
    assert_int_equal(lsf_measurement_add_configuration(&m, "direct", NULL, 0), 0);
    add_point(&m, 4, 45.0, 0.1); /* 5 ms and 10 ms a sample, and the error as 0.4 / N */
    add_point(&m, 1, 15.0, 0.4);
    add_point(&m, 2, 25.0, 0.2);
    m.configurations[0].relmse = (lsf_error_fit){
        .points = 3, .floor = {.value = 0.01}, .noise = {.value = 0.4}, .exponent = {.value = 1.0}};
    lsf_time_to_error time = lsf_front_time_to(&m, 0, 0.4 / 3.0);
    NEAR(time.samples, 3.0, 1e-9);
    NEAR(time.milliseconds, 35.0, 1e-9);
    assert_false(time.extrapolated);
    NEAR(lsf_front_time_to(&m, 0, 7.0).milliseconds, 15.0, 1e-9);
    time = lsf_front_time_to(&m, 0, 0.03);
    NEAR(time.samples, 20.0, 1e-9);
    NEAR(time.milliseconds, 205.0, 1e-9);
    assert_true(time.extrapolated);
    assert_true(isnan(lsf_front_time_to(&m, 0, 0.009).milliseconds));
    assert_true(lsf_front_times(&m));
    assert_int_equal(m.time_count, 2); /* 0.316 and 0.1 */
    NEAR(m.times[0].relmse, pow(10.0, -0.5), 1e-9);
    lsf_measurement_finish(&m);
}

/* --- grids --- */

static void test_grid(void **state)
{
    (void)state;
    static const char *const techniques[] = {"bidirectional", "cone", "direct"};
    static const char *const sweeps[] = {"vpl.count=4,16", "interleave.size=1,2,4",
                                         "voxel.resolution=64"};
    static const char *const bad[] = {"cone.count=1,2", "sparse.blur=1,,2", "vpl.count="};
    lsf_measurement m = {0};
    lsf_error error;
    assert_true(lsf_sweep_grid_add(&m, techniques, 3, sweeps, 3, &error));
    assert_int_equal(m.configuration_count, 6 + 3 + 3);
    assert_string_equal(m.configurations[0].options[0], "vpl.count=4");
    assert_string_equal(m.configurations[1].options[1], "interleave.size=2");
    assert_string_equal(m.configurations[5].options[0], "vpl.count=16");
    assert_string_equal(m.configurations[5].options[1], "interleave.size=4");
    assert_string_equal(m.configurations[6].options[1], "voxel.resolution=64");
    assert_int_equal(m.configurations[11].option_count, 1);
    assert_true(lsf_sweep_grid_add(&m, techniques, 3, sweeps, 3, &error)); /* the same ones */
    assert_int_equal(m.configuration_count, 12);
    assert_false(lsf_sweep_grid_add(&m, techniques, 1, bad, 1, &error));
    assert_non_null(strstr(error.message, "--sweep cone.count=1,2: none of the techniques"));
    assert_false(lsf_sweep_grid_add(&m, techniques + 1, 1, bad + 1, 1, &error));
    assert_false(lsf_sweep_grid_add(&m, techniques, 1, bad + 2, 1, &error));
    lsf_measurement_finish(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_student),
        cmocka_unit_test(test_means),
        cmocka_unit_test(test_products_of_patterns),
        cmocka_unit_test(test_changes),
        cmocka_unit_test(test_fit_of_a_law),
        cmocka_unit_test(test_intervals_hold_the_truth),
        cmocka_unit_test(test_front),
        cmocka_unit_test(test_times_to_an_error),
        cmocka_unit_test(test_grid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
