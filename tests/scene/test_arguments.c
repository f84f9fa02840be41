/* What a program passes by mistake is an error, never a crash. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <lightsheaf/lightsheaf.h>

#include "build_scene.h"

static lsf_error error;

/* After a call that gave nothing. */
static void check_usage(bool failed, const char *call)
{
    if (!failed || error.code != LSF_ERROR_USAGE || !error.message[0])
        fail_msg("%s: code %d, \"%s\"", call, error.code, error.message);
    error = (lsf_error){0};
}
#define FAILS(call) check_usage(!(call), #call)

static void no_context(void **state)
{
    (void)state;
    const lsf_frame frame = {LSF_FRAME_DEFAULTS};
    uint8_t rgb[3];
    FAILS(lsf_context_wrap(NULL, &error));
    FAILS(lsf_context_make_current(NULL, &error));
    FAILS(lsf_context_release_current(NULL, &error));
    FAILS(lsf_context_check(NULL, &error));
    assert_null(lsf_context_get_info(NULL).backend);
    lsf_context_destroy(NULL);
    FAILS(lsf_renderer_create(NULL, NULL, NULL, &error));
    FAILS(lsf_renderer_begin_frame(NULL, &frame, &error));
    FAILS(lsf_renderer_resize(NULL, 1, 1, &frame, &error));
    FAILS(lsf_renderer_iterate(NULL, &error));
    FAILS(lsf_renderer_run(NULL, &error));
    FAILS(lsf_renderer_read(NULL, &error));
    FAILS(lsf_renderer_read_rgb8(NULL, 0.0f, LSF_TONE_CURVE_NEUTRAL, rgb, &error));
    FAILS(lsf_renderer_read_into(NULL, 0, NULL, 0, &error));
    FAILS(lsf_renderer_texture(NULL, 0, &error));
    FAILS(lsf_renderer_present(NULL, 0, NULL, 0.0f, LSF_TONE_CURVE_NONE, &error));
    assert_int_equal(lsf_renderer_get_stats(NULL).pass_count, 0);
    assert_int_equal(lsf_renderer_poll_times(NULL, NULL), 0);
    assert_null(lsf_renderer_plan(NULL));
    lsf_renderer_destroy(NULL);
    FAILS(lsf_ray_bench_create(NULL, NULL, NULL, &error));
    FAILS(lsf_ray_bench_run(NULL, 1, 1, 1, 1, NULL, &error));
    assert_string_equal(lsf_ray_bench_embree_function(NULL), "");
    lsf_ray_bench_destroy(NULL);
}

static void no_scene(void **state)
{
    (void)state;
    double matrix[16];
    lsf_light_desc light;
    lsf_material_desc material;
    FAILS(lsf_scene_load(NULL, NULL, &error));
    FAILS(lsf_scene_load_memory(NULL, 1, NULL, NULL, &error));
    FAILS(lsf_scene_get_node(NULL, 0, matrix, &error));
    FAILS(lsf_scene_set_node(NULL, 0, matrix, &error));
    FAILS(lsf_scene_get_light(NULL, 0, &light, &error));
    FAILS(lsf_scene_set_light(NULL, 0, &light, &error));
    FAILS(lsf_scene_get_environment(NULL, &light.range, &light.range, &error));
    FAILS(lsf_scene_set_environment_rotation(NULL, 1.0f, &error));
    FAILS(lsf_scene_set_environment_strength(NULL, 1.0f, &error));
    FAILS(lsf_scene_get_material(NULL, 0, &material, &error));
    FAILS(lsf_scene_set_material(NULL, 0, &material, &error));
    assert_int_equal(lsf_scene_count(NULL, LSF_KIND_NODE), 0);
    assert_null(lsf_scene_name(NULL, LSF_KIND_NODE, 0));
    assert_int_equal(lsf_scene_find(NULL, LSF_KIND_NODE, "a"), LSF_NOT_FOUND);
    assert_null(lsf_scene_get_requirements(NULL));
    assert_int_equal(lsf_scene_camera_count(NULL), 0);
    assert_null(lsf_scene_camera_name(NULL, 0));
    assert_int_equal(lsf_scene_note_count(NULL), 0);
    assert_null(lsf_scene_note(NULL, 0));
    assert_null(lsf_scene_describe(NULL, false));
    assert_false(lsf_scene_has(NULL, LSF_FEATURE_EMISSION));
    FAILS(lsf_scene_without(NULL, LSF_FEATURE_EMISSION, &error));
    lsf_scene_destroy(NULL);
}

