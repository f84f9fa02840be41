/* Light that is kept from frame to frame: what it gains, and how long it stays where it should not.
 */
#include <math.h>

#include "base/base.h"
#include "plan/plan.h"
#include "render_gl.h"

#include <lightsheaf/edit.h>

enum { SIZE = 32, VALUES = SIZE * SIZE * 3, ROW_BYTES = SIZE * 3 * sizeof(float) };

/* --- a corner with a box before it and two lamps */

typedef struct world {
    lsf_scene *scene;
    lsf_context *context;
    lsf_renderer *renderer;
    uint32_t box;
} world;

/* `filter`, `denoised`: options. */
static world begin_filtered(lsf_render_params params, const char *filter, const char *denoised)
{
    const char *const options[] = {filter,
                                   denoised,
                                   "voxel.resolution=32",
                                   "rsm.resolution=64",
                                   "bundle.resolution=64",
                                   "vpl.shadow_resolution=64",
                                   "cloud.count=8192",
                                   "gbuffer.side=1"};
    lsf_error error = {0};
    world w = {.scene = build_scene(), .context = gl_test_context(gl_test_backend(), NULL)};
    build_corner(w.scene);
    build_material(w.scene, 0.9f, 0.4f, 0.2f);
    build_box(w.scene, lsf_f3(-0.3f, 0, 0.2f), lsf_f3(0.2f, 0.6f, 0.7f), false);
    w.box = w.scene->node_count - 1;
    build_light(w.scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
    build_light(w.scene, LSF_LIGHT_POINT, lsf_f3(-0.8f, 1.8f, 0.3f), lsf_f3(0, -1, 0), 3.0f);
    finish_gl_scene(w.scene);
    params.width = params.height = SIZE;
    params.bounces = 1;
    params.options = options;
    params.option_count = LSF_COUNT(options);
    w.renderer = lsf_renderer_create(w.context, w.scene, &params, &error);
    if (!w.renderer)
        fail_msg("%s", error.message);
    return w;
}

static world begin_world(lsf_render_params params)
{
    return begin_filtered(params, "light_filter.steps=0", "temporal.denoised_frames=4");
}

static lsf_render_params keeping(const char *technique)
{
    return (lsf_render_params){LSF_RENDER_PARAMS_DEFAULTS, .technique = technique, .samples = 1,
                               .temporal = true};
}

static void end_world(world *w)
{
    assert_int_equal(lsf_context_get_info(w->context).gl_bytes,
                     lsf_plan_bytes(lsf_renderer_plan(w->renderer)));
    lsf_renderer_destroy(w->renderer);
    assert_int_equal(lsf_context_get_info(w->context).gl_bytes, 0);
    gl_test_check(w->context);
    lsf_context_destroy(w->context);
    lsf_scene_destroy(w->scene);
}

/* Turned by so many pixels, from where the corner is seen. */
static lsf_view view_turned(double pixels)
{
    double turn = atan2(-3.0, -4.0) + atan(pixels * 2.0 * tan(25.0 * M_PI / 180.0) / SIZE);
    return (lsf_view){.position = {2.5, 2.0, 3.5},
                      .forward = {(float)sin(turn), -0.25f, (float)cos(turn)},
                      .up = {0, 1, 0},
                      .fov_y = 50.0f};
}

static void frame_of(const world *w, lsf_frame frame, float pixels[VALUES])
{
    lsf_error error = {0};
    if (!lsf_renderer_begin_frame(w->renderer, &frame, &error) ||
        !lsf_renderer_run(w->renderer, &error) ||
        !lsf_renderer_read_into(w->renderer, 0, pixels, ROW_BYTES, &error))
        fail_msg("%s", error.message);
}

static void run_frame(const world *w, double turned, uint32_t first_sample, float pixels[VALUES])
{
    lsf_view view = view_turned(turned);
    frame_of(w, (lsf_frame){.view = &view, .first_sample = first_sample}, pixels);
}

/* So many more iterations of the same frame. */
static void go_on(const world *w, int iterations, float pixels[VALUES])
{
    lsf_error error = {0};
    for (int i = 0; i < iterations; i++)
        assert_true(lsf_renderer_iterate(w->renderer, &error));
    assert_true(lsf_renderer_read_into(w->renderer, 0, pixels, ROW_BYTES, &error));
}

static double mean_of(const float *pixels)
{
    double sum = 0.0;
    for (int i = 0; i < VALUES; i++)
        sum += (double)pixels[i];
    return sum / VALUES;
}

/* As `compare` has it. */
static double relative_error(const float *pixels, const float *truth)
{
    double sum = 0.0, mean = mean_of(truth);
    for (int i = 0; i < VALUES; i++) {
        double d = (double)pixels[i] - (double)truth[i];
        sum += d * d / ((double)truth[i] * (double)truth[i] + 0.01 * mean * mean);
    }
    return sum / VALUES;
}

/* --- what is gained */

static void still_frames_are_one(void **unused)
{
    (void)unused;
    static const char *const techniques[] = {"direct", "bidirectional", "voxel_path", "cone",
                                             "substitute_tree"};
    for (size_t t = 0; t < LSF_COUNT(techniques); t++) {
        float kept[VALUES], one[VALUES];
        lsf_render_params params = keeping(techniques[t]);
        params.samples = UINT32_MAX; /* what depends on their number has to take it as it grows */
        params.time_limit = 1e-9;
        world w = begin_world(params);
        for (int k = 0; k < 6; k++)
            run_frame(&w, 0.0, 0, kept);
        assert_int_equal(lsf_renderer_get_stats(w.renderer).samples, 6);
        end_world(&w);
        params.temporal = false;
        w = begin_world(params);
        lsf_error error = {0};
        for (int k = 0; k < 6; k++)
            assert_true(k == 0 ? (run_frame(&w, 0.0, 0, one), true)
                               : lsf_renderer_iterate(w.renderer, &error));
        assert_true(lsf_renderer_read_into(w.renderer, 0, one, ROW_BYTES, &error));
        end_world(&w);
        if (memcmp(kept, one, sizeof kept) != 0)
            fail_msg("%s: six still frames are not one of six iterations", techniques[t]);
    }
}

static void pan_is_clean(void **unused)
{
    (void)unused;
    static const char *const techniques[] = {"bidirectional", "voxel_path"};
    for (size_t t = 0; t < LSF_COUNT(techniques); t++) {
        float truth[VALUES], single[VALUES], kept[VALUES];
        lsf_render_params params = keeping(techniques[t]);
        world w = begin_world(params);
        double with = 0.0, without = 0.0;
        lsf_render_params still = params;
        still.temporal = false;
        world fresh = begin_world(still);
        still.samples = 96;
        world converged = begin_world(still);
        for (int k = 0; k < 10; k++) {
            run_frame(&w, k, 0, kept);
            if (k < 8)
                continue;
            run_frame(&converged, k, 1000, truth);
            run_frame(&fresh, k, (uint32_t)k, single);
            with += relative_error(kept, truth);
            without += relative_error(single, truth);
        }
        end_world(&w);
        end_world(&fresh);
        end_world(&converged);
        print_message("%s: relMSE %.4f, of single frames %.4f\n", techniques[t], with / 2.0,
                      without / 2.0);
        assert_true(3.0 * with < without);
    }
}

/* An eye that goes around the box, by so many degrees. */
static lsf_view view_around(double degrees)
{
    double turn = degrees * M_PI / 180.0, x = sin(turn), z = cos(turn);
    return (lsf_view){.position = {(float)(-0.1 + 2.4 * x), 1.4f, (float)(0.4 + 2.4 * z)},
                      .forward = {(float)-x, -0.45f, (float)-z},
                      .up = {0, 1, 0},
                      .fov_y = 40.0f};
}

/* Outlines that move, and faces that are seen from another side, belong to the frame alone. */
static void an_orbit_does_not_blur(void **unused)
{
    (void)unused;
    enum { LAST = 7 };
    float truth[VALUES], single[VALUES], kept[VALUES];
    lsf_render_params params = keeping("voxel_path");
    params.samples = 4;
    lsf_render_params still = params;
    still.temporal = false;
    world w = begin_world(params), fresh = begin_world(still);
    still.samples = 96;
    world converged = begin_world(still);
    for (int k = 0; k <= LAST; k++) {
        lsf_view view = view_around(20.0 + 5.0 * k);
        frame_of(&w, (lsf_frame){.view = &view}, kept);
        if (k == LAST) {
            frame_of(&fresh, (lsf_frame){.view = &view}, single);
            frame_of(&converged, (lsf_frame){.view = &view, .first_sample = 1000}, truth);
        }
    }
    end_world(&w);
    end_world(&fresh);
    end_world(&converged);
    double with = relative_error(kept, truth), without = relative_error(single, truth);
    print_message("an orbit: relMSE %.4f, of a single frame %.4f\n", with, without);
    assert_true(with < without);
}

/* --- what stays */

static void set_lamp(const world *w, float intensity)
{
    lsf_error error = {0};
    const lsf_light_desc desc = {
        .type = LSF_LIGHT_POINT, .intensity = {intensity, intensity, intensity}, .range = INFINITY};
    if (!lsf_scene_set_light(w->scene, 0, &desc, &error))
        fail_msg("%s", error.message);
}

/* Two sequences with the same samples, one of which had the lamp; ends both. */
static void check_lamp(world a, world b, const char *what)
{
    enum { OFF = 6, LAG = 8 };
    float lit[VALUES], dark[VALUES];
    double lamp = 0.0, left = 0.0;
    set_lamp(&a, 5.0f);
    set_lamp(&b, 1e-6f);
    for (int k = 0; k < OFF + LAG; k++) {
        if (k == OFF) {
            set_lamp(&a, 0.0f);
            set_lamp(&b, 0.0f);
        }
        run_frame(&a, 0.3 * k, 0, lit);
        run_frame(&b, 0.3 * k, 0, dark);
        left = mean_of(lit) - mean_of(dark);
        if (k < OFF)
            lamp = left;
    }
    end_world(&a);
    end_world(&b);
    print_message("%s: %.2f %% of the lamp is left\n", what, 100.0 * left / lamp);
    assert_true(fabs(left) < 0.01 * lamp);
}

static void lamp_is_forgotten(void **unused)
{
    (void)unused;
    static const char *const techniques[] = {"bidirectional", "voxel_path", "cone",
                                             "substitute_tree"};
    for (size_t t = 0; t < LSF_COUNT(techniques); t++)
        check_lamp(begin_world(keeping(techniques[t])), begin_world(keeping(techniques[t])),
                   techniques[t]);
    world denoised[2];
    for (int i = 0; i < 2; i++)
        denoised[i] = begin_filtered(keeping("voxel_path"), "light_filter.kind=network",
                                     "temporal.denoised_frames=32");
    check_lamp(denoised[0], denoised[1], "denoised");
}

static void move_box(const world *w, double x)
{
    lsf_error error = {0};
    const double matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 0, 1};
    if (!lsf_scene_set_node(w->scene, w->box, matrix, &error))
        fail_msg("%s", error.message);
}

