/* A renderer that goes over to other parameters has the bits of one that was made with them. */
#include <math.h>

#include "base/base.h"
#include "embedding_rig.h"

#include <lightsheaf/edit.h>

enum { OPTIONS = 5 };

static const float eyes[2][3] = {{2.0f, 1.5f, 3.0f}, {1.0f, 0.7f, 3.5f}};
static const float target[3] = {0.2f, 0.4f, 0.1f};

/* Step by step: what is otherwise than in the step before. */
static lsf_render_params step(int k)
{
    static const char *options[OPTIONS] = {"voxel.resolution=32", "rsm.resolution=32",
                                           "vpl.shadow_resolution=32", "bundle.resolution=32"};
    static const char *const techniques[] = {"direct", "bidirectional", "cone", "voxel_path"};
    lsf_render_params params = rig_params(techniques[k < 3 ? 0 : k < 6 ? 1 : k < 9 ? 2 : 3]);
    params.options = options;
    params.option_count = k >= 4 ? OPTIONS : OPTIONS - 1;
    options[OPTIONS - 1] = k == 8 ? "tessellation.factor=2" : "shadow.filter=pcf";
    params.camera_position = k >= 1 ? eyes[k & 1] : params.camera_position;
    params.camera_target = target;
    params.fov_y = k == 2 ? 30.0f : params.fov_y;
    params.width += k >= 5 ? 5u : 0u;
    params.aovs = k >= 6 ? LSF_AOV_NORMAL | LSF_AOV_MOTION : 0;
    params.samples = k >= 7 ? 3 : 2;
    params.seed = k >= 10 ? 7 : 0;
    params.raw = k == 9;
    params.temporal = k == 11;
    params.rgb8 = k >= 3;
    params.background = k == 4 ? LSF_BACKGROUND_UNIFORM : params.background;
    return params;
}

static lsf_image *run(lsf_renderer *renderer)
{
    lsf_error error = {0};
    rig_run(renderer);
    lsf_image *image = lsf_renderer_read(renderer, &error);
    if (!image)
        fail_msg("%s", error.message);
    return image;
}

static void each_step(void **user)
{
    (void)user;
    lsf_error error = {0};
    lsf_scene *scene = rig_scene(5.0f);
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    lsf_render_params params = step(0);
    lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
    assert_non_null(renderer);
    for (int k = 0; k < 14; k++) {
        params = step(k % 12);
        if (!lsf_renderer_change(renderer, &params, &error))
            fail_msg("step %d: %s", k, error.message);
        assert_int_equal(lsf_context_get_info(context).gl_bytes,
                         lsf_plan_bytes(lsf_renderer_plan(renderer)));
        lsf_image *image = run(renderer);
        lsf_renderer *fresh = lsf_renderer_create(context, scene, &params, &error);
        assert_non_null(fresh);
        lsf_image *expected = run(fresh);
        assert_same_pixels(image, expected);
        lsf_image_destroy(image);
        lsf_image_destroy(expected);
        lsf_renderer_destroy(fresh);
    }
    lsf_renderer_destroy(renderer);
    assert_int_equal(lsf_context_get_info(context).gl_bytes, 0);
    gl_test_check(context);
    lsf_context_destroy(context);
    lsf_scene_destroy(scene);
}

/* Other eyes change no plan, whatever the options that are left to it. */
static void eyes_keep_the_plan(void **user)
{
    (void)user;
    static const char *const techniques[] = {"bidirectional", "cone"};
    lsf_error error = {0};
    lsf_scene *scene = rig_scene(5.0f);
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    for (size_t t = 0; t < LSF_COUNT(techniques); t++) {
        lsf_render_params params = rig_params(techniques[t]);
        params.option_count = 0;
        params.camera_position = eyes[0];
        params.camera_target = target;
        params.time_limit = 10.0;
        lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
        assert_non_null(renderer);
        const lsf_plan *plan = lsf_renderer_plan(renderer);
        params.camera_position = eyes[1];
        assert_true(lsf_renderer_change(renderer, &params, &error));
        assert_ptr_equal(lsf_renderer_plan(renderer), plan);
        params.time_limit = 1.0; /* leaves room for less */
        assert_true(lsf_renderer_change(renderer, &params, &error));
        assert_ptr_not_equal(lsf_renderer_plan(renderer), plan);
        lsf_renderer_destroy(renderer);
    }
    gl_test_check(context);
    lsf_context_destroy(context);
    lsf_scene_destroy(scene);
}

/* What is refused leaves the picture, and what it is of, as they are. */
static void refused(void **user)
{
    (void)user;
    lsf_error error = {0};
    lsf_scene *scene = rig_scene(5.0f);
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    lsf_render_params params = step(1), wrong;
    lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
    lsf_image *expected = run(renderer);
    static const char *const option[] = {"no.such=1"};
    for (int k = 0; k < 5; k++) {
        wrong = params;
        if (k == 0)
            wrong.technique = "no_such";
        else if (k == 1)
            wrong.width = 0;
        else if (k == 2)
            wrong.options = option, wrong.option_count = 1;
        else if (k == 3)
            wrong.camera = "no such camera", wrong.camera_position = NULL;
        else
            wrong.camera_target = wrong.camera_position;
        error.code = LSF_OK;
        assert_false(lsf_renderer_change(renderer, &wrong, &error));
        assert_int_equal(error.code, LSF_ERROR_USAGE);
        rig_check_picture(renderer, expected);
    }
    assert_false(lsf_renderer_change(NULL, &params, &error));
    assert_false(lsf_renderer_change(renderer, NULL, &error));
    assert_true(lsf_renderer_change(renderer, &params, &error));
    lsf_image *image = run(renderer);
    assert_same_pixels(image, expected);
    lsf_image_destroy(image);
    lsf_image_destroy(expected);
    lsf_renderer_destroy(renderer);
    lsf_context_destroy(context);
    lsf_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_step),
        cmocka_unit_test(eyes_keep_the_plan),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
