/* VPLs drawn where they light what is seen: the same light on average as those drawn as the light
 * shines, and less noise where most of a sun's light goes elsewhere. */
#include <math.h>

#include "render_gl.h"

/* A small wall on a wide floor. The sun is overhead: what the wall gets comes from the floor. */
#define HALF_FLOOR 20.0f
#define IRRADIANCE 2.0f
#define ALBEDO 0.5f

static lsf_scene *wall_scene(void)
{
    lsf_scene *scene = build_scene();
    build_material(scene, ALBEDO, ALBEDO, ALBEDO)->specular = 0.0f;
    build_floor(scene, 0.0f, HALF_FLOOR);
    build_quad(scene, lsf_f3(-0.5f, 0, 0), lsf_f3(0.5f, 0, 0), lsf_f3(0.5f, 1, 0),
               lsf_f3(-0.5f, 1, 0));
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 5, 0), lsf_f3(0, -1, 0), IRRADIANCE);
    finish_gl_scene(scene);
    return scene;
}

/* Radiance of the wall, a mean over seeds; its relative standard deviation from seed to seed. */
static double wall_radiance(const lsf_scene *scene, const char *pdf, double *deviation)
{
    enum { SEEDS = 8 };
    const char *const options[] = {pdf, "bidirectional.strategy=vpl"};
    double sum = 0.0, squares = 0.0;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        lsf_image *image = render_gl_from(
            scene,
            (lsf_render_params){LSF_RENDER_PARAMS_DEFAULTS, .raw = true, .samples = 16,
                                .bounces = 1, .technique = "bidirectional", .seed = seed,
                                .options = options, .option_count = 2, .fov_y = 10.0f},
            8, lsf_f3(0, 0.5f, 4), lsf_f3(0, 0.5f, 0));
        double rgb[3];
        mean_rgb(image, 0, rgb);
        lsf_image_destroy(image);
        sum += rgb[1];
        squares += rgb[1] * rgb[1];
    }
    double mean = sum / SEEDS;
    *deviation = sqrt(fmax(squares / SEEDS - mean * mean, 0.0) * SEEDS / (SEEDS - 1)) / mean;
    return mean;
}

/* From the height h the edge of the floor, HALF_FLOOR away, is about h / HALF_FLOOR below the
 * horizon: the floor fills that much less than half of what a point of the wall faces. */
static void light_visible_surfaces(void **unused)
{
    (void)unused;
    lsf_scene *scene = wall_scene();
    double deviation[2];
    double uniform = wall_radiance(scene, "rsm.pdf=uniform", &deviation[0]);
    double seen = wall_radiance(scene, "rsm.pdf=auto", &deviation[1]);
    double expected = 0.5 * ALBEDO * ALBEDO * IRRADIANCE / 3.14159265 * (1.0 - 0.5 / HALF_FLOOR);
    print_message("%g and %g (expected %g), from seed to seed %.1f %% and %.1f %%\n", uniform, seen,
                  expected, 100.0 * deviation[0], 100.0 * deviation[1]);
    assert_true(fabs(seen / expected - 1.0) < 0.01 + 3.0 * deviation[1] / sqrt(8.0));
    assert_true(deviation[1] < deviation[0] / 3.0);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(light_visible_surfaces)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
