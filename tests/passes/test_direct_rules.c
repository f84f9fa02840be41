/* What holds of direct light without a reference: sums, shifts, filters, the tone curve. */
#include <math.h>

#include "render_gl.h"
#include "shared/tonemap.h"

/* --- lights add up ------------------------------------------------------------------------------
 */

static lsf_scene *two_lights(float first, float second)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.8f, 0.6f, 0.4f);
    build_floor(scene, 0.0f, 4.0f);
    build_material(scene, 0.3f, 0.6f, 0.9f)->roughness = 0.3f;
    build_box(scene, lsf_f3(-0.5f, 0, -0.5f), lsf_f3(0.5f, 1, 0.5f), false);
    /* A light of no intensity keeps its place, and the other one its random numbers. */
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(-2, 3, 2), lsf_f3(0, -1, 0), first);
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(-0.4f, -0.8f, -0.3f), second);
    finish_gl_scene(scene);
    return scene;
}

static lsf_image *render_view(const lsf_scene *scene, const lsf_render_params *base)
{
    static const float position[3] = {1, 3, 5}, target[3] = {0, 0.3f, 0};
    lsf_render_params params = *base;
    params.camera_position = position;
    params.camera_target = target;
    return render_gl(gl_test_backend(), scene, &params);
}

static void lights_add_up(void **unused)
{
    (void)unused;
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "direct";
    params.width = 48;
    params.height = 32;
    params.samples = 8;
    const float intensities[3][2] = {{20.0f, 0.0f}, {0.0f, 1.0f}, {20.0f, 1.0f}};
    lsf_image *images[3];
    for (int i = 0; i < 3; i++) {
        lsf_scene *scene = two_lights(intensities[i][0], intensities[i][1]);
        images[i] = render_view(scene, &params);
        destroy_scene(scene);
    }
    for (uint32_t i = 0; i < 48 * 32 * images[0]->channel_count; i++) {
        double sum = (double)images[0]->pixels[i] + (double)images[1]->pixels[i];
        assert_true(fabs(sum - (double)images[2]->pixels[i]) <= 1e-6 * sum);
    }
    for (int i = 0; i < 3; i++)
        lsf_image_destroy(images[i]);
}

/* --- far from the origin ------------------------------------------------------------------------
 */

/* Everything 1e7 away, by the transforms of the nodes and of the camera. */
static lsf_image *render_moved(double x, double y, double z)
{
    lsf_scene *scene = two_lights(20.0f, 1.0f);
    const double by[3] = {x, y, z};
    for (uint32_t i = 0; i < scene->node_count; i++)
        for (int axis = 0; axis < 3; axis++) {
            scene->nodes[i].translation[axis] += by[axis];
            scene->nodes[i].matrix[12 + axis] += by[axis];
        }
    /* At (1, 3, 5), looking 0.5 downwards. */
    const double c = cos(0.5), s = sin(0.5);
    const double camera[16] = {1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0, 1 + x, 3 + y, 5 + z, 1};
    memcpy(scene->cameras[0].matrix, camera, sizeof camera);
    finish_gl_scene(scene);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "direct";
    params.width = 96;
    params.height = 64;
    params.samples = 16;
    lsf_image *image = render_gl(gl_test_backend(), scene, &params);
    destroy_scene(scene);
    return image;
}

static void far_from_the_origin(void **unused)
{
    (void)unused;
    lsf_image *here = render_moved(0, 0, 0), *there = render_moved(1e7, -1e7, 1e7);
    double largest = 0.0, difference = 0.0;
    for (uint32_t i = 0; i < 96 * 64 * 3; i++) {
        largest = fmax(largest, (double)here->pixels[i]);
        difference = fmax(difference, fabs((double)here->pixels[i] - (double)there->pixels[i]));
    }
    print_message("moved by 1e7: largest difference %g of %g\n", difference, largest);
    assert_true(largest > 0.0 && difference <= 1e-3 * largest);
    lsf_image_destroy(here);
    lsf_image_destroy(there);
}

/* --- the percentage-closer filter ---------------------------------------------------------------
 */

enum { SIDE = 64 };

/* A floor seen from above; the box, out of view on the left, throws its shadow into it. */
static lsf_image *render_shadow(lsf_light_type type, bool box, const char *filter)
{
    static const float position[3] = {0, 4, 0.01f}, target[3] = {0, 0, 0};
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.8f, 0.8f, 0.8f);
    build_floor(scene, 0.0f, 4.0f);
    if (box)
        build_box(scene, lsf_f3(-3.4f, 0.3f, -0.8f), lsf_f3(-2.4f, 1.2f, 0.8f), false);
    else
        build_box(scene, lsf_f3(-3.4f, -3, -0.8f), lsf_f3(-2.4f, -2, 0.8f), false);
    lsf_light *light = build_light(scene, type, lsf_f3(-6, 4, 0), lsf_f3(0.8f, -0.5f, 0), 30.0f);
    light->outer_cone = 0.9f;
    finish_gl_scene(scene);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "direct";
    params.width = params.height = SIDE;
    params.samples = 1;
    params.camera_position = position;
    params.camera_target = target;
    params.options = &filter;
    params.option_count = 1;
    lsf_image *image = render_gl(gl_test_backend(), scene, &params);
    destroy_scene(scene);
    return image;
}

