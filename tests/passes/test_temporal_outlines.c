/* What frames keep of a box in a room, on the walls that the camera sees past it. */
#include <math.h>

#include "../scene/rebuild.h"
#include "base/base.h"
#include "render_gl.h"

enum { WIDTH = 80, HEIGHT = 60, VALUES = WIDTH * HEIGHT * 3, LAST = 3, SAMPLES = 8 };

/* A camera on its way around the room, by so many degrees. */
static lsf_view view_turned(double degrees)
{
    double turn = degrees * M_PI / 180.0;
    return (lsf_view){.position = {3.9 * sin(turn), 1.0, 3.9 * cos(turn)},
                      .forward = {(float)-sin(turn), 0.0f, (float)-cos(turn)},
                      .up = {0, 1, 0},
                      .fov_y = 39.0f};
}

static lsf_renderer *begin(lsf_context *context, const lsf_scene *scene, const char *points,
                           bool temporal, uint32_t samples)
{
    const char *const options[] = {points, "voxel.resolution=64"};
    const lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS,
                                      .technique = "cone",
                                      .width = WIDTH,
                                      .height = HEIGHT,
                                      .samples = samples,
                                      .temporal = temporal,
                                      .options = options,
                                      .option_count = LSF_COUNT(options)};
    lsf_error error = {0};
    lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    return renderer;
}

static void run_frame(lsf_renderer *renderer, const lsf_view *view, float pixels[VALUES])
{
    lsf_error error = {0};
    if (!lsf_renderer_begin_frame(renderer, &(lsf_frame){.view = view}, &error) ||
        !lsf_renderer_run(renderer, &error) ||
        !lsf_renderer_read_into(renderer, 0, pixels, WIDTH * 3 * sizeof(float), &error))
        fail_msg("%s", error.message);
}

/* A frame without history. */
static void run_alone(lsf_context *context, const lsf_scene *scene, const char *points,
                      uint32_t samples, const lsf_view *view, float pixels[VALUES])
{
    lsf_renderer *renderer = begin(context, scene, points, false, samples);
    run_frame(renderer, view, pixels);
    lsf_renderer_destroy(renderer);
}

/* Largest error, relative to the mean, of pixels that look like their eight neighbours in truth. */
static double worst_of_smooth(const float *pixels, const float *truth)
{
    double worst = 0.0, mean = 0.0;
    for (int i = 0; i < VALUES; i++)
        mean += (double)truth[i] / VALUES;
    for (int y = 1; y < HEIGHT - 1; y++)
        for (int x = 1; x < WIDTH - 1; x++) {
            double apart = 0.0, off = 0.0;
            for (int c = 0; c < 3; c++) {
                int i = 3 * (y * WIDTH + x) + c;
                off = fmax(off, fabs((double)pixels[i] - (double)truth[i]));
                for (int k = 0; k < 9; k++) {
                    int at = i + 3 * ((k / 3 - 1) * WIDTH + k % 3 - 1);
                    apart = fmax(apart, fabs((double)truth[at] - (double)truth[i]));
                }
            }
            if (apart < 0.05 * mean)
                worst = fmax(worst, off / mean);
        }
    return worst;
}

static void outlines_are_forgotten(void **unused)
{
    (void)unused;
    static const char *const sides[] = {"gbuffer.side=1", "gbuffer.side=2"};
    lsf_scene *scene = load_default_scene("cornell_point.gltf");
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    float kept[VALUES], single[VALUES], truth[VALUES];
    lsf_view view = view_turned(4.0 * LAST);
    run_alone(context, scene, "gbuffer.side=1", 32, &view, truth);
    for (size_t s = 0; s < LSF_COUNT(sides); s++) {
        lsf_renderer *renderer = begin(context, scene, sides[s], true, SAMPLES);
        for (int k = 0; k <= LAST; k++) {
            view = view_turned(4.0 * k);
            run_frame(renderer, &view, kept);
        }
        lsf_renderer_destroy(renderer);
        run_alone(context, scene, sides[s], SAMPLES, &view, single);
        double with = worst_of_smooth(kept, truth), without = worst_of_smooth(single, truth);
        print_message("%s: %.1f %% of the mean off at most, single frames %.1f %%\n", sides[s],
                      100.0 * with, 100.0 * without);
        assert_true(with < 1.3 * without); /* 2.1, with one point, where outlines stay */
    }
    gl_test_check(context);
    lsf_context_destroy(context);
    lsf_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(outlines_are_forgotten)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
