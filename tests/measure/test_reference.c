/* References that are kept: rounds, files, damage, and what a key tells apart. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/base.h"
#include "sweep/reference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static lsf_error failure;

static lsf_scene *load(void)
{
    char *path = lsf_format("%s/data/scenes/cornell_point.gltf", getenv("LSF_SOURCE_ROOT"));
    lsf_scene *scene = lsf_scene_load(path, NULL, &failure);
    assert_non_null(scene);
    free(path);
    return scene;
}

static lsf_render_params small(void)
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    params.width = 12;
    params.height = 8;
    params.bounces = 1;
    return params;
}

static double mean_of(const lsf_image *image)
{
    double sum = 0.0;
    size_t count = (size_t)image->width * image->height * 3;
    for (size_t i = 0; i < count; i++)
        sum += (double)image->pixels[i] / (double)count;
    return sum;
}

/* Two rounds are the mean of both, and independent: neither repeats the other, nor half the half.
 */
static void test_rounds(void **state)
{
    (void)state;
    lsf_scene *scene = load();
    lsf_render_params params = small();
    lsf_kept_reference kept = {0}, first = {0};
    assert_true(lsf_kept_reference_trace(&first, scene, &params, 8, &failure));
    assert_true(lsf_kept_reference_trace(&kept, scene, &params, 8, &failure));
    assert_memory_equal(kept.halves[0]->pixels, first.halves[0]->pixels,
                        12 * 8 * 3 * sizeof(float));
    assert_memory_not_equal(kept.halves[0]->pixels, kept.halves[1]->pixels,
                            12 * 8 * 3 * sizeof(float));
    assert_true(lsf_kept_reference_trace(&kept, scene, &params, 24, &failure));
    assert_int_equal(kept.samples[1], 32);
    assert_int_equal(kept.rounds, 2);
    double a = mean_of(kept.halves[0]), b = mean_of(kept.halves[1]), c = mean_of(first.halves[0]);
    assert_float_equal((float)(a / b), 1.0f, 0.05f);
    assert_float_equal((float)(a / c), 1.0f, 0.1f);
    assert_true(a != c);
    lsf_kept_reference_finish(&first);
    lsf_kept_reference_finish(&kept);
    lsf_scene_destroy(scene);
}

static lsf_kept_reference make(void)
{
    static const char *const names[] = {"R", "G", "B"};
    lsf_kept_reference kept = {
        .width = 3, .height = 2, .rounds = 5, .samples = {64, 65}, .seconds = 1.5};
    for (int h = 0; h < 2; h++) {
        kept.halves[h] = lsf_image_create(3, 2, 3, names, &failure);
        assert_non_null(kept.halves[h]);
        for (int i = 0; i < 18; i++)
            kept.halves[h]->pixels[i] = (float)(i + 100 * h) / 7.0f;
    }
    return kept;
}

static void test_file(void **state)
{
    (void)state;
    char path[] = "/tmp/lightsheaf-reference-XXXXXX";
    close(mkstemp(path));
    lsf_kept_reference made = make(), loaded = {0};
    assert_true(lsf_kept_reference_save(&made, path, &failure));
    assert_true(lsf_kept_reference_load(&loaded, path, &failure));
    assert_int_equal(loaded.samples[1], 65);
    assert_int_equal(loaded.rounds, 5);
    assert_true(loaded.seconds == 1.5);
    assert_memory_equal(loaded.halves[1]->pixels, made.halves[1]->pixels, 18 * sizeof(float));

    /* Any byte that is changed, and any length, is found out; what there was stays. */
    size_t length;
    char *bytes = lsf_file_read(path, 1 << 20, &length, &failure);
    for (size_t i = 0; i < length; i++) {
        bytes[i] ^= 4;
        assert_true(lsf_file_write(path, bytes, length, &failure));
        assert_false(lsf_kept_reference_load(&loaded, path, &failure));
        assert_int_equal(failure.code, LSF_ERROR_FILE);
        bytes[i] ^= 4;
        if (i % 16 == 0) {
            assert_true(lsf_file_write(path, bytes, i, &failure));
            assert_false(lsf_kept_reference_load(&loaded, path, &failure));
        }
    }
    assert_int_equal(loaded.width, 3);
    free(bytes);
    unlink(path);
    assert_false(lsf_kept_reference_load(&loaded, path, &failure));
    lsf_kept_reference_finish(&made);
    lsf_kept_reference_finish(&loaded);
}

/* Whatever changes the picture changes the key; what does not leaves it. */
static void test_key(void **state)
{
    (void)state;
    enum { VARIATIONS = 20 };
    static const float position[] = {1, 2, 3}, radiance[] = {0.1f, 0.2f, 0.3f};
    static const char *const animations[] = {"walk"};
    char keys[VARIATIONS][33];
    uint32_t count = 0;
    const char *hash = "0123456789abcdef0123456789abcdef";
    lsf_scene_params scene = {LSF_SCENE_PARAMS_DEFAULTS};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
#define TAKE() assert_true(lsf_reference_key(hash, &scene, &params, params.bounces, keys[count++]))
#define VARY(place, value)                                                                         \
    do {                                                                                           \
        typeof(place) before = place;                                                              \
        place = value;                                                                             \
        TAKE();                                                                                    \
        place = before;                                                                            \
    } while (0)
    params.bounces = 3;
    TAKE();
    VARY(hash, "0123456789abcdef0123456789abcdee");
    VARY(params.width, 1025);
    VARY(params.height, 769);
    VARY(params.bounces, 4);
    VARY(params.camera, "1");
    VARY(params.camera_position, position);
    VARY(params.camera_target, position);
    VARY(params.fov_y, 50.0f);
    VARY(params.time, 1.0);
    VARY(params.background, LSF_BACKGROUND_TRANSPARENT);
    VARY(params.background_radiance[1], 1.0f);
    VARY(scene.environment_radiance, radiance);
    VARY(scene.environment_rotation, 90.0f);
    VARY(scene.environment_strength, 2.0f);
    VARY(scene.default_light, LSF_DEFAULT_LIGHT_NEVER);
    VARY(scene.diffuse_only, true);
    VARY(scene.scene, "1");
    VARY(scene.variant, "1");
    scene.animation_count = 1;
    VARY(scene.animations, animations);
    scene.animation_count = 0;
    assert_int_equal(count, VARIATIONS);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = 0; j < i; j++)
            assert_string_not_equal(keys[i], keys[j]);

    char again[33];
    params.seed = 7;
    params.samples = 9;
    params.technique = "cone";
    params.raw = true;
    assert_true(lsf_reference_key(hash, &scene, &params, params.bounces, again));
    assert_string_equal(again, keys[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rounds),
        cmocka_unit_test(test_file),
        cmocka_unit_test(test_key),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
