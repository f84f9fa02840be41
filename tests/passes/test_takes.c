/* lsf_technique_takes: options that a technique does not take leave its bits as they are. */
#include "base/base.h"
#include "render_gl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 16, MOST = 256 };

/* Another value than the default one. */
static void other_value(const lsf_option *option, char *text, size_t size)
{
    if (strcmp(option->type, "int") == 0 || strcmp(option->type, "float") == 0) {
        char *end;
        double low = lsf_read_number(option->range, &end), high = lsf_read_number(end + 2, NULL);
        double value = lsf_read_number(option->value, NULL);
        lsf_print(text, size, "%s=%.9g", option->key, value > low ? low : (low + high) / 2.0);
        char *point = strcmp(option->type, "int") == 0 ? strchr(strchr(text, '='), '.') : NULL;
        if (point)
            *point = '\0';
        return;
    }
    for (const char *choice = option->range;; choice++) {
        size_t length = strcspn(choice, "|");
        if (strlen(option->value) != length || strncmp(choice, option->value, length) != 0) {
            lsf_print(text, size, "%s=%.*s", option->key, (int)length, choice);
            return;
        }
        choice += length;
    }
}

static lsf_image *render(const lsf_scene *scene, const char *technique, const char *const *options,
                         uint32_t count)
{
    /* Small maps and grids, where the technique has any. */
    static const char *const small[][2] = {{"voxel.resolution", "voxel.resolution=16"},
                                           {"rsm.resolution", "rsm.resolution=32"},
                                           {"vpl.shadow_resolution", "vpl.shadow_resolution=32"},
                                           {"bundle.resolution", "bundle.resolution=32"},
                                           {"cloud.count", "cloud.count=8192"}};
    const char *all[MOST];
    for (uint32_t i = 0; i < count; i++)
        all[i] = options[i];
    for (size_t i = 0; i < LSF_COUNT(small); i++)
        if (lsf_technique_takes(technique, small[i][0]))
            all[count++] = small[i][1];
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    params.technique = technique;
    params.samples = 2;
    params.options = all;
    params.option_count = count;
    return render_corner(scene, params, SIZE);
}

static void test_what_is_not_taken(void **state)
{
    (void)state;
    static char texts[MOST][64];
    const char *options[MOST];
    bool taken[MOST] = {false};
    lsf_scene *scene = build_scene();
    build_corner(scene);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
    build_environment(scene, 1.0f);
    finish_gl_scene(scene);
    uint32_t known = 0;
    for (uint32_t t = 0; lsf_technique_name(t); t++) {
        const char *technique = lsf_technique_name(t);
        lsf_option option;
        uint32_t count = 0;
        for (known = 0; lsf_option_list(known, &option); known++) {
            assert_true(known < MOST);
            if (lsf_technique_takes(technique, option.key)) {
                taken[known] = true;
                continue;
            }
            other_value(&option, texts[count], sizeof texts[count]);
            options[count] = texts[count];
            count++;
        }
        lsf_image *expected = render(scene, technique, NULL, 0);
        lsf_image *image = render(scene, technique, options, count);
        print_message("%s: %u options are not taken\n", technique, count);
        assert_same_pixels(image, expected);
        lsf_image_destroy(expected);
        lsf_image_destroy(image);
    }
    for (uint32_t i = 0; i < known; i++)
        assert_true(taken[i]); /* by some technique */
    assert_false(lsf_technique_takes("cone", "vpl.count"));
    assert_true(lsf_technique_takes("cone", "voxel.resolution"));
    assert_false(lsf_technique_takes("cone", "voxel.none"));
    assert_false(lsf_technique_takes("none", "voxel.resolution"));
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_what_is_not_taken)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
