/* Pictures with light_filter.kind=network: every technique, from one iteration to many, from frame
 * to frame, and without weights. The network is small, and its weights are random: it knows nothing
 * of light. */
#include <math.h>
#include <unistd.h>

#include "base/base.h"
#include "net_rig.h"
#include "plan/plan.h"
#include "render_gl.h"

enum { SIZE = 32, VALUES = SIZE * SIZE * 3, ROW_BYTES = SIZE * 3 * sizeof(float) };

static const char *const weights = "LIGHTSHEAF_DENOISER_WEIGHTS";

static char weights_path[64];

static int write_weights(void **unused)
{
    (void)unused;
    snprintf(weights_path, sizeof weights_path, "/tmp/lightsheaf-test-%d.lsfd", (int)getpid());
    net_rig_write(weights_path, 3, 0.1f, 1.0f, 2.0f, 3);
    return setenv(weights, weights_path, 1);
}

static int remove_weights(void **unused)
{
    (void)unused;
    unsetenv(weights);
    return unlink(weights_path);
}

typedef struct world {
    lsf_scene *scene;
    lsf_context *context;
    lsf_renderer *renderer;
} world;

static world begin_world(lsf_render_params params, const char *kind, const char *processor)
{
    char kind_option[64], processor_option[64];
    lsf_error error = {0};
    world w = {.scene = build_scene(), .context = gl_test_context(gl_test_backend(), NULL)};
    build_corner(w.scene);
    build_light(w.scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
    w.scene->environment.radiance[1] = w.scene->environment.radiance[2] = 0.3f;
    finish_gl_scene(w.scene);
    snprintf(kind_option, sizeof kind_option, "light_filter.kind=%s", kind);
    snprintf(processor_option, sizeof processor_option, "denoise.processor=%s", processor);
    const char *const options[] = {
        kind_option,         processor_option,       "voxel.resolution=32",
        "rsm.resolution=64", "bundle.resolution=64", "vpl.shadow_resolution=64",
        "cloud.count=8192"};
    params = corner_params(params, SIZE);
    params.bounces = 1;
    params.options = options;
    params.option_count = LSF_COUNT(options);
    w.renderer = lsf_renderer_create(w.context, w.scene, &params, &error);
    if (!w.renderer)
        fail_msg("%s", error.message);
    return w;
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

static void read_pixels(const world *w, float pixels[VALUES])
{
    lsf_error error = {0};
    if (!lsf_renderer_run(w->renderer, &error) ||
        !lsf_renderer_read_into(w->renderer, 0, pixels, ROW_BYTES, &error))
        fail_msg("%s", error.message);
    for (int i = 0; i < VALUES; i++)
        assert_true(isfinite(pixels[i]) && pixels[i] >= 0.0f);
}

static void render(lsf_render_params params, const char *kind, const char *processor,
                   float pixels[VALUES])
{
    world w = begin_world(params, kind, processor);
    read_pixels(&w, pixels);
    end_world(&w);
}

/* Root of the mean squared difference. */
static double apart(const float *a, const float *b)
{
    double sum = 0.0;
    for (int i = 0; i < VALUES; i++)
        sum += pow((double)a[i] - (double)b[i], 2.0);
    return sqrt(sum / VALUES);
}

static double mean_of(const float *pixels)
{
    double sum = 0.0;
    for (int i = 0; i < VALUES; i++)
        sum += (double)pixels[i];
    return sum / VALUES;
}

/* It changes every technique's picture and keeps its light; the same bits again, and nearly those
 * of the other processor. */
static void every_technique_is_denoised(void **unused)
{
    (void)unused;
    static float filtered[VALUES], seen[VALUES], again[VALUES], by_gl[VALUES], raw[VALUES];
    static const char *const techniques[] = {"bidirectional", "voxel_path", "cone",
                                             "substitute_tree"};
    for (size_t i = 0; i < LSF_COUNT(techniques); i++) {
        lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .technique = techniques[i],
                                    .samples = 1};
        render(params, "network", "auto", seen);
        if (i == 0)
            render(params, "network", "auto", again);
        render(params, "network", "gl", by_gl);
        render(params, "atrous", "auto", filtered);
        params.raw = true;
        render(params, "network", "auto", raw);
        double mean = mean_of(raw), changed = apart(seen, filtered);
        print_message("%s: %.4f of the light, changed by %.4f, by gl %.1e, raw %.4f\n",
                      techniques[i], mean_of(seen) / mean_of(filtered), changed / mean,
                      apart(seen, by_gl) / mean, apart(raw, filtered) / mean);
        assert_true(i > 0 || memcmp(seen, again, sizeof seen) == 0);
        assert_true(changed > 0.01 * mean);
        assert_true(apart(seen, by_gl) < 1e-3 * mean);
    }
}

/* However wrong the network is, its picture goes to the raw one as that loses its noise. */
static void it_vanishes_with_the_noise(void **unused)
{
    (void)unused;
    static float truth[VALUES], seen[VALUES], raw[VALUES];
    static const char *const techniques[] = {"bidirectional", "voxel_path"};
    for (size_t i = 0; i < LSF_COUNT(techniques); i++) {
        lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .technique = techniques[i],
                                    .samples = 128, .seed = 7, .raw = true};
        render(params, "atrous", "auto", truth);
        params.seed = 0;
        double first = 0.0;
        for (uint32_t samples = 1; samples <= 64; samples *= 8) {
            params.samples = samples;
            params.raw = true;
            render(params, "network", "auto", raw);
            params.raw = false;
            render(params, "network", "auto", seen);
            double changed = apart(seen, raw), noise = apart(raw, truth);
            print_message("%s, %2u iterations: changed by %.4f, noise %.4f, error %.4f\n",
                          techniques[i], samples, changed, noise, apart(seen, truth));
            /* The filter's limit takes a change for noise up to sqrt(3) standard deviations of it,
             * and more where few iterations tell the variance. */
            assert_true(samples == 1 || changed < 3.0 * noise);
            assert_true(samples < 64 || changed < first / 4.0);
            first = samples == 1 ? changed : first;
        }
    }
}

