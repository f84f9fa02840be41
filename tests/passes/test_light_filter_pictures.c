/* The filter of light in pictures: it makes none of them worse. */
#include "base/base.h"
#include "render_gl.h"

static lsf_image *render(const lsf_scene *scene, const char *technique, uint32_t samples, bool raw,
                         int steps)
{
    char option[64];
    snprintf(option, sizeof option, "light_filter.steps=%d", steps);
    const char *options[] = {"voxel.resolution=32", option};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    params.technique = technique;
    params.width = 40;
    params.height = 30;
    params.samples = samples;
    params.seed = raw;
    params.bounces = 1;
    params.raw = raw;
    params.options = options;
    params.option_count = LSF_COUNT(options);
    return render_gl(gl_test_backend(), scene, &params);
}

static double relmse(const lsf_image *image, const lsf_image *truth)
{
    lsf_error error = {0};
    lsf_compare_result result;
    const lsf_compare_params params = {LSF_COMPARE_PARAMS_DEFAULTS};
    if (!lsf_compare(image, truth, &params, &result, &error))
        fail_msg("%s", error.message);
    return result.relmse;
}

/* Against the converged estimator, filtered pictures are no worse than the same ones unfiltered;
 * and the same bits twice. Contact shadows are a pixel wide in pictures this small. */
static void check_scene(const lsf_scene *scene, const char *technique, uint32_t most_samples,
                        uint32_t truth_samples)
{
    lsf_image *truth = render(scene, technique, truth_samples, true, 5);
    for (uint32_t samples = 1; samples <= most_samples; samples *= 4) {
        lsf_image *image = render(scene, technique, samples, false, 5);
        lsf_image *unfiltered = render(scene, technique, samples, false, 0);
        double filtered = relmse(image, truth), before = relmse(unfiltered, truth);
        print_message("%s, %2u iterations: relMSE %.4f of %.4f\n", technique, samples, filtered,
                      before);
        assert_true(filtered <= before);
        if (samples == 4) {
            lsf_image *again = render(scene, technique, samples, false, 5);
            assert_same_pixels(again, image);
            lsf_image_destroy(again);
        }
        lsf_image_destroy(image);
        lsf_image_destroy(unfiltered);
    }
    lsf_image_destroy(truth);
}

static void check_technique(const char *technique, uint32_t most_samples, uint32_t truth_samples)
{
    char path[4096];
    lsf_error error = {0};
    const char *root = getenv("LSF_SOURCE_ROOT");
    snprintf(path, sizeof path, "%s/data/scenes/cornell_glossy.gltf", root ? root : ".");
    lsf_scene_params scene_params = {LSF_SCENE_PARAMS_DEFAULTS};
    lsf_scene *scene = lsf_scene_load(path, &scene_params, &error);
    if (!scene)
        fail_msg("%s", error.message);
    check_scene(scene, technique, most_samples, truth_samples);
    lsf_scene_destroy(scene);
}

/* A sphere that stands on a floor in the open, between two bright patches of a dim sky. All pixels
 * take the same directions of the sky, so that neighbours cannot tell noise from light. */
static lsf_scene *patches_scene(void)
{
    enum { WIDTH = 32, HEIGHT = 16, ROW = 5 };
    lsf_scene *scene = build_scene();
    scene->cameras[0].matrix[14] = 5.0f;
    build_material(scene, 0.7f, 0.6f, 0.4f);
    build_sphere(scene, 3, false);
    build_quad(scene, lsf_f3(-2, -1, 2), lsf_f3(2, -1, 2), lsf_f3(2, -1, -2), lsf_f3(-2, -1, -2));
    float *texels = build_environment_map(scene, WIDTH, HEIGHT);
    for (int row = 0; row < HEIGHT; row++)
        for (int column = 0; column < WIDTH; column++) {
            bool bright = (row == ROW || row == ROW + 1) && column % 16 < 3;
            for (int c = 0; c < 3; c++)
                texels[3 * (row * WIDTH + column) + c] = bright ? 30.0f : 0.1f;
        }
    finish_gl_scene(scene);
    return scene;
}

static void open_sky_is_no_worse(void **unused)
{
    (void)unused;
    lsf_scene *scene = patches_scene();
    check_scene(scene, "voxel_path", 4, 64);
    check_scene(scene, "substitute_tree", 4, 64);
    lsf_scene_destroy(scene);
}

static void bidirectional_is_no_worse(void **unused)
{
    (void)unused;
    check_technique("bidirectional", 4, 64);
}

static void voxel_path_is_no_worse(void **unused)
{
    (void)unused;
    check_technique("voxel_path", 16, 32);
}

static void cone_is_no_worse(void **unused)
{
    (void)unused;
    check_technique("cone", 16, 16);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bidirectional_is_no_worse),
        cmocka_unit_test(voxel_path_is_no_worse),
        cmocka_unit_test(cone_is_no_worse),
        cmocka_unit_test(open_sky_is_no_worse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
