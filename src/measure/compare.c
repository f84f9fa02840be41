#include <lightsheaf/compare.h>

#include "base/base.h"
#include "measure/flip.h"
#include "measure/ssim.h"
#include "shared/tonemap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct rgb_view {
    const lsf_image *image;
    int channels[3];
} rgb_view;

typedef struct comparison {
    rgb_view test, a, b; /* b.image is NULL without a second half */
    const lsf_image *mask;
    uint8_t *compared; /* for each pixel: neither masked nor non-finite */
    uint64_t width, height;
} comparison;

static bool open_view(rgb_view *view, const lsf_image *image, const lsf_image *like,
                      const char *title, lsf_error *error)
{
    static const char *const names[] = {"R", "G", "B"};
    view->image = image;
    for (int c = 0; c < 3; c++) {
        view->channels[c] = lsf_image_channel(image, names[c]);
        if (view->channels[c] < 0)
            return lsf_error_set(error, LSF_ERROR_FILE,
                                 "the %s image has no channel %s; compare images with R, G and B",
                                 title, names[c]);
    }
    return (image->width == like->width && image->height == like->height) ||
           lsf_error_set(error, LSF_ERROR_FILE,
                         "the test image has %u x %u pixels and the %s image %u x %u; render or "
                         "crop them to the same size",
                         like->width, like->height, title, image->width, image->height);
}

static void fetch(const rgb_view *view, uint64_t pixel, double rgb[3])
{
    const float *values = view->image->pixels + pixel * view->image->channel_count;
    for (int c = 0; c < 3; c++)
        rgb[c] = values[view->channels[c]];
}

static bool is_finite(const rgb_view *view, uint64_t pixel)
{
    double rgb[3];
    fetch(view, pixel, rgb);
    return isfinite(rgb[0]) && isfinite(rgb[1]) && isfinite(rgb[2]);
}

/* The mean of the halves, or the only reference. */
static void fetch_reference(const comparison *c, uint64_t pixel, double rgb[3])
{
    double b[3];
    fetch(&c->a, pixel, rgb);
    if (!c->b.image)
        return;
    fetch(&c->b, pixel, b);
    for (int i = 0; i < 3; i++)
        rgb[i] = 0.5 * (rgb[i] + b[i]);
}

/* Marks what is compared, and counts it. */
static void select_pixels(const comparison *c, lsf_compare_result *result)
{
    for (uint64_t i = 0; i < c->width * c->height; i++) {
        if (c->mask && c->mask->pixels[i * c->mask->channel_count] > 0.5f)
            continue;
        bool test = is_finite(&c->test, i);
        bool reference = is_finite(&c->a, i) && (!c->b.image || is_finite(&c->b, i));
        result->non_finite_test += !test;
        result->non_finite_reference += !reference;
        c->compared[i] = test && reference;
        result->pixels += c->compared[i];
    }
}