/* One frame of k iterations is k frames of one in which nothing happens; state that is kept changes
 * the next frame, and a cut forgets it. */
static void state_is_kept_and_cut(void **unused)
{
    (void)unused;
    static float frames[4][VALUES];
    lsf_error error = {0};
    for (int processor = 0; processor < 2; processor++) {
        const lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .technique = "cone",
                                          .samples = 1, .temporal = true};
        world w = begin_world(params, "network", processor ? "auto" : "gl");
        const lsf_view views[2] = {
            {.position = {2.5, 2.0, 3.5},
             .forward = {-0.6f, -0.3f, -0.8f},
             .up = {0, 1, 0},
             .fov_y = 50},
            {.position = {2.5, 2.0, 3.5},
             .forward = {-0.5f, -0.3f, -0.8f},
             .up = {0, 1, 0},
             .fov_y = 50},
        };
        /* The second view alone; after the first; after a cut; and again, where nothing has
         * changed, from the same state as the frame before it. */
        for (int i = 0; i < 4; i++) {
            if (i == 1) {
                const lsf_frame before = {.view = &views[0], .cut = true};
                assert_true(lsf_renderer_begin_frame(w.renderer, &before, &error));
                read_pixels(&w, frames[1]);
            }
            const lsf_frame frame = {.view = &views[1], .cut = i == 0 || i == 2};
            assert_true(lsf_renderer_begin_frame(w.renderer, &frame, &error));
            read_pixels(&w, frames[i]);
        }
        assert_true(apart(frames[1], frames[0]) > 1e-3);
        assert_memory_equal(frames[2], frames[0], sizeof frames[0]);
        end_world(&w);
        lsf_render_params two = params;
        two.samples = 2;
        world other = begin_world(two, "network", processor ? "auto" : "gl");
        const lsf_frame frame = {.view = &views[1], .cut = true};
        assert_true(lsf_renderer_begin_frame(other.renderer, &frame, &error));
        read_pixels(&other, frames[0]);
        assert_memory_equal(frames[0], frames[3], sizeof frames[0]);
        end_world(&other);
    }
}

/* A file of weights that is not there or not one is named, before anything is rendered; and where
 * nothing is filtered, none is asked for. */
static void bad_weights_are_named(void **unused)
{
    (void)unused;
    static const char *const paths[] = {"/nowhere/at/all.lsfd", "/proc/self/exe"};
    const char *const options[] = {"light_filter.kind=network"};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .options = options, .option_count = 1};
    lsf_scene *scene = build_scene();
    build_corner(scene);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
    finish_gl_scene(scene);
    for (size_t i = 0; i < LSF_COUNT(paths); i++) {
        lsf_error error = {0};
        setenv(weights, paths[i], 1);
        params.raw = false;
        assert_null(lsf_plan_create(scene, &params, &error));
        assert_int_equal(error.code, LSF_ERROR_FILE);
        assert_non_null(strstr(error.message, paths[i]));
        params.raw = true;
        lsf_plan *plan = lsf_plan_create(scene, &params, &error);
        assert_non_null(plan);
        assert_null(lsf_plan_find_pass(plan, "denoise"));
        lsf_plan_destroy(plan);
    }
    setenv(weights, weights_path, 1);
    lsf_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_technique_is_denoised),
        cmocka_unit_test(it_vanishes_with_the_noise),
        cmocka_unit_test(state_is_kept_and_cut),
        cmocka_unit_test(bad_weights_are_named),
    };
    return cmocka_run_group_tests(tests, write_weights, remove_weights);
}