/* How much of `old` is in a picture that should be `truth`. */
static double share_of(const float *old, const float *pixels, const float *truth)
{
    double along = 0.0, all = 0.0;
    for (int i = 0; i < VALUES; i++) {
        double d = (double)old[i] - (double)truth[i];
        along += d * ((double)pixels[i] - (double)truth[i]);
        all += d * d;
    }
    return along / all;
}

static void box_leaves_no_ghost(void **unused)
{
    (void)unused;
    enum { LAST = 10, BACK = 3 };
    float kept[VALUES], truth[VALUES], old[VALUES];
    lsf_render_params params = keeping("bidirectional");
    params.samples = 8; /* or noise is as much like what was there */
    lsf_render_params still = params;
    still.temporal = false;
    still.samples = 64;
    world w = begin_world(params), converged = begin_world(still);
    for (int k = 0; k <= LAST; k++) {
        move_box(&w, 0.08 * k);
        run_frame(&w, 0.0, 0, kept);
        move_box(&converged, 0.08 * k);
        if (k == LAST - BACK)
            run_frame(&converged, 0.0, 1000, old);
    }
    run_frame(&converged, 0.0, 1000, truth);
    end_world(&w);
    end_world(&converged);
    double ghost = share_of(old, kept, truth);
    print_message("%.1f %% of the picture of %d frames ago is left\n", 100.0 * ghost, BACK);
    /* Pictures of that age and more count for 0.0013^(3 / 8) = 8 %, and newer ones are partly
     * alike; without what forgets them it is 29 %. */
    assert_true(fabs(ghost) < 0.15);
}

