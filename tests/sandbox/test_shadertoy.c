/* Shaders as people write them for Shadertoy, and how the mouse and keys come to them. */
#include "sandbox_rig.h"

#include <math.h>

#include "base/base.h"

static char *read_shader(const char *folder, const char *name)
{
    size_t length;
    lsf_error error;
    char *path = lsf_format("%s/%s/%s.frag", getenv("LSF_SOURCE_ROOT"), folder, name);
    char *text = lsf_file_read(path, 1 << 20, &length, &error);
    if (!text)
        fail_msg("%s", error.message);
    free(path);
    return text;
}

/* Finite, and neither black nor of one colour. */
static void assert_shows_something(const char *name, const lsf_image *image)
{
    float low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < (size_t)3 * image->width * image->height; i++) {
        if (!isfinite(image->pixels[i]))
            fail_msg("%s: a pixel is not finite", name);
        low = fminf(low, image->pixels[i]);
        high = fmaxf(high, image->pixels[i]);
    }
    if (high - low < 0.25f)
        fail_msg("%s shows %g to %g", name, (double)low, (double)high);
}

static void test_run_unchanged(void **state)
{
    static const char *const names[] = {"plasma", "spheres",  "cells", "fractal", "life",
                                        "four",   "textures", "tiles", "stars"};
    (void)state;
    for (size_t i = 0; i < LSF_COUNT(names); i++) {
        char *text = read_shader("tests/sandbox/shaders", names[i]);
        lsf_sandbox_params params = sandbox_params(text);
        params.path = names[i];
        lsf_image *image = sandbox_picture(NULL, &params, 4);
        assert_shows_something(names[i], image);
        lsf_image_destroy(image);
        free(text);
    }
}

/* Presses at (10, 40), drags to (50, 40), lets go, presses space: what is painted stays, and goes.
 */
static void test_paint(void **state)
{
    (void)state;
    char *text = read_shader("tests/sandbox/shaders", "paint");
    lsf_sandbox_params params = sandbox_params(text);
    uint8_t keys[3][LSF_SANDBOX_KEYS] = {{0}}, rgb[64 * 64 * 3];
    lsf_sandbox *sandbox = sandbox_make(NULL, &params);
    const struct {
        float mouse[4];
        bool space;
        uint8_t at_30_40; /* red there */
        uint8_t clicked;  /* green of the lowest row: iMouse.w is above 0 */
    } frames[] = {{{10, 40, 10, 40}, false, 0, 255},
                  {{50, 40, 10, -40}, false, 255, 0},
                  {{50, 40, -10, -40}, false, 255, 0},
                  {{50, 40, -10, -40}, true, 0, 0}};
    for (uint32_t i = 0; i < LSF_COUNT(frames); i++) {
        lsf_sandbox_frame frame = {LSF_SANDBOX_FRAME_DEFAULTS};
        lsf_error error;
        keys[0][32] = frames[i].space;
        frame.number = i;
        frame.keys = (const uint8_t(*)[LSF_SANDBOX_KEYS])keys;
        memcpy(frame.mouse, frames[i].mouse, sizeof frame.mouse);
        assert_true(lsf_sandbox_run(sandbox, &frame, &error));
        assert_true(lsf_sandbox_read_rgb8(sandbox, 0, LSF_TONE_CURVE_NONE, rgb, &error));
        assert_int_equal(rgb[3 * ((63 - 40) * 64 + 30)], frames[i].at_30_40);
        assert_int_equal(rgb[3 * (63 * 64 + 60) + 1], frames[i].clicked);
    }
    lsf_sandbox_destroy(sandbox);
    free(text);
}

/* Names that WebGL 1 had. */
static void test_older_names(void **state)
{
    (void)state;
    sandbox_assert_pixel(NULL,
                         "// @channel 0 previous\n"
                         "void mainImage(out vec4 c, in vec2 p) { c = texture2D(iChannel0, p) + "
                         "vec4(iGlobalTime, 0.5, 0.0, 1.0); }",
                         2, 0, 0, 1.0f / 60, 1, 0, 1e-6f);
}

/* The shaders that come with the library, with a scene where they name one. */
static void test_examples(void **state)
{
    static const struct {
        const char *name;
        bool scene;
    } examples[] = {{"cone_tracer", true}, {"depth_complexity", true}, {"islands", false},
                    {"maze", false},       {"monte_carlo", true},      {"toon", true},
                    {"voxel_ao", true}};
    static const char *const options[] = {"voxel.resolution=32", "bundle.resolution=64"};
    (void)state;
    lsf_error error;
    char *path = lsf_format("%s/data/scenes/cornell_point.gltf", getenv("LSF_SOURCE_ROOT"));
    lsf_scene *scene = lsf_scene_load(path, NULL, &error);
    if (!scene)
        fail_msg("%s", error.message);
    for (size_t i = 0; i < LSF_COUNT(examples); i++) {
        char *text = read_shader("data/sandbox", examples[i].name);
        lsf_sandbox_params params = sandbox_params(text);
        params.path = examples[i].name;
        params.render.options = options;
        params.render.option_count = LSF_COUNT(options);
        lsf_image *image = sandbox_picture(examples[i].scene ? scene : NULL, &params, 3);
        assert_shows_something(examples[i].name, image);
        lsf_image_destroy(image);
        free(text);
    }
    lsf_scene_destroy(scene);
    free(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_run_unchanged), cmocka_unit_test(test_paint),
        cmocka_unit_test(test_older_names), cmocka_unit_test(test_examples)};
    return cmocka_run_group_tests(tests, sandbox_setup, sandbox_teardown);
}
