/* What is seen where no surface is, and how much of a pixel surfaces cover, with each technique. */
#include "render_gl.h"

static const char *const techniques[] = {"bidirectional", "cone", "direct", "substitute_tree",
                                         "voxel_path"};

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.9g is not %.9g", value, expected);
}

static float channel(const lsf_image *image, uint32_t pixel, const char *name)
{
    int at = lsf_image_channel(image, name);
    assert_true(at >= 0);
    return image->pixels[pixel * image->channel_count + (uint32_t)at];
}

/* A wall that covers what lies left of x = -1/16 in a picture 8 pixels wide that shows -1 to 1:
 * three columns and three quarters of the fourth. */
static lsf_scene *build_wall(void)
{
    lsf_scene *scene = build_scene();
    lsf_camera *camera = &scene->cameras[0];
    camera->orthographic = true;
    camera->x_magnification = camera->y_magnification = 1;
    camera->matrix[14] = 2;
    build_material(scene, 0.8f, 0.4f, 0.2f)->emission[1] = 0.5f;
    build_quad(scene, lsf_f3(-9, -9, 0), lsf_f3(-0.0625f, -9, 0), lsf_f3(-0.0625f, 9, 0),
               lsf_f3(-9, 9, 0));
    build_environment(scene, 3);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(-1, 0, 1), lsf_f3(0, 0, -1), 2);
    finish_gl_scene(scene);
    return scene;
}

static lsf_image *render_wall(const lsf_scene *scene, const char *technique,
                              lsf_background background)
{
    static const char *const options[] = {"voxel.resolution=16"};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = technique;
    params.width = params.height = 8;
    params.samples = 16;
    params.options = options;
    params.option_count = 1;
    params.bounces = 0;
    params.background = background;
    params.background_radiance[0] = 0.25f;
    params.background_radiance[1] = 0.5f;
    params.background_radiance[2] = 4;
    return render_gl(LSF_BACKEND_AUTO, scene, &params);
}

static void assert_covered(const lsf_image *clear)
{
    for (uint32_t pixel = 0; pixel < 64; pixel++) {
        uint32_t x = pixel % 8;
        double alpha = (double)channel(clear, pixel, "A");
        assert_near(alpha, x < 3 ? 1 : x == 3 ? 0.75 : 0, x == 3 ? 0.1 : 0);
        if (x > 3)
            assert_near((double)channel(clear, pixel, "G"), 0, 0);
        else /* at least what the wall emits, for as much of the pixel as it covers */
            assert_true((double)channel(clear, pixel, "G") >= 0.499 * alpha);
    }
}

/* The same light as without a background, which fills what is not covered. */
static void assert_filled(const lsf_image *image, const lsf_image *clear, const float seen[3])
{
    static const char *const names[3] = {"R", "G", "B"};
    assert_int_equal(lsf_image_channel(image, "A"), -1);
    for (uint32_t pixel = 0; pixel < 64; pixel++)
        for (int c = 0; c < 3; c++) {
            double free_share = 1 - (double)channel(clear, pixel, "A");
            double expected =
                (double)channel(clear, pixel, names[c]) + free_share * (double)seen[c];
            assert_near((double)channel(image, pixel, names[c]), expected, 1e-5 * (1 + expected));
        }
}

static void test_each_technique(void **state)
{
    (void)state;
    static const float uniform[3] = {0.25f, 0.5f, 4}, environment[3] = {3, 3, 3};
    lsf_scene *scene = build_wall();
    for (size_t i = 0; i < sizeof techniques / sizeof *techniques; i++) {
        lsf_image *clear = render_wall(scene, techniques[i], LSF_BACKGROUND_TRANSPARENT);
        assert_covered(clear);
        lsf_image *image = render_wall(scene, techniques[i], LSF_BACKGROUND_UNIFORM);
        assert_filled(image, clear, uniform);
        lsf_image_destroy(image);
        image = render_wall(scene, techniques[i], LSF_BACKGROUND_AUTO);
        assert_filled(image, clear, environment);
        lsf_image_destroy(image);
        lsf_image_destroy(clear);
    }
    destroy_scene(scene);
}

/* Grey, though the sky lights the scene. */
static void test_grey_before_the_default_sky(void **state)
{
    (void)state;
    lsf_scene *scene = build_wall();
    scene->environment.by_default = true;
    lsf_image *image = render_wall(scene, "direct", LSF_BACKGROUND_AUTO);
    for (int c = 0; c < 3; c++)
        assert_near((double)image->pixels[7 * image->channel_count + (uint32_t)c], 0.18, 1e-7);
    lsf_image_destroy(image);
    destroy_scene(scene);
}

/* A scene that needs nothing composed otherwise. */
static void test_without_an_environment(void **state)
{
    (void)state;
    lsf_scene *scene = build_wall();
    scene->environment.present = false;
    for (int c = 0; c < 3; c++)
        scene->materials[0].emission[c] = 0;
    finish_gl_scene(scene);
    lsf_image *image = render_wall(scene, "direct", LSF_BACKGROUND_UNIFORM);
    assert_near((double)channel(image, 7, "B"), 4, 0);
    lsf_image_destroy(image);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_technique),
        cmocka_unit_test(test_grey_before_the_default_sky),
        cmocka_unit_test(test_without_an_environment),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
