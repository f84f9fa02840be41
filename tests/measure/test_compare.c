/* Error measures against closed forms, known noise, and an SSIM worked out the slow way. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <lightsheaf/compare.h>

#include "shared/tonemap.h"

#include <math.h>
#include <string.h>

static lsf_image *make_constant(uint32_t width, uint32_t height, float r, float g, float b)
{
    static const char *const names[] = {"R", "G", "B"};
    lsf_image *image = lsf_image_create(width, height, 3, names, NULL);
    assert_non_null(image);
    for (uint64_t i = 0; i < (uint64_t)width * height; i++)
        memcpy(image->pixels + 3 * i, (float[]){r, g, b}, 3 * sizeof(float));
    return image;
}

static lsf_compare_result compare(const lsf_image *test, const lsf_image *reference,
                                  const lsf_compare_params *params)
{
    lsf_compare_result result;
    lsf_error error = {0};
    if (!lsf_compare(test, reference, params, &result, &error))
        fail_msg("%s", error.message);
    return result;
}

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.12g is not %.12g", value, expected);
}

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

static double gaussian(uint64_t *state)
{
    double radius = sqrt(-2.0 * log(1.0 - uniform(state)));
    return radius * cos(6.283185307179586 * uniform(state));
}

static void test_equal_images(void **state)
{
    (void)state;
    lsf_image *image = make_constant(20, 15, 0.2f, 0.4f, 0.1f);
    uint64_t random = 5;
    for (int i = 0; i < 900; i++)
        image->pixels[i] = (float)uniform(&random);
    lsf_compare_result r = compare(image, image, NULL);
    assert_int_equal(r.pixels, 300);
    assert_true(r.rmse == 0 && r.relmse == 0 && r.rmse_relative == 0);
    assert_true(r.bias[0] == 0 && r.bias[1] == 0 && r.bias[2] == 0);
    assert_near(r.ssim, 1.0, 1e-12);
    assert_true(isinf(r.psnr) && r.psnr > 0);
    assert_false(r.noise_corrected);
    lsf_image_destroy(image);
}

static void test_constant_offset(void **state)
{
    (void)state;
    lsf_image *x = make_constant(17, 13, 0.5f, 0.25f, 0.125f);
    lsf_image *r = make_constant(17, 13, 0.25f, 0.5f, 0.125f);
    lsf_compare_result result = compare(x, r, NULL);
    double mean = (0.25 + 0.5 + 0.125) / 3;
    assert_near(result.mean_test[0], 0.5, 1e-15);
    assert_near(result.mean_reference[1], 0.5, 1e-15);
    assert_near(result.bias[0], 1.0, 1e-14);
    assert_near(result.bias[1], -0.5, 1e-14);
    assert_near(result.bias[2], 0.0, 1e-14);
    assert_near(result.rmse, sqrt(2 * 0.0625 / 3), 1e-14);
    assert_near(result.rmse_relative, result.rmse / mean, 1e-14);
    double epsilon = 0.01 * mean * mean;
    assert_near(result.relmse_epsilon, epsilon, 1e-15);
    assert_near(result.relmse, (0.0625 / (0.0625 + epsilon) + 0.0625 / (0.25 + epsilon)) / 3,
                1e-13);

    lsf_compare_params params = {LSF_COMPARE_PARAMS_DEFAULTS};
    params.relmse_epsilon = 0.01f;
    result = compare(x, r, &params);
    assert_near(result.relmse, (0.0625 / 0.0725 + 0.0625 / 0.26) / 3, 1e-7);
    lsf_image_destroy(x);
    lsf_image_destroy(r);
}

static void test_black_reference(void **state)
{
    (void)state;
    lsf_image *black = make_constant(4, 4, 0, 0, 0), *grey = make_constant(4, 4, 1, 1, 1);
    lsf_compare_result result = compare(black, black, NULL);
    assert_true(result.relmse == 0 && result.rmse_relative == 0 && result.bias[0] == 0);
    result = compare(grey, black, NULL);
    assert_true(isinf(result.relmse) && isinf(result.bias[0]));
    assert_near(result.rmse, 1.0, 0.0);
    lsf_image_destroy(black);
    lsf_image_destroy(grey);
}

static void test_channels_are_found_by_name(void **state)
{
    (void)state;
    static const char *const names[] = {"albedo.R", "B", "depth.Z", "G", "R"};
    lsf_image *x = lsf_image_create(12, 12, 5, names, NULL);
    lsf_image *r = make_constant(12, 12, 3, 2, 1);
    assert_non_null(x);
    for (int i = 0; i < 144; i++)
        memcpy(x->pixels + 5 * i, (float[]){NAN, 1, NAN, 2, 3}, 5 * sizeof(float));
    lsf_compare_result result = compare(x, r, NULL);
    assert_int_equal(result.non_finite_test, 0);
    assert_true(result.rmse == 0);
    lsf_image_destroy(x);
    lsf_image_destroy(r);
}

/* OpenImageIO's idiff passes a picture of NaNs; here each is counted. */
static void test_non_finite_pixels_are_counted(void **state)
{
    (void)state;
    lsf_image *x = make_constant(20, 20, 1, 1, 1), *r = make_constant(20, 20, 1, 1, 1);
    lsf_image *mask = make_constant(20, 20, 0, 0, 0);
    x->pixels[0] = NAN;
    x->pixels[1] = NAN; /* the same pixel */
    x->pixels[31] = INFINITY;
    x->pixels[3 * 250] = -INFINITY;
    r->pixels[3 * 399 + 2] = NAN;
    lsf_compare_result result = compare(x, r, NULL);
    assert_int_equal(result.non_finite_test, 3);
    assert_int_equal(result.non_finite_reference, 1);
    assert_int_equal(result.pixels, 396);
    assert_true(result.rmse == 0);
    assert_near(result.ssim, 1.0, 1e-12);

    mask->pixels[0] = 1;
    lsf_compare_params params = {LSF_COMPARE_PARAMS_DEFAULTS};
    params.mask = mask;
    result = compare(x, r, &params);
    assert_int_equal(result.non_finite_test, 2);
    assert_int_equal(result.pixels, 396);

    for (int i = 0; i < 1200; i++)
        x->pixels[i] = NAN;
    result = compare(x, r, NULL);
    assert_int_equal(result.non_finite_test, 400);
    assert_int_equal(result.pixels, 0);
    assert_true(isnan(result.rmse) && isnan(result.ssim) && isnan(result.psnr));
    lsf_image_destroy(x);
    lsf_image_destroy(r);
    lsf_image_destroy(mask);
}

