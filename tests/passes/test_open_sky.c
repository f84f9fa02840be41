/* Directions of the environment that count on its light without shadows: the same light on average
 * whatever they count on, and less noise where little is in the way. */
#include <math.h>

#include "base/base.h"
#include "render_gl.h"
#include "shared/brdf.h"

/* What a light without shadows is counted on for. */
enum { NOTHING, SHARE, WHOLE, CONTROLS };

static const char *const control_options[CONTROLS] = {
    "environment.open=0", "environment.control=share", "environment.control=whole"};
static const char *const control_names[CONTROLS] = {"nothing", "share", "whole"};

enum { RUNS = 64 };

/* Mean over runs of other seeds, and the deviation of one of them. */
typedef struct spread {
    double mean, deviation;
} spread;

/* The radiance at the picture's middle. */
static spread render_runs(const lsf_scene *scene, const char *const options[3], uint32_t samples,
                          lsf_float3 eye, lsf_float3 target)
{
    double values[RUNS], sum = 0.0, squares = 0.0;
    lsf_context *context = gl_test_context(gl_test_backend(), NULL); /* keeps compiled programs */
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "direct";
    params.width = params.height = 2;
    params.samples = samples;
    params.fov_y = 0.01f;
    const float position[3] = {eye.x, eye.y, eye.z}, at[3] = {target.x, target.y, target.z};
    params.camera_position = position;
    params.camera_target = at;
    params.options = options;
    params.option_count = 3;
    for (uint32_t run = 0; run < RUNS; run++) {
        params.seed = run + 1;
        lsf_image *image = render_gl_in(context, scene, &params);
        values[run] = (double)image->pixels[0];
        sum += values[run] / RUNS;
        lsf_image_destroy(image);
    }
    lsf_context_destroy(context);
    for (uint32_t run = 0; run < RUNS; run++)
        squares += (values[run] - sum) * (values[run] - sum) / (RUNS - 1);
    return (spread){sum, sqrt(squares)};
}

/* How much of what a point sees, by the cosine, a parallel square covers whose middle is `height`
 * above it: four times the form factor of a quarter (Howell, "A Catalog of Radiation Heat Transfer
 * Configuration Factors", B-3). */
static double covered(double half_side, double height)
{
    double x = half_side / height, root = sqrt(1.0 + x * x);
    return 4.0 / (2.0 * M_PI) * 2.0 * x / root * atan(x / root);
}

/* The floor below a square, whose half side is 0 where there is none, under a uniform sky; seen
 * from the side. Two iterations of four directions: most of what they count on is told by few. */
static void expect_below(float half_side, double least_gain)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_floor(scene, 0.0f, 4.0f);
    if (half_side > 0.0f)
        build_quad(scene, lsf_f3(-half_side, 1, -half_side), lsf_f3(-half_side, 1, half_side),
                   lsf_f3(half_side, 1, half_side), lsf_f3(half_side, 1, -half_side));
    build_environment(scene, 1.0f);
    scene->diffuse_only = true;
    finish_gl_scene(scene);
    double expected = 0.5 * (1.0 - covered((double)half_side, 1.0)), before = 0.0;
    for (int control = NOTHING; control < CONTROLS; control++) {
        const char *const options[3] = {"environment.directions=4", "shadow.texels_per_pixel=64",
                                        control_options[control]};
        spread s = render_runs(scene, options, 2, lsf_f3(2, 0.7f, 0.1f), lsf_f3(0.01f, 0, 0));
        double off = s.mean - expected, error = s.deviation / sqrt((double)RUNS);
        print_message("square of %.1f, %s: %.4f, expected %.4f, off by %.1f standard errors, "
                      "deviation %.4f\n",
                      2.0 * (double)half_side, control_names[control], s.mean, expected,
                      off / error, s.deviation);
        assert_true(fabs(off) <= 4.0 * error + 1e-4);
        if (control == NOTHING)
            before = s.deviation;
        else if (control == SHARE)
            assert_true(s.deviation * least_gain <= before);
    }
    destroy_scene(scene);
}

static void same_light_on_average(void **unused)
{
    (void)unused;
    expect_below(0.0f, 1.8);
    expect_below(0.5f, 0.75);
    expect_below(2.0f, 0.6); /* five sixths are covered */
}

/* A smooth metal shows the sky's two parts after one iteration, whose few directions would blur
 * them: what it counts on is drawn by its own lobe. */
static void mirror_in_the_open(void **unused)
{
    (void)unused;
    enum { WIDTH = 4, HEIGHT = 64 };
    lsf_scene *scene = build_scene();
    lsf_material *material = build_material(scene, 1, 1, 1);
    material->metallic = 1.0f;
    material->roughness = 0.1f;
    build_floor(scene, 0.0f, 4.0f);
    float *texels = build_environment_map(scene, WIDTH, HEIGHT);
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++)
        texels[i] = i / (3 * WIDTH) < HEIGHT / 4 ? 1.0f : 0.1f; /* bright above 45 degrees */
    finish_gl_scene(scene);
    const double angles[] = {25.0, 65.0}; /* of the view above the horizon, and of its image */
    const double expected[] = {0.1, 1.0};
    for (size_t i = 0; i < LSF_COUNT(angles); i++) {
        double angle = angles[i] * M_PI / 180.0;
        const char *const options[3] = {"environment.directions=8", "environment.open=64",
                                        control_options[WHOLE]};
        spread s = render_runs(scene, options, 1,
                               lsf_f3(3.0f * (float)cos(angle), 3.0f * (float)sin(angle), 0.1f),
                               lsf_f3(0, 0, 0));
        print_message("mirror at %.0f degrees: %.4f, expected %.2f, deviation %.4f\n", angles[i],
                      s.mean, expected[i], s.deviation);
        assert_true(fabs(s.mean / expected[i] - 1.0) <= 0.03);
        assert_true(s.deviation <= 0.03 * expected[i]);
    }
    destroy_scene(scene);
}

/* A square covers half of a rough metal's lobe. The share of specular light is estimated from the
 * directions that use it, too; among many directions the mean must not show it. */
static void lobe_half_covered(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    lsf_material *material = build_material(scene, 1, 1, 1);
    material->metallic = 1.0f;
    material->roughness = 0.6f;
    build_floor(scene, 0.0f, 4.0f);
    build_quad(scene, lsf_f3(-3, 0, 1), lsf_f3(-3, 0, -1), lsf_f3(-1, 2, -1), lsf_f3(-1, 2, 1));
    build_environment(scene, 1.0f);
    finish_gl_scene(scene);
    spread found[CONTROLS];
    for (int control = NOTHING; control < WHOLE; control++) {
        const char *const options[3] = {"environment.directions=16", "environment.open=64",
                                        control_options[control]};
        found[control] = render_runs(scene, options, 32, lsf_f3(2, 1, 0.1f), lsf_f3(0.01f, 0, 0));
        print_message("lobe, %s: %.4f, deviation %.4f\n", control_names[control],
                      found[control].mean, found[control].deviation);
    }
    double error = hypot(found[NOTHING].deviation, found[SHARE].deviation) / sqrt((double)RUNS);
    assert_true(fabs(found[SHARE].mean - found[NOTHING].mean) <=
                4.0 * error + 0.01 * found[NOTHING].mean);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_light_on_average),
        cmocka_unit_test(mirror_in_the_open),
        cmocka_unit_test(lobe_half_covered),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