static float red(const lsf_image *image, int x, int y)
{
    return image->pixels[3 * (y * SIDE + x)];
}

/* Whether the unfiltered picture is all lit, or all in shadow, within reach of the filter. */
static bool far_from_borders(const lsf_image *image, int x0, int y0)
{
    enum { REACH = 6 };
    bool lit = red(image, x0, y0) > 0.0f;
    for (int y = y0 - REACH; y <= y0 + REACH; y++)
        for (int x = x0 - REACH; x <= x0 + REACH; x++)
            if (x < 0 || y < 0 || x >= SIDE || y >= SIDE || (red(image, x, y) > 0.0f) != lit)
                return false;
    return true;
}

static void percentage_closer_filter(void **unused)
{
    (void)unused;
    static const lsf_light_type types[] = {LSF_LIGHT_POINT, LSF_LIGHT_SPOT, LSF_LIGHT_DIRECTIONAL};
    for (int t = 0; t < 3; t++) {
        lsf_image *sharp = render_shadow(types[t], true, "shadow.filter=none");
        lsf_image *soft = render_shadow(types[t], true, "shadow.filter=pcf");
        lsf_image *unshadowed = render_shadow(types[t], false, "shadow.filter=none");
        uint32_t dark = 0, lit = 0, between = 0;
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++) {
                float value = red(soft, x, y), most = red(unshadowed, x, y);
                assert_true(isfinite(value) && value >= 0.0f && value <= 1.00001f * most);
                between += value > 0.0f && value < 0.99999f * most;
                if (!far_from_borders(sharp, x, y))
                    continue;
                assert_true(value == red(sharp, x, y));
                lit += value > 0.0f;
                dark += value == 0.0f;
            }
        print_message("light %d: %u dark, %u lit, %u between\n", t, dark, lit, between);
        assert_true(dark > 50 && lit > 50 && between > 20);
        lsf_image_destroy(sharp);
        lsf_image_destroy(soft);
        lsf_image_destroy(unshadowed);
    }
}

/* --- tone mapping -------------------------------------------------------------------------------
 */

/* An environment of 0 and of 1e-4 to 1e6 is all there is to see. */
static lsf_scene *bright_environment(void)
{
    enum { WIDTH = 64, HEIGHT = 32 };
    lsf_scene *scene = build_scene();
    float *texels = build_environment_map(scene, WIDTH, HEIGHT);
    for (uint32_t i = 0; i < WIDTH * HEIGHT * 3; i++)
        texels[i] = i % 5 ? powf(10.0f, (float)(i * 7919u % 1001) / 100.0f - 4.0f) : 0.0f;
    finish_gl_scene(scene);
    return scene;
}

static void tone_curve(void **unused)
{
    (void)unused;
    static const float exposures[] = {0.0f, -6.0f, 1.5f, -6.0f, -6.0f, -6.0f};
    static const lsf_tone_curve curves[] = {LSF_TONE_CURVE_NEUTRAL, LSF_TONE_CURVE_NEUTRAL,
                                            LSF_TONE_CURVE_NEUTRAL, LSF_TONE_CURVE_NONE,
                                            LSF_TONE_CURVE_ACES,    LSF_TONE_CURVE_AGX};
    static uint8_t rgb[SIDE * SIDE * 3];
    lsf_scene *scene = bright_environment();
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "direct";
    params.width = params.height = SIDE;
    params.samples = 2;
    params.rgb8 = true;
    params.fov_y = 120.0f;
    lsf_error error = {0};
    lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
    if (!renderer || !lsf_renderer_run(renderer, &error))
        fail_msg("%s", error.message);
    lsf_image *image = lsf_renderer_read(renderer, &error);
    assert_non_null(image);
    for (size_t e = 0; e < 6; e++) {
        lsf_tone_curve curve = curves[e];
        assert_true(lsf_renderer_read_rgb8(renderer, exposures[e], curve, rgb, &error));
        bool seen[256] = {false};
        for (int i = 0; i < SIDE * SIDE; i++) {
            float x[3];
            for (int c = 0; c < 3; c++)
                x[c] = lsf_tonemap_expose(image->pixels[3 * i + c], exp2f(exposures[e]));
            for (int c = 0; c < 3; c++) {
                float expected = 255.0f * lsf_tonemap_code((int)curve, c, x[0], x[1], x[2]);
                assert_true(fabsf((float)rgb[3 * i + c] - roundf(expected)) <= 1.0f);
                seen[rgb[3 * i + c]] = true;
            }
        }
        int codes = 0;
        for (int i = 0; i < 256; i++)
            codes += seen[i];
        print_message("exposure %g, curve %d: %d code values\n", (double)exposures[e], (int)curve,
                      codes);
        assert_true(codes > 64);
    }
    lsf_image_destroy(image);
    lsf_renderer_destroy(renderer);
    gl_test_check(context);
    lsf_context_destroy(context);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_add_up),
        cmocka_unit_test(far_from_the_origin),
        cmocka_unit_test(percentage_closer_filter),
        cmocka_unit_test(tone_curve),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
