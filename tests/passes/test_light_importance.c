/* Lights whose light bounces are chosen by what they do in view: the mean is that of the lamp that
 * lights the view, and a sun that reaches nothing of it takes few paths. */
#include <math.h>

#include "passes/light_importance.h"
#include "surface_rig.h"

enum { RUNS = 64 };

/* A closed room with a lamp in it, and a sun outside. */
static lsf_scene *room(float lamp, float sun)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f)->double_sided = true;
    build_box(scene, lsf_f3(-1, -1, -1), lsf_f3(1, 1, 1), true);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0.3f, 0.4f, 0), lsf_f3(0, -1, 0), lamp);
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(-0.4f, -0.8f, -0.3f), sun);
    scene->diffuse_only = true;
    finish_gl_scene(scene);
    return scene;
}

/* Mean light of a picture of the room, over `runs` other seeds, and the deviation of one of them.
 * Returns whether software OpenGL rendered it. */
static bool render_runs(const lsf_scene *scene, uint32_t bounces, uint32_t runs, uint32_t samples,
                        double *mean, double *deviation)
{
    static const char *const options[] = {"bidirectional.strategy=vpl"};
    double sum = 0.0, squares = 0.0;
    lsf_context *context = gl_test_context(gl_test_backend(), NULL); /* keeps compiled programs */
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    const float position[3] = {0, 0, 0.9f}, target[3] = {0, 0, -1};
    params.technique = "bidirectional";
    params.width = params.height = 8;
    params.samples = samples;
    params.bounces = bounces;
    params.camera_position = position;
    params.camera_target = target;
    params.options = options;
    params.option_count = 1;
    for (uint32_t run = 0; run < runs; run++) {
        params.seed = run + 1;
        lsf_image *image = render_gl_in(context, scene, &params);
        double rgb[3];
        mean_rgb(image, 0, rgb);
        sum += rgb[1] / runs;
        squares += rgb[1] * rgb[1] / runs;
        lsf_image_destroy(image);
    }
    bool software = lsf_context_get_info(context).software;
    lsf_context_destroy(context);
    *mean = sum;
    *deviation = sqrt(fmax(squares - sum * sum, 0.0));
    return software;
}

/* By power and evenly the lamp has a quarter of the paths: one path a picture, worth four times as
 * much or nothing, deviates by sqrt(3) of its mean. With five eighths of them it deviates by
 * sqrt(3/5), and by what VPLs differ. */
static void hidden_sun_takes_few_paths(void **unused)
{
    (void)unused;
    double direct, expected, unused_deviation, mean, deviation;
    lsf_scene *lamp_alone = room(5.0f, 0.0f), *both = room(5.0f, 100.0f);
    render_runs(lamp_alone, 0, 1, 64, &direct, &unused_deviation);
    render_runs(lamp_alone, 1, 1, 1024, &expected, &unused_deviation);
    bool software = render_runs(both, 1, RUNS, 1, &mean, &deviation);
    double relative = deviation / (expected - direct);
    print_message("light that bounces %.4f, expected %.4f, deviation of one path %.2f of it\n",
                  mean - direct, expected - direct, relative);
    assert_true(fabs(mean - expected) < 4.0 * deviation / sqrt(RUNS));
    assert_true(!software || relative < 1.2); /* a GPU knows from the third iteration on */
    destroy_scene(lamp_alone);
    destroy_scene(both);
}

/* A light over all of a picture whose cells are 2 x 2 pixels, then one over its right half, and the
 * next iteration, which measures nothing. */
static void sums_of_known_lights(void **unused)
{
    (void)unused;
    enum { SIDE = 64, CELLS = 32 * 32 };
    static float texels[SIDE * SIDE][4];
    surface_rig rig;
    lsf_light_importance pass = {0};
    lsf_error error = {0};
    surface_rig_begin(&rig, SIDE, SIDE, false);
    lsf_light_importance_plan(rig.setup.plan, 2);
    surface_rig_start(&rig);
    if (!lsf_light_importance_create(&pass, rig.context, rig.setup.plan, &error))
        fail_msg("%s", error.message);
    GLuint radiance = surface_rig_texture(&rig, GL_RGBA32F, SIDE, SIDE);
    for (uint32_t light = 0; light < 2; light++) {
        for (int i = 0; i < SIDE * SIDE; i++)
            for (int c = 0; c < 3; c++)
                texels[i][c] = light == 1 && i % SIDE >= SIDE / 2 ? 3.5f : 0.5f;
        surface_rig_write(radiance, SIDE, SIDE, texels[0]);
        lsf_light_importance_run(&pass, &rig.iteration, light, radiance);
    }
    const float *sums = lsf_light_importance_read(&pass, &rig.iteration);
    bool software = lsf_context_get_info(rig.context).software;
    assert_true(software == (sums != NULL));
    for (rig.iteration.done = 1; rig.iteration.done <= 2; rig.iteration.done++) {
        lsf_light_importance_run(&pass, &rig.iteration, 0, radiance);
        sums = lsf_light_importance_read(&pass, &rig.iteration);
    }
    assert_non_null(sums); /* on a GPU, too */
    assert_float_equal(sums[0], 0.5f * CELLS, 1e-3f * CELLS);
    assert_float_equal(sums[1], 3.0f * CELLS / 2, 1e-3f * CELLS);
    lsf_light_importance_destroy(&pass);
    lsf_texture_destroy(rig.context, &radiance);
    surface_rig_end(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_of_known_lights),
        cmocka_unit_test(hidden_sun_takes_few_paths),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