static void test_mask_leaves_out(void **state)
{
    (void)state;
    lsf_image *x = make_constant(30, 30, 1, 1, 1), *r = make_constant(30, 30, 1, 1, 1);
    lsf_image *mask = make_constant(30, 30, 0, 0, 0);
    for (int i = 0; i < 30 * 10; i++) {
        x->pixels[3 * i] = 50;
        mask->pixels[3 * i] = 1;
    }
    lsf_compare_params params = {LSF_COMPARE_PARAMS_DEFAULTS};
    params.mask = mask;
    lsf_compare_result result = compare(x, r, &params);
    assert_int_equal(result.pixels, 600);
    assert_true(result.rmse == 0);
    assert_near(result.ssim, 1.0, 1e-12);

    for (int i = 0; i < 2700; i++)
        mask->pixels[i] = 1;
    lsf_error error = {0};
    assert_false(lsf_compare(x, r, &params, &result, &error));
    assert_int_equal(error.code, LSF_ERROR_FILE);
    lsf_image_destroy(x);
    lsf_image_destroy(r);
    lsf_image_destroy(mask);
}

static void test_images_that_do_not_match(void **state)
{
    (void)state;
    static const char *const names[] = {"Y"};
    lsf_image *a = make_constant(4, 4, 1, 1, 1), *b = make_constant(4, 5, 1, 1, 1);
    lsf_image *grey = lsf_image_create(4, 4, 1, names, NULL);
    lsf_compare_result result;
    lsf_error error = {0};
    assert_false(lsf_compare(a, b, NULL, &result, &error));
    assert_int_equal(error.code, LSF_ERROR_FILE);
    assert_non_null(strstr(error.message, "4 x 5"));
    assert_false(lsf_compare(a, grey, NULL, &result, &error));
    assert_non_null(strstr(error.message, "no channel R"));
    assert_null(lsf_compare_difference(a, b, 1, &error));
    lsf_image_destroy(a);
    lsf_image_destroy(b);
    lsf_image_destroy(grey);
}

