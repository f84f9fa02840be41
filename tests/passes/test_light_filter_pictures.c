/* The filter of light in pictures: it makes none of them worse. */
#include "base/base.h"
#include "render_gl.h"

static lsf_image *render_room(const lsf_scene *scene, const char *technique, uint32_t samples,
                              bool raw, int steps)
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
    return render_gl(LSF_BACKEND_OSMESA, scene, &params);
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
    lsf_image *truth = render_room(scene, technique, truth_samples, true, 5);
    for (uint32_t samples = 1; samples <= most_samples; samples *= 4) {
        lsf_image *image = render_room(scene, technique, samples, false, 5);
        lsf_image *unfiltered = render_room(scene, technique, samples, false, 0);
        double filtered = relmse(image, truth), before = relmse(unfiltered, truth);
        print_message("%s, %2u iterations: relMSE %.4f of %.4f\n", technique, samples, filtered,
                      before);
        assert_true(filtered <= before);
        if (samples == 4) {
            lsf_image *again = render_room(scene, technique, samples, false, 5);
            assert_same_pixels(again, image);
            lsf_image_destroy(again);
        }
        lsf_image_destroy(image);
        lsf_image_destroy(unfiltered);
    }
    lsf_image_destroy(truth);
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
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
