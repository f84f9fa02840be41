/* Several sample points of a pixel in an iteration: the same picture on average, with each
 * technique that gathers light in a way of its own, and less noise on edges. */
#include <math.h>
#include <string.h>

#include "base/base.h"
#include "plan/plan.h"
#include "render_gl.h"

enum { SIZE = 8, PIXELS = SIZE * SIZE, RUNS = 16 };

static const char *const sides[3] = {"gbuffer.side=1", "gbuffer.side=2", "gbuffer.side=4"};

/* A wall that glows, left of a slanted edge, before nothing. */
static lsf_scene *build_edge(void)
{
    lsf_scene *scene = build_scene();
    lsf_camera *camera = &scene->cameras[0];
    camera->orthographic = true;
    camera->x_magnification = camera->y_magnification = 1;
    camera->matrix[14] = 2;
    build_material(scene, 0.5f, 0.25f, 0.125f)->emission[0] = 1.0f;
    build_quad(scene, lsf_f3(-9, -9, 0), lsf_f3(-2.97f, -9, 0), lsf_f3(3.03f, 9, 0),
               lsf_f3(-9, 9, 0));
    finish_gl_scene(scene);
    return scene;
}

static lsf_image *render_side(lsf_context *context, const lsf_scene *scene,
                              lsf_render_params params, const char *side)
{
    const char *const options[] = {side, "voxel.resolution=32", "shadow.texels_per_pixel=64"};
    params.options = options;
    params.option_count = 3;
    params.width = params.height = SIZE;
    return render_gl_in(context, scene, &params);
}

/* How much of each pixel lies left of the edge, x < (y + 9) / 3 - 2.97 in a picture from -1 to 1.
 */
static double coverage(uint32_t pixel)
{
    enum { FINE = 256 };
    double sum = 0.0;
    for (uint32_t i = 0; i < FINE; i++) {
        double y = 1.0 - 2.0 * (pixel / SIZE + (i + 0.5) / FINE) / SIZE;
        double edge = ((y + 9.0) / 3.0 - 2.97 + 1.0) / 2.0 * SIZE - pixel % SIZE;
        sum += fmin(fmax(edge, 0.0), 1.0) / FINE;
    }
    return sum;
}

/* Of n x n points one lies in each part of a pixel, and an edge passes through n parts or so, of
 * which each is told by chance: the error falls as n^-1.5. Layers hold the same mean. */
static void edges(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_edge();
    double error[3] = {0.0};
    lsf_context *context = gl_test_context(LSF_BACKEND_AUTO, NULL);
    for (int i = 0; i < 3; i++)
        for (uint32_t run = 0; run < RUNS; run++) {
            lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true, .samples = 1};
            params.technique = "direct";
            params.seed = run;
            params.aovs = LSF_AOV_ALBEDO | LSF_AOV_DEPTH;
            lsf_image *image = render_side(context, scene, params, sides[i]);
            int albedo = lsf_image_channel(image, "albedo.R");
            int depth = lsf_image_channel(image, "depth.Z");
            assert_true(albedo > 0 && depth > 0);
            for (uint32_t pixel = 0; pixel < PIXELS; pixel++) {
                const float *values = &image->pixels[pixel * image->channel_count];
                double apart = (double)values[0] - coverage(pixel);
                error[i] += apart * apart;
                assert_true(fabs((double)values[albedo] - 0.5 * (double)values[0]) <= 1e-4);
                assert_true(isinf(values[depth]) || fabs((double)values[depth] - 2.0) <= 1e-4);
            }
            lsf_image_destroy(image);
        }
    print_message("RMS error of edges: %.4f, %.4f and %.4f\n", sqrt(error[0] / (RUNS * PIXELS)),
                  sqrt(error[1] / (RUNS * PIXELS)), sqrt(error[2] / (RUNS * PIXELS)));
    assert_true(error[1] <= error[0] / 3.0);
    assert_true(error[2] <= error[0] / 12.0);
    lsf_context_destroy(context);
    destroy_scene(scene);
}

/* A box on a floor beside a coloured wall, glossy, under a sky. */
static lsf_scene *build_room(void)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.7f, 0.7f, 0.7f)->roughness = 0.5f;
    build_floor(scene, 0.0f, 3.0f);
    build_box(scene, lsf_f3(-0.5f, 0, -0.5f), lsf_f3(0.3f, 0.8f, 0.3f), false);
    build_material(scene, 0.9f, 0.2f, 0.1f);
    build_quad(scene, lsf_f3(1, 0, -2), lsf_f3(1, 0, 2), lsf_f3(1, 2, 2), lsf_f3(1, 2, -2));
    build_environment(scene, 1.0f);
    finish_gl_scene(scene);
    return scene;
}

