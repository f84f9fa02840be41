/* An iteration that takes long is asked whether it shall go on; what it has done is dropped. */
#include "base/base.h"
#include "render_gl.h"

enum { SIZE = 16, SAMPLES = 3 };

static const char *const techniques[] = {"direct", "bidirectional", "voxel_path", "cone",
                                         "substitute_tree"};

static const char *const options[] = {"voxel.resolution=32", "rsm.resolution=32",
                                      "vpl.shadow_resolution=32", "bundle.resolution=32",
                                      "cloud.count=8192"};

/* By default every look at the clock takes a second: all is slow. */
static double now, look = 1.0;
static double computed; /* by this thread */

double __wrap_lsf_now(void);
double __wrap_lsf_thread_seconds(void);

double __wrap_lsf_now(void)
{
    return now += look;
}

double __wrap_lsf_thread_seconds(void)
{
    return computed;
}

static lsf_scene *lit_scene(void)
{
    lsf_scene *scene = build_scene();
    build_corner(scene);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 3.0f);
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(-0.4f, -0.8f, -0.5f), 1.0f);
    build_light(scene, LSF_LIGHT_SPOT, lsf_f3(-1, 2.5f, 1), lsf_f3(0, -1, -0.5f), 8.0f);
    finish_gl_scene(scene);
    return scene;
}

typedef struct caller {
    uint32_t stop_after; /* iterations that are done; UINT32_MAX: never */
    uint32_t within;     /* questions about the next one so far */
    uint32_t last;
} caller;

static bool on_progress(uint32_t done, uint32_t total, void *user)
{
    caller *c = user;
    assert_true(done <= total);
    c->within = done == c->last ? c->within + 1 : 0;
    c->last = done;
    return done != c->stop_after || c->within == 0;
}

static lsf_image *read_picture(lsf_renderer *renderer, uint32_t samples)
{
    lsf_error error = {0};
    lsf_image *image = lsf_renderer_read(renderer, &error);
    if (!image)
        fail_msg("%s", error.message);
    assert_int_equal(lsf_renderer_get_stats(renderer).samples, samples);
    return image;
}

static void run(lsf_renderer *renderer)
{
    lsf_error error = {0};
    if (!lsf_renderer_run(renderer, &error))
        fail_msg("%s", error.message);
}

static void check(const char *technique)
{
    lsf_scene *scene = lit_scene();
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    caller c = {.stop_after = UINT32_MAX};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .bounces = 1};
    params.technique = technique;
    params.samples = SAMPLES;
    params.options = options;
    params.option_count = LSF_COUNT(options);
    params.progress = on_progress;
    params.progress_user = &c;
    params = corner_params(params, SIZE);
    lsf_error error = {0};
    lsf_image *whole[SAMPLES]; /* of 1, 2, ... iterations */
    lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
    assert_non_null(renderer);
    for (uint32_t i = 0; i < SAMPLES; i++) {
        assert_true(lsf_renderer_iterate(renderer, &error));
        whole[i] = read_picture(renderer, i + 1);
    }
    lsf_renderer_destroy(renderer);

    renderer = lsf_renderer_create(context, scene, &params, &error);
    assert_non_null(renderer);
    for (uint32_t done = 0; done <= SAMPLES; done++) {
        c = (caller){.stop_after = done, .last = done ? done - 1 : 0};
        run(renderer);
        assert_true(done == SAMPLES || c.within == 1);
        lsf_image *image = read_picture(renderer, done);
        if (done > 0)
            assert_same_pixels(image, whole[done - 1]);
        lsf_image_destroy(image);
    }
    lsf_renderer_destroy(renderer);

    c = (caller){.stop_after = UINT32_MAX};
    params.time_limit = 0.5;
    renderer = lsf_renderer_create(context, scene, &params, &error);
    assert_non_null(renderer);
    run(renderer);
    lsf_image *image = read_picture(renderer, 1);
    assert_same_pixels(image, whole[0]);
    lsf_image_destroy(image);
    lsf_renderer_destroy(renderer);
    for (uint32_t i = 0; i < SAMPLES; i++)
        lsf_image_destroy(whole[i]);
    gl_test_check(context);
    lsf_context_destroy(context);
    destroy_scene(scene);
}

static void stops_within_an_iteration(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < LSF_COUNT(techniques); i++) {
        print_message("%s\n", techniques[i]);
        check(techniques[i]);
    }
}

/* Seconds that the first iteration and each of the others take, in all and of this thread. */
typedef struct course {
    double first, first_computed, other, other_computed;
    uint32_t samples; /* iterations within a second of rendering */
} course;

static bool pass_time(uint32_t done, uint32_t total, void *user)
{
    const course *c = user;
    (void)total;
    now += done == 1 ? c->first : c->other;
    computed += done == 1 ? c->first_computed : c->other_computed;
    return true;
}

/* The limit is one of rendering: time in which the driver compiles shaders is not part of it. */
static void compilation_is_not_rendering(void **unused)
{
    (void)unused;
    static const course courses[] = {
        {3.0, 2.9, 0.2, 0.02, 5}, /* compiles for 2.88 s */
        {3.0, 0.1, 0.2, 0.02, 1}, /* renders for long */
        {3.0, 3.0, 3.0, 3.0, 2},  /* the thread itself renders: the second iteration shows it */
        {0.2, 0.02, 0.2, 0.02, 5},
    };
    lsf_scene *scene = lit_scene();
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    if (!lsf_context_get_info(context).software) { /* else no time is allowed for */
        lsf_context_destroy(context);
        destroy_scene(scene);
        skip();
    }
    look = 0.0;
    for (size_t i = 0; i < LSF_COUNT(courses); i++) {
        course c = courses[i];
        lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .bounces = 0};
        params.technique = "direct";
        params.samples = UINT32_MAX;
        params.time_limit = 1.0;
        params.progress = pass_time;
        params.progress_user = &c;
        params = corner_params(params, SIZE);
        lsf_error error = {0};
        lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
        assert_non_null(renderer);
        run(renderer);
        lsf_image_destroy(read_picture(renderer, c.samples));
        lsf_renderer_destroy(renderer);
    }
    look = 1.0;
    gl_test_check(context);
    lsf_context_destroy(context);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(stops_within_an_iteration),
                                       cmocka_unit_test(compilation_is_not_rendering)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