/* A picture off by 0.01, and references with noise of 0.1: the noise alone would hide the error. */
static void test_reference_noise_is_removed(void **state)
{
    (void)state;
    enum { SIZE = 256 };
    lsf_image *x = make_constant(SIZE, SIZE, 0.51f, 0.51f, 0.51f);
    lsf_image *a = make_constant(SIZE, SIZE, 0, 0, 0), *b = make_constant(SIZE, SIZE, 0, 0, 0);
    uint64_t random = 42;
    for (int i = 0; i < 3 * SIZE * SIZE; i++) {
        a->pixels[i] = (float)(0.5 + 0.1 * gaussian(&random));
        b->pixels[i] = (float)(0.5 + 0.1 * gaussian(&random));
    }
    lsf_compare_params params = {LSF_COMPARE_PARAMS_DEFAULTS};
    assert_near(compare(x, a, &params).rmse, sqrt(0.01 * 0.01 + 0.1 * 0.1), 1e-3);
    params.reference_b = b;
    lsf_compare_result result = compare(x, a, &params);
    assert_true(result.noise_corrected);
    /* mean((x - a)(x - b)) spreads by 0.1^2 / sqrt(3 * 256^2) = 2.3e-5 about 1e-4. */
    assert_near(result.rmse * result.rmse, 1e-4, 4 * 2.3e-5);

    /* relMSE divides by the halves' mean, whose noise is that of the numerator: with noise of 4 %
     * of the pixel it is a fifth off here, where the plain one is five times too large. */
    for (int i = 0; i < 3 * SIZE * SIZE; i++) {
        a->pixels[i] = 0.5f + 0.2f * (a->pixels[i] - 0.5f);
        b->pixels[i] = 0.5f + 0.2f * (b->pixels[i] - 0.5f);
    }
    result = compare(x, a, &params);
    assert_near(result.relmse, 1e-4 / (0.25 * 1.01), 1e-4);
    params.reference_b = NULL;
    assert_near(compare(x, a, &params).relmse, 5e-4 / (0.25 * 1.01), 2e-4);
    params.reference_b = b;

    /* Against the same truth the estimate may fall below zero; the root is guarded. */
    for (int i = 0; i < 3 * SIZE * SIZE; i++)
        x->pixels[i] = 0.5f * (a->pixels[i] + b->pixels[i]);
    result = compare(x, a, &params);
    assert_true(result.rmse == 0 && result.relmse < 0);
    lsf_image_destroy(x);
    lsf_image_destroy(a);
    lsf_image_destroy(b);
}

static void show(const float *pixel, double shown[3])
{
    float e[3];
    for (int c = 0; c < 3; c++)
        e[c] = lsf_tonemap_expose(pixel[c], 2.0f);
    for (int c = 0; c < 3; c++)
        shown[c] = lsf_tonemap_display(e[c], fminf(e[0], fminf(e[1], e[2])),
                                       fmaxf(e[0], fmaxf(e[1], e[2])));
}

static double luminance(const float *pixel)
{
    double shown[3];
    show(pixel, shown);
    return 0.2126 * shown[0] + 0.7152 * shown[1] + 0.0722 * shown[2];
}

