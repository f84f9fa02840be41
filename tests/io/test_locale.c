/* A program may run in a locale with a decimal comma; JSON and options keep their point. */
#include "gltf_folder.h"

#include <lightsheaf/lightsheaf.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <locale.h>

/* Made for the test, as few machines have one; false where its sources are missing. */
static bool set_comma_locale(void)
{
    char *command = lsf_format("localedef --no-archive -i de_DE -f UTF-8 '%s/de_DE.UTF-8' "
                               ">'%s/localedef.log' 2>&1",
                               gltf_folder, gltf_folder);
    int status = system(command);
    free(command);
    setenv("LOCPATH", gltf_folder, 1);
    return status == 0 && setlocale(LC_ALL, "de_DE.UTF-8") && localeconv()->decimal_point[0] == ',';
}

typedef struct texts {
    char *scene, *plan;
} texts;

static texts describe(void)
{
    char *path = lsf_format("%s/instances.gltf", gltf_folder);
    lsf_error error = {0};
    lsf_scene *scene = lsf_scene_load(path, NULL, &error);
    free(path);
    if (!scene)
        fail_msg("%s", error.message);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    const char *const options[] = {"shadow.texels_per_pixel=1.5"};
    params.technique = "direct";
    params.options = options;
    params.option_count = 1;
    lsf_plan *plan = lsf_plan_create(scene, &params, &error);
    if (!plan)
        fail_msg("%s", error.message);
    texts found = {lsf_scene_describe(scene, true), lsf_plan_describe(plan, true)};
    lsf_plan_destroy(plan);
    lsf_scene_destroy(scene);
    return found;
}

static void test_a_comma_changes_nothing(void **state)
{
    (void)state;
    texts plain = describe();
    assert_non_null(strstr(plain.scene, "0.5"));
    if (!set_comma_locale())
        skip();
    texts comma = describe();
    setlocale(LC_ALL, "C");
    assert_string_equal(comma.scene, plain.scene);
    assert_string_equal(comma.plan, plain.plan);
    free(plain.scene);
    free(plain.plan);
    free(comma.scene);
    free(comma.plan);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_comma_changes_nothing),
    };
    return cmocka_run_group_tests(tests, make_gltf_folder, remove_gltf_folder);
}
