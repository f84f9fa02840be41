/* What is small beside the scene, or far from the camera, is lit as if it were alone. */
#include <math.h>

#include "render_gl.h"

#define SIZE 48

/* A box on a floor of half width 2, under one light. */
static lsf_scene *small_scene(lsf_light_type type)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.8f, 0.6f, 0.4f);
    build_floor(scene, 0.0f, 2.0f);
    build_box(scene, lsf_f3(-0.5f, 0, -0.5f), lsf_f3(0.5f, 1, 0.5f), false);
    lsf_light *light = build_light(scene, type, lsf_f3(-1.5f, 2, 1), lsf_f3(0.6f, -0.7f, -0.4f),
                                   type == LSF_LIGHT_DIRECTIONAL ? 1.0f : 10.0f);
    light->inner_cone = 0.3f;
    light->outer_cone = 0.6f;
    return scene;
}

static lsf_image *render_small(lsf_scene *scene)
{
    finish_gl_scene(scene);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "direct";
    params.samples = 8;
    return render_gl_from(scene, params, SIZE, lsf_f3(1, 3, 5), lsf_f3(0, 0.3f, 0));
}

/* Means agree within `bias`, pixels within `rmse` of the mean. */
static void assert_close(const lsf_image *image, const lsf_image *expected, double bias,
                         double rmse)
{
    double sum = 0.0, expected_sum = 0.0, squares = 0.0;
    for (uint32_t i = 0; i < SIZE * SIZE * image->channel_count; i++) {
        double a = (double)image->pixels[i], b = (double)expected->pixels[i];
        assert_true(isfinite(a));
        sum += a;
        expected_sum += b;
        squares += (a - b) * (a - b);
    }
    double mean = expected_sum / (SIZE * SIZE * image->channel_count);
    double off = sqrt(squares / (SIZE * SIZE * image->channel_count)) / mean;
    assert_true(expected_sum > 0.0);
    if (!(fabs(sum / expected_sum - 1.0) <= bias && off <= rmse))
        fail_msg("bias %g, RMSE %g of the mean", sum / expected_sum - 1.0, off);
}

/* A triangle of a millimetre makes a scene of metres one of kilometres. The sun's map has other
 * texels then, and shadows' borders other steps. */
static void beside_a_stray_triangle(void **unused)
{
    (void)unused;
    static const lsf_light_type types[] = {LSF_LIGHT_POINT, LSF_LIGHT_SPOT, LSF_LIGHT_DIRECTIONAL};
    for (size_t type = 0; type < sizeof types / sizeof *types; type++) {
        lsf_scene *alone = small_scene(types[type]);
        lsf_image *expected = render_small(alone);
        destroy_scene(alone);
        static const float distances[] = {300.0f, 3000.0f, 30000.0f};
        for (int i = 0; i < 3; i++) {
            float x = distances[i];
            const lsf_float3 stray[3] = {{x, -x, 0}, {x + 1e-3f, -x, 0}, {x, -x, 1e-3f}};
            lsf_scene *scene = small_scene(types[type]);
            build_triangles(scene, stray, 1);
            lsf_image *image = render_small(scene);
            assert_close(image, expected, 1e-3, 0.05);
            lsf_image_destroy(image);
            destroy_scene(scene);
        }
        lsf_image_destroy(expected);
    }
}

/* `distance` away from the box; orthographic when `field` is 0. */
static lsf_image *render_from(double distance, bool orthographic)
{
    lsf_scene *scene = small_scene(LSF_LIGHT_POINT);
    lsf_camera *camera = &scene->cameras[0];
    const double c = cos(0.5), s = sin(0.5);
    const double matrix[16] = {1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0, 0, s * distance, c * distance,
                               1};
    memcpy(camera->matrix, matrix, sizeof matrix);
    camera->orthographic = orthographic;
    camera->y_magnification = 2.0f;
    camera->near_plane = 0.01f;
    camera->fov_y = (float)(2.0 * atan(2.0 / distance));
    finish_gl_scene(scene);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "direct";
    params.width = params.height = SIZE;
    params.samples = 8;
    params.aovs = LSF_AOV_NORMAL;
    lsf_image *image = render_gl(gl_test_backend(), scene, &params);
    destroy_scene(scene);
    return image;
}

/* A camera far off with a narrow field of view shows what an orthographic one shows. */
static void from_far_away(void **unused)
{
    (void)unused;
    lsf_image *expected = render_from(6.0, true);
    static const double distances[] = {1e5, 1e7, 1e9};
    for (int i = 0; i < 3; i++)
        for (int orthographic = 0; orthographic < 2; orthographic++) {
            lsf_image *image = render_from(distances[i], orthographic);
            assert_close(image, expected, 1e-3, 0.02);
            lsf_image_destroy(image);
        }
    lsf_image_destroy(expected);
}

/* A camera that cannot be told from its neighbours is refused, by the option that moved it there.
 */
static void too_far_or_too_narrow(void **unused)
{
    (void)unused;
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    lsf_scene *scene = small_scene(LSF_LIGHT_POINT);
    finish_gl_scene(scene);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "direct";
    params.width = params.height = 16;
    lsf_error error = {0};
    const float far_off[3] = {0, 0, 1e19f};
    params.camera_position = far_off;
    assert_null(lsf_renderer_create(context, scene, &params, &error));
    assert_int_equal(error.code, LSF_ERROR_USAGE);
    assert_non_null(strstr(error.message, "move it closer"));
    params.camera_position = NULL;
    scene->cameras[0].fov_y = 1e-10f;
    assert_null(lsf_renderer_create(context, scene, &params, &error));
    assert_int_equal(error.code, LSF_ERROR_USAGE);
    assert_non_null(strstr(error.message, "widen the field of view"));
    lsf_context_destroy(context);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(beside_a_stray_triangle),
        cmocka_unit_test(from_far_away),
        cmocka_unit_test(too_far_or_too_narrow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