static void no_image(void **state)
{
    (void)state;
    const uint8_t rgb[3] = {0};
    lsf_compare_result result;
    FAILS(lsf_image_create(1, 1, 1, NULL, &error));
    FAILS(lsf_image_load(NULL, &error));
    FAILS(lsf_image_save(NULL, "a.png", NULL, &error));
    FAILS(lsf_image_save_rgb8(NULL, 1, 1, "a.png", NULL, &error));
    FAILS(lsf_image_save_rgb8(rgb, 1, 1, NULL, NULL, &error));
    FAILS(lsf_image_can_save(1, 1, NULL, NULL, &error));
    FAILS(lsf_image_describe(NULL, false, &error));
    FAILS(lsf_compare(NULL, NULL, NULL, &result, &error));
    FAILS(lsf_compare_difference(NULL, NULL, 1.0f, &error));
    assert_int_equal(lsf_image_channel(NULL, "R"), -1);
    assert_false(lsf_image_recognise(NULL));
    assert_true(lsf_image_auto_exposure(NULL) == 0.0f);
    lsf_image_destroy(NULL);
}

/* Params without defaults: of a plan, which checks them as a renderer does. */
static void zeroed_params(void **state)
{
    (void)state;
    lsf_scene *scene = build_scene();
    build_corner(scene);
    finish_scene(scene);
    lsf_scene_compute_requirements(scene);
    lsf_render_params params = {0};
    const char *const options[] = {NULL};
    lsf_view view;
    FAILS(lsf_plan_create(NULL, &params, &error));
    FAILS(lsf_plan_create(scene, NULL, &error));
    FAILS(lsf_plan_create(scene, &params, &error));
    FAILS(lsf_reference_render(scene, NULL, 0, NULL, &error));
    FAILS(lsf_reference_render(NULL, &params, 0, NULL, &error));
    FAILS(lsf_reference_render(scene, &params, 0, NULL, &error));
    FAILS(lsf_render_params_view(NULL, &params, &view, &error));
    FAILS(lsf_render_params_view(scene, NULL, &view, &error));
    FAILS(lsf_render_params_view(scene, &params, NULL, &error));
    params = (lsf_render_params){LSF_RENDER_PARAMS_DEFAULTS};
    params.technique = NULL;
    FAILS(lsf_plan_create(scene, &params, &error));
    params = (lsf_render_params){LSF_RENDER_PARAMS_DEFAULTS, .option_count = 1};
    FAILS(lsf_plan_create(scene, &params, &error));
    params.options = options;
    FAILS(lsf_plan_create(scene, &params, &error));
    params = (lsf_render_params){LSF_RENDER_PARAMS_DEFAULTS, .fov_y = 0.0f};
    FAILS(lsf_plan_create(scene, &params, &error));
    assert_int_equal(lsf_plan_bytes(NULL), 0);
    assert_int_equal(lsf_plan_bounces(NULL), 0);
    assert_null(lsf_plan_describe(NULL, false));
    assert_null(lsf_plan_dot(NULL));
    FAILS(lsf_plan_price(NULL, NULL, NULL, &error));
    lsf_price_finish(NULL);
    lsf_plan_destroy(NULL);
    assert_int_equal(lsf_aov_from_name(NULL), 0);
    assert_false(lsf_option_list(0, NULL));
    lsf_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_context),
        cmocka_unit_test(no_scene),
        cmocka_unit_test(no_image),
        cmocka_unit_test(zeroed_params),
    };
    return cmocka_run_group_tests_name("arguments", tests, NULL, NULL);
}