/* Means over runs of the pictures' left and right halves. */
static void render_runs(const lsf_scene *scene, lsf_render_params params, const char *side,
                        double mean[2], double error[2])
{
    double squares[2] = {0.0};
    lsf_context *context = gl_test_context(LSF_BACKEND_AUTO, NULL); /* keeps compiled programs */
    memset(mean, 0, 2 * sizeof *mean);
    for (uint32_t run = 0; run < RUNS; run++) {
        double sums[2] = {0.0};
        params.seed = run + 1;
        lsf_image *image = render_side(context, scene, params, side);
        for (uint32_t i = 0; i < PIXELS * 3; i++)
            sums[i / 3 % SIZE * 2 / SIZE] +=
                (double)image->pixels[i / 3 * image->channel_count + i % 3] / PIXELS;
        for (int half = 0; half < 2; half++) {
            mean[half] += sums[half] / RUNS;
            squares[half] += sums[half] * sums[half];
        }
        lsf_image_destroy(image);
    }
    lsf_context_destroy(context);
    for (int half = 0; half < 2; half++)
        error[half] =
            sqrt((squares[half] - RUNS * mean[half] * mean[half]) / (RUNS * (RUNS - 1.0)));
}

static void same_light(const char *technique)
{
    lsf_scene *scene = build_room();
    const float eye[3] = {-1.5f, 1.6f, 2.2f}, target[3] = {0.2f, 0.4f, 0.0f};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true, .samples = 4,
                                .bounces = 1};
    params.technique = technique;
    params.camera_position = eye;
    params.camera_target = target;
    double one[2], several[2], one_error[2], several_error[2];
    render_runs(scene, params, sides[0], one, one_error);
    render_runs(scene, params, sides[1], several, several_error);
    for (int half = 0; half < 2; half++) {
        double off = (several[half] - one[half]) / hypot(one_error[half], several_error[half]);
        print_message("%s, half %d: %.4f and %.4f, off by %.1f standard errors\n", technique, half,
                      one[half], several[half], off);
        assert_true(fabs(off) <= 4.0);
        assert_true(hypot(one_error[half], several_error[half]) <= 0.06 * one[half]);
    }
    destroy_scene(scene);
}

static void by_bundles(void **unused)
{
    (void)unused;
    same_light("bidirectional");
}

static void by_paths(void **unused)
{
    (void)unused;
    same_light("voxel_path");
}

/* More of them where the environment's maps draw more triangles than there are points, after few
 * iterations, and where pixels trace light in a limited time; elsewhere, in a window's moving
 * frames, and where the mean alone is asked for, one. */
static void where_they_pay(void **unused)
{
    (void)unused;
    static const struct {
        const char *technique;
        uint32_t width, samples, side;
        bool environment, raw, temporal, moves, limited;
    } cases[] = {{"bidirectional", 16, 16, 4, .environment = true},
                 {"bidirectional", 32, 16, 2, .environment = true},
                 {"bidirectional", 64, 16, 1, .environment = true},
                 {"bidirectional", 16, 16, 1, .environment = true, .raw = true},
                 {"bidirectional", 16, 16, 4, .environment = true, .temporal = true},
                 {"bidirectional", 16, 16, 1, .environment = true, .moves = true},
                 {"bidirectional", 16, 16, 1, .environment = false},
                 {"bidirectional", 16, 2, 2, .environment = false},
                 {"bidirectional", 16, 2, 1, .raw = true},
                 {"bidirectional", 16, 2, 2, .temporal = true},
                 {"bidirectional", 16, 2, 1, .moves = true},
                 {"bidirectional", 1025, 2, 1, .environment = false},
                 {"direct", 16, 2, 1, .environment = false},
                 {"cone", 16, 8, 2, .environment = false},
                 {"cone", 16, 9, 1, .environment = false},
                 {"cone", 16, 9, 2, .limited = true},
                 {"voxel_path", 16, 9, 2, .limited = true},
                 {"bidirectional", 16, 2, 1, .limited = true}};
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_error error = {0};
        lsf_scene *scene = build_scene();
        build_material(scene, 1, 1, 1);
        build_sphere(scene, 3, false); /* 1,280 triangles, 10,240 in 8 maps */
        build_light(scene, LSF_LIGHT_POINT, lsf_f3(0, 2, 0), lsf_f3(0, -1, 0), 1.0f);
        if (cases[i].environment)
            build_environment(scene, 1.0f);
        finish_gl_scene(scene);
        lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = cases[i].raw,
                                    .temporal = cases[i].temporal || cases[i].moves,
                                    .present = cases[i].moves};
        params.technique = cases[i].technique;
        params.samples = cases[i].samples;
        if (cases[i].limited)
            params.time_limit = 1.0;
        params.width = params.height = cases[i].width;
        lsf_plan *plan = lsf_plan_create(scene, &params, &error);
        if (!plan)
            fail_msg("%s", error.message);
        bool told = false;
        for (uint64_t r = 0; r < plan->remark_count; r++)
            told |= strstr(plan->remarks[r], "gbuffer.side") != NULL;
        assert_int_equal(plan->pixel_side, cases[i].side);
        assert_int_equal(told, cases[i].side > 1);
        assert_int_equal(lsf_plan_find_pass(plan, "sparse_spread") != NULL, cases[i].side > 1);
        lsf_plan_destroy(plan);
        destroy_scene(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges),
        cmocka_unit_test(by_bundles),
        cmocka_unit_test(by_paths),
        cmocka_unit_test(where_they_pay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
