#include "against_reference.h"

#include <math.h>

static void save(const lsf_image *image, const char *name, const char *kind)
{
    const char *folder = getenv("LSF_TEST_PICTURES");
    char path[4096];
    lsf_error error = {0};
    if (!folder)
        return;
    snprintf(path, sizeof path, "%s/%s.%s.png", folder, name, kind);
    if (!lsf_image_save(image, path, NULL, &error))
        fail_msg("%s", error.message);
}

static void save_all(const char *name, const against_reference *pictures)
{
    lsf_error error = {0};
    save(pictures->gl[0], name, "gl");
    save(pictures->reference[0], name, "reference");
    lsf_image *difference =
        lsf_compare_difference(pictures->gl[0], pictures->reference[0], 10.0f, &error);
    assert_non_null(difference);
    save(difference, name, "difference");
    lsf_image_destroy(difference);
}

against_reference against_reference_render(const char *name, const lsf_scene *scene,
                                           const lsf_render_params *params)
{
    against_reference pictures;
    lsf_render_params each = *params;
    lsf_error error = {0};
    each.aovs = LSF_AOV_ALBEDO | LSF_AOV_NORMAL;
    if (getenv("LSF_TEST_QUICK"))
        each.samples /= 4;
    for (uint32_t half = 0; half < 2; half++) {
        each.seed = half;
        pictures.gl[half] = render_gl(gl_test_backend(), scene, &each);
        each.seed = 0;
        pictures.reference[half] = lsf_reference_render(scene, &each, half, NULL, &error);
        if (!pictures.reference[half])
            fail_msg("%s", error.message);
    }
    save_all(name, &pictures);
    return pictures;
}

void against_reference_destroy(against_reference *pictures)
{
    for (int half = 0; half < 2; half++) {
        lsf_image_destroy(pictures->gl[half]);
        lsf_image_destroy(pictures->reference[half]);
    }
}

static double value(const lsf_image *image, int channel, uint64_t pixel)
{
    double v = (double)image->pixels[pixel * image->channel_count + (uint64_t)channel];
    assert_true(isfinite(v));
    return v;
}

/* Whether the pixel, or one beside it, is above the limit in any picture. */
static bool left_out(const against_reference *pictures, int first, uint64_t pixel, double limit)
{
    int64_t width = pictures->gl[0]->width, height = pictures->gl[0]->height;
    int64_t x0 = (int64_t)pixel % width, y0 = (int64_t)pixel / width;
    for (int64_t y = y0 > 0 ? y0 - 1 : 0; y <= y0 + 1 && y < height; y++)
        for (int64_t x = x0 > 0 ? x0 - 1 : 0; x <= x0 + 1 && x < width; x++)
            for (int half = 0; half < 2; half++)
                for (int c = first; c < first + 3; c++)
                    if (value(pictures->gl[half], c, (uint64_t)(y * width + x)) > limit ||
                        value(pictures->reference[half], c, (uint64_t)(y * width + x)) > limit)
                        return true;
    return false;
}

void against_reference_check(const char *name, const against_reference *pictures,
                             const char *channel, double limit, double bias_allowed,
                             double error_allowed)
{
    const lsf_image *const *gl = (const lsf_image *const *)pictures->gl;
    const lsf_image *const *reference = (const lsf_image *const *)pictures->reference;
    int first = lsf_image_channel(gl[0], channel);
    assert_true(first >= 0 && first == lsf_image_channel(reference[0], channel));
    uint64_t pixels = (uint64_t)gl[0]->width * gl[0]->height, counted = 0;
    double size = 0.0, bias[3] = {0}, spread[3] = {0}, squares = 0.0, fourths = 0.0, noise = 0.0;
    for (uint64_t i = 0; i < pixels; i++) {
        if (left_out(pictures, first, i, limit))
            continue;
        counted++;
        for (int c = 0; c < 3; c++) {
            double g0 = value(gl[0], first + c, i), g1 = value(gl[1], first + c, i);
            double r0 = value(reference[0], first + c, i), r1 = value(reference[1], first + c, i);
            size += fabs(r0 + r1) / 2.0;
            bias[c] += (g0 + g1 - r0 - r1) / 2.0;
            spread[c] += (g0 - g1 - r0 + r1) / 2.0;
            double product = (g0 - r0) * (g1 - r1);
            squares += product;
            fourths += product * product;
            noise += ((g0 - g1) * (g0 - g1) + (r0 - r1) * (r0 - r1)) / 4.0;
        }
    }
    assert_true(counted > 0 && size > 0.0);
    size /= 3.0 * (double)counted;
    double error = sqrt(fmax(squares, 0.0) / (3.0 * (double)counted)) / size;
    print_message("%-16s %-9s", name, channel);
    for (int c = 0; c < 3; c++)
        print_message(" %+.3f%%", 100.0 * bias[c] / (double)counted / size);
    print_message(", rmse %.3f%% and noise %.3f%% of the mean, %llu of %llu pixels\n",
                  100.0 * error, 100.0 * sqrt(noise / (3.0 * (double)counted)) / size,
                  (unsigned long long)counted, (unsigned long long)pixels);
    for (int c = 0; c < 3; c++)
        assert_true(fabs(bias[c]) <= bias_allowed * size * (double)counted + 2.0 * fabs(spread[c]));
    /* The sum of products of independent noises is off by about this much. */
    double known = error_allowed * size;
    assert_true(squares <= known * known * 3.0 * (double)counted + 3.0 * sqrt(fourths));
}
