/* Mipmaps of colours weighed by alpha, against sums by hand. Needs no GL. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "frame/alpha_mipmaps.h"
#include "math/sampling.h"

static void set(float *texel, float color, float alpha)
{
    for (int c = 0; c < 3; c++)
        texel[c] = color;
    texel[3] = alpha;
}

static void assert_texel(const float *texel, float color, float alpha)
{
    for (int c = 0; c < 3; c++)
        assert_true(fabsf(texel[c] - color) < 1e-6f);
    assert_true(fabsf(texel[3] - alpha) < 1e-6f);
}

/* The left half has 0.5 with alpha 1 twice, 1 with alpha 1/4 and a transparent 0, the right half
 * transparent 0.9. */
static void alpha_weighs(void **unused)
{
    (void)unused;
    float texels[4 * 8];
    for (int i = 0; i < 8; i++)
        set(texels + 4 * i, i % 4 == 0 ? 0.5f : i % 4 == 1 ? 0.0f : 0.9f, i % 4 == 0);
    set(texels + 4, 1.0f, 0.25f);
    float *levels = lsf_alpha_mipmaps_create(texels, 4, 2);
    float alpha = 2.25f / 4.0f, color = 1.25f / 2.25f;
    assert_texel(levels, color, alpha);
    assert_texel(levels + 4, color, 0.0f); /* what the next level holds */
    assert_texel(levels + 8, color, alpha / 2.0f);
    free(levels);
}

/* In sizes that are odd, too, no part is lost: the last level has the mean of the whole. */
static void last_level_is_the_mean(void **unused)
{
    (void)unused;
    static const struct {
        uint32_t width, height;
        size_t last; /* texels of the levels before the last */
    } sizes[] = {{7, 5, 3 * 2}, {1, 9, 4 + 2}, {16, 3, 8 + 4 + 2}, {13, 13, 36 + 9}};
    for (int i = 0; i < 4; i++) {
        uint32_t count = sizes[i].width * sizes[i].height;
        float texels[4 * 169], alpha = 0.0f, light = 0.0f;
        for (uint32_t k = 0; k < count; k++) {
            set(texels + 4 * k, lsf_random_float(1, k), lsf_random_float(2, k));
            alpha += texels[4 * k + 3] / (float)count;
            light += texels[4 * k] * texels[4 * k + 3] / (float)count;
        }
        float *levels = lsf_alpha_mipmaps_create(texels, sizes[i].width, sizes[i].height);
        assert_non_null(levels);
        assert_texel(levels + 4 * sizes[i].last, light / alpha, alpha);
        free(levels);
    }
}

static void transparent_images(void **unused)
{
    (void)unused;
    float texels[4 * 9];
    for (int i = 0; i < 9; i++)
        set(texels + 4 * i, 0.7f, 0.0f);
    float *levels = lsf_alpha_mipmaps_create(texels, 3, 3);
    assert_texel(levels, 0.0f, 0.0f);
    free(levels);
    set(texels, 0.7f, 0.5f);
    levels = lsf_alpha_mipmaps_create(texels, 1, 1); /* has no further level */
    assert_non_null(levels);
    free(levels);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(alpha_weighs),
        cmocka_unit_test(last_level_is_the_mean),
        cmocka_unit_test(transparent_images),
    };
    return cmocka_run_group_tests_name("alpha mipmaps", tests, NULL, NULL);
}
