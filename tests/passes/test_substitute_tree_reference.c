/* The tree of lights against the path tracer, bounce by bounce: what the cloud carries. */
#include <math.h>

#include "base/base.h"
#include "render_gl.h"

enum { SIZE = 32, BOUNCES = 2, SAMPLES = 16, REFERENCE_SAMPLES = 160 };

static const char *const options[] = {"cloud.count=16384", "light_tree.samples=4",
                                      "voxel.resolution=64"};

static lsf_image *render(const lsf_scene *scene, uint32_t bounces, bool reference)
{
    lsf_error error = {0};
    const lsf_render_params params = {
        LSF_RENDER_PARAMS_DEFAULTS,
        .technique = "substitute_tree",
        .raw = true,
        .width = SIZE,
        .height = SIZE,
        .bounces = bounces,
        .aovs = LSF_AOV_EMISSION,
        .samples = reference ? REFERENCE_SAMPLES : SAMPLES,
        .options = options,
        .option_count = LSF_COUNT(options),
    };
    if (!reference)
        return render_gl(gl_test_backend(), scene, &params);
    lsf_image *image = lsf_reference_render(scene, &params, 0, NULL, &error);
    if (!image)
        fail_msg("%s", error.message);
    return image;
}

/* Of light that bounced k times, and of none, where surfaces emit: emission and its direct light.
 */
static void check(const char *name)
{
    char path[4096];
    lsf_error error = {0};
    lsf_scene_params loading = {LSF_SCENE_PARAMS_DEFAULTS};
    snprintf(path, sizeof path, "%s/data/scenes/%s.gltf", getenv("LSF_SOURCE_ROOT"), name);
    lsf_scene *scene = lsf_scene_load(path, &loading, &error);
    if (!scene)
        fail_msg("%s", error.message);
    double before[2][3] = {{0.0}};
    for (uint32_t bounces = 0; bounces <= BOUNCES; bounces++) {
        double added[2][3];
        for (int reference = 0; reference < 2; reference++) {
            lsf_image *image = render(scene, bounces, reference);
            double mean[3], emission[3];
            mean_rgb(image, 0, mean);
            mean_rgb(image, 3, emission);
            for (int c = 0; c < 3; c++) {
                added[reference][c] = mean[c] - emission[c] - before[reference][c];
                before[reference][c] = mean[c] - emission[c];
            }
            lsf_image_destroy(image);
        }
        for (int c = 0; c < 3; c++) {
            print_message("%s, bounce %u: %.5f, expected %.5f\n", name, bounces, added[0][c],
                          added[1][c]);
            /* Of the whole: the parts are differences of pictures with noise of their own. */
            assert_true(fabs(added[0][c] - added[1][c]) <= 0.02 * before[1][c]);
        }
    }
    lsf_scene_destroy(scene);
}

static void bounces_of_the_path_tracer(void **unused)
{
    (void)unused;
    check("cornell_point");
    check("cornell_emissive");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(bounces_of_the_path_tracer)};
    return cmocka_run_group_tests_name("substitute_tree_reference", tests, NULL, NULL);
}