/* --- denoised light, with that of frames before and without */

static double apart(const float *a, const float *b)
{
    double sum = 0.0;
    for (int i = 0; i < VALUES; i++)
        sum += fabs((double)a[i] - (double)b[i]);
    return sum / VALUES;
}

/* The first frame has the same bits; later ones have as much light; and once the camera stands
 * still, both go to the same picture. */
static void denoised_light_is_kept(void **unused)
{
    (void)unused;
    enum { PAN = 8, STILL = 60 };
    float with[VALUES], without[VALUES];
    const char *network = "light_filter.kind=network";
    world a = begin_filtered(keeping("voxel_path"), network, "temporal.denoised_frames=32");
    world b = begin_filtered(keeping("voxel_path"), network, "temporal.denoised_frames=0");
    double last = 0.0;
    for (int k = 0; k < PAN; k++) {
        run_frame(&a, k, 0, with);
        run_frame(&b, k, 0, without);
        assert_true(k > 0 || memcmp(with, without, sizeof with) == 0);
        last = apart(with, without) / mean_of(without);
        print_message("frame %d: %.4f apart, %.4f of the light\n", k, last,
                      mean_of(with) / mean_of(without));
        assert_true(fabs(mean_of(with) / mean_of(without) - 1.0) < 0.02);
    }
    assert_true(last > 1e-4);
    go_on(&a, STILL, with);
    go_on(&b, STILL, without);
    double still = apart(with, without) / mean_of(without);
    print_message("after %d more iterations: %.4f apart\n", STILL, still);
    assert_true(still < last / 4.0);
    end_world(&a);
    end_world(&b);
}