/* Window by window, deviations from the window's mean, as the paper's equations are written. */
static double slow_ssim(const lsf_image *x, const lsf_image *y)
{
    double sum = 0.0;
    int count = 0;
    for (int cy = 5; cy + 5 < (int)x->height; cy++)
        for (int cx = 5; cx + 5 < (int)x->width; cx++) {
            double weights = 0, mx = 0, my = 0, vx = 0, vy = 0, cov = 0;
            for (int pass = 0; pass < 2; pass++)
                for (int j = -5; j <= 5; j++)
                    for (int i = -5; i <= 5; i++) {
                        uint32_t at = (uint32_t)(cy + j) * x->width + (uint32_t)(cx + i);
                        double w = exp(-(i * i + j * j) / 4.5);
                        double a = luminance(x->pixels + 3 * at);
                        double b = luminance(y->pixels + 3 * at);
                        if (pass == 0) {
                            weights += w;
                            mx += w * a;
                            my += w * b;
                        } else {
                            double da = a - mx / weights, db = b - my / weights;
                            vx += w * da * da;
                            vy += w * db * db;
                            cov += w * da * db;
                        }
                    }
            mx /= weights, my /= weights, vx /= weights, vy /= weights, cov /= weights;
            sum += (2 * mx * my + 1e-4) * (2 * cov + 9e-4) /
                   ((mx * mx + my * my + 1e-4) * (vx + vy + 9e-4));
            count++;
        }
    return sum / count;
}

static void test_ssim_and_psnr_the_slow_way(void **state)
{
    (void)state;
    lsf_image *x = make_constant(27, 19, 0, 0, 0), *y = make_constant(27, 19, 0, 0, 0);
    uint64_t random = 9;
    double squares = 0.0;
    for (int i = 0; i < 27 * 19; i++) {
        for (int c = 0; c < 3; c++) {
            double base = 0.3 + 0.25 * sin(0.7 * (i % 27) + c) * cos(0.5 * (i / 27));
            y->pixels[3 * i + c] = (float)base;
            x->pixels[3 * i + c] = (float)(base + 0.1 * gaussian(&random));
        }
        double a[3], b[3];
        show(x->pixels + 3 * i, a);
        show(y->pixels + 3 * i, b);
        for (int c = 0; c < 3; c++)
            squares += (a[c] - b[c]) * (a[c] - b[c]);
    }
    lsf_compare_params params = {LSF_COMPARE_PARAMS_DEFAULTS};
    params.exposure = 1.0f;
    lsf_compare_result result = compare(x, y, &params);
    assert_true(result.ssim > 0.3 && result.ssim < 0.95);
    assert_near(result.ssim, slow_ssim(x, y), 1e-6);
    assert_near(result.psnr, -10 * log10(squares / (3 * 27 * 19)), 1e-6);
    lsf_image_destroy(x);
    lsf_image_destroy(y);
}

static void test_small_pictures(void **state)
{
    (void)state;
    static const uint32_t sizes[][2] = {{1, 1}, {7, 13}, {300, 1}, {1, 300}, {10, 11}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        lsf_image *x = make_constant(sizes[i][0], sizes[i][1], 0.5f, 0.5f, 0.5f);
        lsf_image *y = make_constant(sizes[i][0], sizes[i][1], 0.1f, 0.1f, 0.1f);
        assert_near(compare(x, x, NULL).ssim, 1.0, 1e-12);
        double ssim = compare(x, y, NULL).ssim;
        assert_true(ssim > 0 && ssim < 0.9);
        lsf_image_destroy(x);
        lsf_image_destroy(y);
    }
}

static void test_difference_picture(void **state)
{
    (void)state;
    lsf_image *x = make_constant(3, 2, 0.5f, 0.25f, 1), *y = make_constant(3, 2, 0.75f, 0.25f, 0);
    lsf_image *difference = lsf_compare_difference(x, y, 4, NULL);
    assert_non_null(difference);
    assert_true(difference->pixels[15] == 1 && difference->pixels[16] == 0 &&
                difference->pixels[17] == 4);
    lsf_image_destroy(difference);
    lsf_image_destroy(x);
    lsf_image_destroy(y);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equal_images),
        cmocka_unit_test(test_constant_offset),
        cmocka_unit_test(test_black_reference),
        cmocka_unit_test(test_channels_are_found_by_name),
        cmocka_unit_test(test_non_finite_pixels_are_counted),
        cmocka_unit_test(test_mask_leaves_out),
        cmocka_unit_test(test_images_that_do_not_match),
        cmocka_unit_test(test_reference_noise_is_removed),
        cmocka_unit_test(test_ssim_and_psnr_the_slow_way),
        cmocka_unit_test(test_small_pictures),
        cmocka_unit_test(test_difference_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
