/* What is measured by itself: options that exist, and values that a plan takes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/base.h"
#include "sweep/grid.h"
#include "tools/measure_presets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void check(int preset, bool answers, const lsf_scene *scene)
{
    lsf_error error;
    lsf_settings settings = {
        .measure_preset = preset, .budget_ms = answers ? 1.0 : NAN, .error = NAN};
    lsf_measurement m = {0};
    assert_true(lsf_measure_fill_in(&settings, &error));
    assert_true(settings.samples > 0 && settings.seeds > 1 && settings.reference_samples > 0);
    if (!lsf_sweep_grid_add(&m, settings.techniques.items, settings.techniques.count,
                            settings.sweeps.items, settings.sweeps.count, &error))
        fail_msg("%s", error.message);
    uint32_t techniques = 0;
    while (lsf_technique_name(techniques))
        techniques++;
    print_message("preset %d: %u configurations\n", preset, m.configuration_count);
    assert_int_equal(settings.techniques.count, techniques);
    assert_true(m.configuration_count > techniques && m.configuration_count <= 500);
    for (uint32_t c = 0; c < m.configuration_count; c++) {
        lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
        params.technique = m.configurations[c].technique;
        params.options = (const char *const *)m.configurations[c].options;
        params.option_count = m.configurations[c].option_count;
        lsf_plan *plan = lsf_plan_create(scene, &params, &error);
        if (!plan)
            fail_msg("%s", error.message);
        lsf_plan_destroy(plan);
    }
    free((void *)settings.techniques.items);
    free((void *)settings.sweeps.items);
    lsf_measurement_finish(&m);
}

static void test_presets(void **state)
{
    (void)state;
    char *path = lsf_format("%s/data/scenes/cornell_point.gltf", getenv("LSF_SOURCE_ROOT"));
    lsf_scene *scene = lsf_scene_load(path, NULL, NULL);
    assert_non_null(scene);
    for (int preset = 0; preset < 2; preset++) {
        check(preset, false, scene);
        check(preset, true, scene);
    }
    lsf_scene_destroy(scene);
    free(path);
}

/* An option that was given is not swept beside. */
static void test_defines_hold(void **state)
{
    (void)state;
    lsf_error error;
    const char *defines[] = {"voxel.resolution=32"};
    lsf_settings settings = {.defines = {defines, 1, 1}, .budget_ms = NAN, .error = NAN};
    assert_true(lsf_measure_fill_in(&settings, &error));
    assert_int_equal(settings.sweeps.count, 0);
    free((void *)settings.techniques.items);
    settings = (lsf_settings){.defines = {defines, 1, 1}, .budget_ms = 1.0, .error = NAN};
    assert_true(lsf_measure_fill_in(&settings, &error));
    for (uint32_t i = 0; i < settings.sweeps.count; i++)
        assert_null(strstr(settings.sweeps.items[i], "voxel.resolution"));
    assert_true(settings.sweeps.count > 0);
    free((void *)settings.techniques.items);
    free((void *)settings.sweeps.items);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_presets),
                                       cmocka_unit_test(test_defines_hold)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
