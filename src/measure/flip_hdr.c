#include "measure/flip.h"

#include "shared/tonemap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The ACES curve as K. Narkowicz fitted it, "ACES Filmic Tone Mapping Curve", 2015, with the
 * paper's 0.6 on its input: (a x^2 + b x) / (d x^2 + e x + f). */
#define CURVE_A (0.6f * 0.6f * 2.51f)
#define CURVE_B (0.6f * 0.03f)
#define CURVE_D (0.6f * 0.6f * 2.43f)
#define CURVE_E (0.6f * 0.59f)
#define CURVE_F 0.14f
#define SHOULDER 0.85f /* where on the curve the brightest and the median are put */

static float tone_map(float x)
{
    float y = x * (CURVE_A * x + CURVE_B) / (x * (CURVE_D * x + CURVE_E) + CURVE_F);
    return fminf(y, 1.0f);
}

/* The radiance that the curve maps to `value`: the positive root of its quadratic. */
static float invert_curve(float value)
{
    float a = CURVE_A - value * CURVE_D, b = CURVE_B - value * CURVE_E, c = -value * CURVE_F;
    return (-b + sqrtf(b * b - 4.0f * a * c)) / (2.0f * a);
}

static int ascending(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

bool lsf_flip_choose_exposures(const lsf_flip_pair *radiance, const uint8_t *compared,
                               lsf_flip_exposures *exposures)
{
    size_t pixels = (size_t)radiance->width * radiance->height, all = 0, black = 0;
    float *luminances = lsf_alloc(pixels, sizeof *luminances);
    if (!luminances)
        return false;
    for (size_t i = 0; i < pixels; i++) {
        const float *rgb = radiance->reference + 3 * i;
        float luminance = 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
        if (compared[i])
            black += !((luminances[all++] = fmaxf(luminance, 0.0f)) > 0.0f);
    }
    *exposures = (lsf_flip_exposures){0};
    if (black < all) {
        qsort(luminances, all, sizeof *luminances, ascending);
        size_t middle = all / 2 < black ? black + (all - black) / 2 : all / 2;
        float white = invert_curve(SHOULDER);
        exposures->start = log2f(white / luminances[all - 1]);
        exposures->stop = log2f(white / luminances[middle]);
        exposures->count = (uint32_t)fmaxf(2.0f, ceilf(exposures->stop - exposures->start));
    }
    free(luminances);
    return true;
}

static void expose(const float *radiance, float scale, size_t count, float *shown)
{
    for (size_t i = 0; i < count; i++)
        shown[i] = tone_map(lsf_tonemap_expose(radiance[i], scale));
}

bool lsf_flip_hdr(const lsf_flip_pair *radiance, const lsf_flip_exposures *exposures, float *map)
{
    size_t pixels = (size_t)radiance->width * radiance->height;
    float *memory = lsf_alloc((uint64_t)pixels * 7, sizeof *memory);
    if (!memory)
        return false;
    float *test = memory, *reference = test + 3 * pixels, *step = reference + 3 * pixels;
    const lsf_flip_pair shown = {test, reference, radiance->width, radiance->height};
    bool good = true;
    memset(map, 0, pixels * sizeof *map);
    for (uint32_t e = 0; good && e < exposures->count; e++) {
        float at = (float)e / (float)(exposures->count - 1);
        float scale = exp2f(exposures->start + at * (exposures->stop - exposures->start));
        expose(radiance->test, scale, 3 * pixels, test);
        expose(radiance->reference, scale, 3 * pixels, reference);
        good = lsf_flip(&shown, step);
        for (size_t i = 0; good && i < pixels; i++)
            map[i] = fmaxf(map[i], step[i]);
    }
    free(memory);
    return good;
}
