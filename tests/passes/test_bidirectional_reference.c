/* The bidirectional technique against the path tracer: every kind of light, one and more bounces.
 */
#include <math.h>

#include "against_reference.h"
#include "base/base.h"

typedef struct test_case {
    const char *name, *folder, *file; /* folder below root_variable's */
    const char *root_variable;
    bool diffuse_only;
    uint32_t bounces, samples;
    double bias_allowed, error_allowed;
} test_case;

static void check(const test_case *test)
{
    char path[4096];
    lsf_error error = {0};
    const char *root = getenv(test->root_variable);
    snprintf(path, sizeof path, "%s/%s/%s.gltf", root ? root : "", test->folder, test->file);
    FILE *file = fopen(path, "r");
    if (!file)
        skip();
    fclose(file);
    lsf_scene_params scene_params = {LSF_SCENE_PARAMS_DEFAULTS};
    scene_params.diffuse_only = test->diffuse_only;
    lsf_scene *scene = lsf_scene_load(path, &scene_params, &error);
    if (!scene)
        fail_msg("%s", error.message);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "bidirectional";
    params.width = params.height = 48;
    params.samples = test->samples;
    params.bounces = test->bounces;
    /* Half of the default along a side: the maps' part of the bias stays below 0.2 %. */
    static const char *const options[] = {"rsm.resolution=128", "vpl.shadow_resolution=128",
                                          "bundle.resolution=128"};
    params.options = options;
    params.option_count = LSF_COUNT(options);
    against_reference pictures = against_reference_render(test->name, scene, &params);
    against_reference_check(test->name, &pictures, "R", INFINITY, test->bias_allowed,
                            test->error_allowed);
    against_reference_destroy(&pictures);
    lsf_scene_destroy(scene);
}

static void point(void **unused)
{
    (void)unused;
    check(&(test_case){"bounce_point", "data/scenes", "cornell_point", "LSF_SOURCE_ROOT", true, 1,
                       256, 0.01, 0.04});
}

static void point_two_bounces(void **unused)
{
    (void)unused;
    check(&(test_case){"bounces_point", "data/scenes", "cornell_point", "LSF_SOURCE_ROOT", true, 2,
                       128, 0.02, 0.04});
}

static void emissive(void **unused)
{
    (void)unused;
    check(&(test_case){"bounce_emissive", "data/scenes", "cornell_emissive", "LSF_SOURCE_ROOT",
                       true, 1, 256, 0.02, 0.08});
}

static void glossy(void **unused)
{
    (void)unused;
    check(&(test_case){"bounce_glossy", "data/scenes", "cornell_glossy", "LSF_SOURCE_ROOT", false,
                       1, 256, 0.02, 0.08});
}

static void sun(void **unused)
{
    (void)unused;
    check(&(test_case){"bounce_sun", "scenes/cornell", "cornell_sun", "LSF_SHARED", true, 1, 256,
                       0.01, 0.04});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(point),    cmocka_unit_test(point_two_bounces),
        cmocka_unit_test(emissive), cmocka_unit_test(glossy),
        cmocka_unit_test(sun),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