/* --- what is as it was */

static void cut_resets_the_history(void **unused)
{
    (void)unused;
    float kept[VALUES], again[VALUES], fresh[VALUES];
    lsf_view view = view_turned(2.0);
    const lsf_frame cut = {.view = &view, .first_sample = 7, .cut = true};
    world w = begin_world(keeping("bidirectional")), other = begin_world(keeping("bidirectional"));
    for (int k = 0; k < 3; k++) {
        run_frame(&w, k, 0, kept);
        run_frame(&other, k, 0, again);
        assert_memory_equal(kept, again, sizeof kept);
    }
    end_world(&other);
    other = begin_world(keeping("bidirectional"));
    frame_of(&w, cut, kept);
    frame_of(&other, cut, fresh);
    assert_memory_equal(kept, fresh, sizeof kept);
    run_frame(&w, 3.0, 0, kept);
    run_frame(&other, 3.0, 0, fresh);
    assert_memory_equal(kept, fresh, sizeof kept);
    end_world(&w);
    end_world(&other);
}

/* Frames that nobody looks at are kept as well. */
static void unread_frames_count(void **unused)
{
    (void)unused;
    float read[VALUES], unread[VALUES];
    world w = begin_world(keeping("bidirectional")), other = begin_world(keeping("bidirectional"));
    for (int k = 0; k < 3; k++) {
        lsf_error error = {0};
        lsf_view view = view_turned(k);
        run_frame(&w, k, 0, read);
        assert_true(lsf_renderer_begin_frame(other.renderer, &(lsf_frame){.view = &view}, &error) &&
                    lsf_renderer_run(other.renderer, &error));
    }
    lsf_error error = {0};
    assert_true(lsf_renderer_read_into(other.renderer, 0, unread, ROW_BYTES, &error));
    assert_memory_equal(read, unread, sizeof read);
    end_world(&w);
    end_world(&other);
}

static void plan_has_it_on_request(void **unused)
{
    (void)unused;
    static const char *const mine[] = {"gbuffer.motion", "temporal.diffuse_history",
                                       "temporal.resolved", "scene.previous_transforms"};
    static const char *const networks[] = {"light_filter.kind=atrous", "light_filter.kind=network"};
    lsf_scene *scene = build_scene();
    lsf_error error = {0};
    build_corner(scene);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
    finish_gl_scene(scene);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    for (int test = 0; test < 4; test++) {
        bool on = test % 2, network = test / 2;
        params.temporal = on;
        const char *const options[] = {networks[network], "temporal.denoised_frames=4"};
        params.options = options;
        params.option_count = LSF_COUNT(options);
        lsf_plan *plan = lsf_plan_create(scene, &params, &error);
        assert_non_null(plan);
        for (size_t i = 0; i < LSF_COUNT(mine); i++)
            assert_int_equal(lsf_plan_find(plan, mine[i]) != NULL, on);
        assert_int_equal(lsf_plan_find(plan, "temporal.denoised_diffuse") != NULL, on && network);
        lsf_plan_destroy(plan);
    }
    params.raw = true;
    assert_null(lsf_plan_create(scene, &params, &error));
    assert_int_equal(error.code, LSF_ERROR_USAGE);
    lsf_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(still_frames_are_one),   cmocka_unit_test(pan_is_clean),
        cmocka_unit_test(an_orbit_does_not_blur), cmocka_unit_test(lamp_is_forgotten),
        cmocka_unit_test(box_leaves_no_ghost),    cmocka_unit_test(denoised_light_is_kept),
        cmocka_unit_test(cut_resets_the_history), cmocka_unit_test(unread_frames_count),
        cmocka_unit_test(plan_has_it_on_request),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