/* All sums run over rows first, so that a row's digits are not lost in the picture's. */
static void measure_means(const comparison *c, lsf_compare_result *result)
{
    for (uint64_t y = 0; y < c->height; y++) {
        double row_test[3] = {0}, row_reference[3] = {0};
        for (uint64_t i = y * c->width; i < (y + 1) * c->width; i++) {
            double x[3], r[3];
            if (!c->compared[i])
                continue;
            fetch(&c->test, i, x);
            fetch_reference(c, i, r);
            for (int k = 0; k < 3; k++) {
                row_test[k] += x[k];
                row_reference[k] += r[k];
            }
        }
        for (int k = 0; k < 3; k++) {
            result->mean_test[k] += row_test[k];
            result->mean_reference[k] += row_reference[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        result->mean_test[k] /= (double)result->pixels;
        result->mean_reference[k] /= (double)result->pixels;
    }
}

/* value / scale, where equal zeros are no error and a zero scale makes any error infinite. */
static double relative(double value, double scale)
{
    return value == 0.0 ? 0.0 : value / scale;
}

static void measure_squares(const comparison *c, lsf_compare_result *result)
{
    double squares = 0.0, relative_squares = 0.0;
    for (uint64_t y = 0; y < c->height; y++) {
        double row = 0.0, relative_row = 0.0;
        for (uint64_t i = y * c->width; i < (y + 1) * c->width; i++) {
            double x[3], a[3], b[3], r[3];
            if (!c->compared[i])
                continue;
            fetch(&c->test, i, x);
            fetch(&c->a, i, a);
            fetch(c->b.image ? &c->b : &c->a, i, b);
            fetch_reference(c, i, r);
            for (int k = 0; k < 3; k++) {
                double square = (x[k] - a[k]) * (x[k] - b[k]);
                row += square;
                relative_row += relative(square, r[k] * r[k] + result->relmse_epsilon);
            }
        }
        squares += row;
        relative_squares += relative_row;
    }
    double values = 3.0 * (double)result->pixels;
    /* Noise-corrected squares of a good image may sum to less than nothing. */
    result->rmse = sqrt(fmax(squares / values, 0.0));
    result->relmse = relative_squares / values;
}

/* Display code values in 0..1. */
static void display(const double rgb[3], const lsf_compare_params *params, float shown[3])
{
    float exposed[3];
    for (int k = 0; k < 3; k++)
        exposed[k] = lsf_tonemap_expose((float)rgb[k], exp2f(params->exposure));
    for (int k = 0; k < 3; k++)
        shown[k] = lsf_tonemap_code((int)params->curve, k, exposed[0], exposed[1], exposed[2]);
}

static float luminance(const float rgb[3])
{
    return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
}

static bool measure_display(const comparison *c, const lsf_compare_params *params,
                            lsf_compare_result *result)
{
    uint64_t count = c->width * c->height;
    float *x = lsf_alloc(count, sizeof *x), *y = lsf_alloc(count, sizeof *y);
    double squares = 0.0;
    for (uint64_t i = 0; x && y && i < count; i++) {
        double test[3], reference[3];
        float shown_test[3], shown_reference[3];
        if (!c->compared[i])
            continue;
        fetch(&c->test, i, test);
        fetch_reference(c, i, reference);
        display(test, params, shown_test);
        display(reference, params, shown_reference);
        for (int k = 0; k < 3; k++) {
            double difference = (double)shown_test[k] - shown_reference[k];
            squares += difference * difference;
        }
        x[i] = luminance(shown_test);
        y[i] = luminance(shown_reference);
    }
    bool done = x && y;
    if (done) {
        result->psnr = -10.0 * log10(squares / (3.0 * (double)result->pixels));
        result->ssim = lsf_ssim(x, y, c->compared, (uint32_t)c->width, (uint32_t)c->height);
    }
    free(x);
    free(y);
    return done;
}

/* Both pictures, three values a pixel; what is not compared looks alike in them. */
static void fetch_pair(const comparison *c, float *test, float *reference)
{
    for (uint64_t i = 0; i < c->width * c->height; i++) {
        double x[3] = {0}, r[3] = {0};
        if (c->compared[i]) {
            fetch(&c->test, i, x);
            fetch_reference(c, i, r);
        }
        for (int k = 0; k < 3; k++) {
            test[3 * i + (uint64_t)k] = (float)x[k];
            reference[3 * i + (uint64_t)k] = (float)r[k];
        }
    }
}

/* Radiance to what a display emits, 0..1. */
static void show(const lsf_compare_params *params, float *values, uint64_t pixels)
{
    for (uint64_t i = 0; i < pixels; i++) {
        float *pixel = values + 3 * i, code[3];
        display((double[]){(double)pixel[0], (double)pixel[1], (double)pixel[2]}, params, code);
        for (int k = 0; k < 3; k++)
            pixel[k] = lsf_srgb_decode(code[k]);
    }
}

static double mean_compared(const comparison *c, const float *map)
{
    double sum = 0.0, count = 0.0;
    for (uint64_t y = 0; y < c->height; y++) {
        double row = 0.0;
        for (uint64_t i = y * c->width; i < (y + 1) * c->width; i++) {
            row += c->compared[i] ? (double)map[i] : 0.0;
            count += c->compared[i];
        }
        sum += row;
    }
    return sum / count;
}

static bool measure_flip(const comparison *c, const lsf_compare_params *params,
                         lsf_compare_result *result)
{
    const uint64_t pixels = c->width * c->height;
    float *test = lsf_alloc(pixels * 7, sizeof *test);
    if (!test)
        return false;
    float *reference = test + 3 * pixels, *map = reference + 3 * pixels;
    lsf_flip_pair pair = {test, reference, (uint32_t)c->width, (uint32_t)c->height};
    lsf_flip_exposures exposures;
    fetch_pair(c, test, reference);
    bool done = lsf_flip_choose_exposures(&pair, c->compared, &exposures) &&
                lsf_flip_hdr(&pair, &exposures, map);
    if (done) {
        result->flip_hdr = exposures.count ? mean_compared(c, map) : (double)NAN;
        result->flip_start = exposures.start;
        result->flip_stop = exposures.stop;
        result->flip_exposures = exposures.count;
        show(params, test, pixels);
        show(params, reference, pixels);
        done = lsf_flip(&pair, map);
    }
    if (done)
        result->flip = mean_compared(c, map);
    free(test);
    return done;
}

static bool open_comparison(comparison *c, const lsf_image *test, const lsf_image *reference,
                            const lsf_compare_params *params, lsf_error *error)
{
    *c = (comparison){.mask = params->mask, .width = test->width, .height = test->height};
    if (!open_view(&c->test, test, test, "test", error) ||
        !open_view(&c->a, reference, test, "reference", error) ||
        (params->reference_b &&
         !open_view(&c->b, params->reference_b, test, "second reference", error)))
        return false;
    if (c->mask && (c->mask->channel_count == 0 || c->mask->width != test->width ||
                    c->mask->height != test->height))
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "the mask has %u x %u pixels and the test image %u x %u; make them "
                             "the same size",
                             c->mask->width, c->mask->height, test->width, test->height);
    c->compared = lsf_alloc(c->width * c->height, 1);
    return c->compared ||
           lsf_error_set(error, LSF_ERROR_RENDER, "not enough memory to compare images");
}

static bool measure(const comparison *c, const lsf_compare_params *params,
                    lsf_compare_result *result, lsf_error *error)
{
    measure_means(c, result);
    double mean = 0.0;
    for (int k = 0; k < 3; k++) {
        double difference = result->mean_test[k] - result->mean_reference[k];
        result->bias[k] = relative(difference, result->mean_reference[k]);
        mean += result->mean_reference[k] / 3.0;
    }
    result->relmse_epsilon =
        isnan(params->relmse_epsilon) ? 0.01 * mean * mean : (double)params->relmse_epsilon;
    measure_squares(c, result);
    result->rmse_relative = relative(result->rmse, mean);
    return (measure_display(c, params, result) &&
            (!params->flip || measure_flip(c, params, result))) ||
           lsf_error_set(error, LSF_ERROR_RENDER, "not enough memory to compare images");
}

bool lsf_compare(const lsf_image *test, const lsf_image *reference,
                 const lsf_compare_params *params, lsf_compare_result *result, lsf_error *error)
{
    if (!lsf_given(test, "test", error) || !lsf_given(reference, "reference", error) ||
        !lsf_given(result, "result", error))
        return false;
    static const lsf_compare_params defaults = {LSF_COMPARE_PARAMS_DEFAULTS};
    if (!params)
        params = &defaults;
    comparison c;
    if (!open_comparison(&c, test, reference, params, error))
        return false;

    *result = (lsf_compare_result){
        .noise_corrected = params->reference_b != NULL, .flip = NAN, .flip_hdr = NAN};
    select_pixels(&c, result);
    bool done = true;
    if (result->pixels > 0)
        done = measure(&c, params, result, error);
    else if (result->non_finite_test + result->non_finite_reference == 0)
        done = lsf_error_set(error, LSF_ERROR_FILE,
                             "nothing to compare: the mask leaves out every pixel");
    else /* The counts are the answer. */
        result->rmse = result->rmse_relative = result->relmse = result->ssim = result->psnr = NAN;
    free(c.compared);
    return done;
}

lsf_image *lsf_compare_difference(const lsf_image *test, const lsf_image *reference, float gain,
                                  lsf_error *error)
{
    if (!lsf_given(test, "test", error) || !lsf_given(reference, "reference", error))
        return NULL;
    static const char *const names[] = {"R", "G", "B"};
    rgb_view x, r;
    if (!open_view(&x, test, test, "test", error) ||
        !open_view(&r, reference, test, "reference", error))
        return NULL;
    lsf_image *difference = lsf_image_create(test->width, test->height, 3, names, error);
    if (!difference)
        return NULL;
    for (uint64_t i = 0; i < (uint64_t)test->width * test->height; i++) {
        double a[3], b[3];
        fetch(&x, i, a);
        fetch(&r, i, b);
        for (int k = 0; k < 3; k++)
            difference->pixels[3 * i + (uint64_t)k] = (float)(fabs(a[k] - b[k]) * gain);
    }
    return difference;
}
