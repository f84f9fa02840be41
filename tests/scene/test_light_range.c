/* Light that floats cannot carry is refused, or left out, with a word. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/light_range.h"

#include "build_scene.h"

static void drop_notes(lsf_scene *scene)
{
    for (uint32_t i = 0; i < scene->note_count; i++)
        free(scene->notes[i]);
    free(scene->notes);
}

/* A floor of half width `size` and one light. */
static lsf_scene *lit_floor(float size, lsf_light_type type, float intensity)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 1, 1, 1);
    build_floor(scene, 0.0f, size);
    build_light(scene, type, lsf_f3(0, size, 0), lsf_f3(0, -1, 0), intensity);
    finish_scene(scene);
    lsf_scene_compute_requirements(scene);
    return scene;
}

/* Whether a light is kept (1), left out (0) or refused (-1); a note or an error names it. */
static int judge_light(float size, lsf_light_type type, float intensity)
{
    lsf_scene *scene = lit_floor(size, type, intensity);
    lsf_error error = {0};
    bool good = lsf_bound_lights(scene, &error);
    bool left_out = scene->lights[0].intensity[0] == 0.0f;
    assert_int_equal(scene->note_count, good && left_out);
    if (!good) {
        assert_int_equal(error.code, LSF_ERROR_FILE);
        assert_non_null(strstr(error.message, scene->lights[0].name));
    }
    drop_notes(scene);
    destroy_scene(scene);
    return good ? !left_out : -1;
}

static void lights(void **unused)
{
    (void)unused;
    static const lsf_light_type types[] = {LSF_LIGHT_POINT, LSF_LIGHT_SPOT, LSF_LIGHT_DIRECTIONAL};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(judge_light(1.0f, types[i], 1e23f), 1);
        assert_int_equal(judge_light(1.0f, types[i], 3.4e38f), -1);
        assert_int_equal(judge_light(1.0f, types[i], 1e-23f), 1);
        assert_int_equal(judge_light(1.0f, types[i], 1e-40f), 0);
    }
    /* What reaches a surface goes by the square of lengths; of a sun by none. */
    assert_int_equal(judge_light(0x1p-10f, LSF_LIGHT_POINT, 1e23f), -1);
    assert_int_equal(judge_light(0x1p-10f, LSF_LIGHT_DIRECTIONAL, 1e23f), 1);
    assert_int_equal(judge_light(0x1p10f, LSF_LIGHT_POINT, 1e25f), 1);
    assert_int_equal(judge_light(0x1p10f, LSF_LIGHT_POINT, 1e-23f), 0);
}

static int judge_radiance(float emission, float sky, const float *texel)
{
    lsf_scene *scene = lit_floor(1.0f, LSF_LIGHT_POINT, 1.0f);
    scene->materials[0].emission[1] = emission;
    build_environment(scene, sky);
    if (texel) {
        scene->environment.width = scene->environment.height = 1;
        scene->environment.texels = calloc(3, sizeof(float));
        memcpy(scene->environment.texels, texel, 3 * sizeof(float));
    }
    lsf_error error = {0};
    bool good = lsf_bound_radiance(scene, &error);
    bool left_out = scene->note_count > 0;
    assert_true(good || error.code == LSF_ERROR_FILE);
    drop_notes(scene);
    destroy_scene(scene);
    return good ? !left_out : -1;
}

static void radiance(void **unused)
{
    (void)unused;
    static const float bright[3] = {0, 0, 1e30f}, fine[3] = {1e4f, 0, 1e-42f};
    assert_int_equal(judge_radiance(1.0f, 1.0f, NULL), 1);
    assert_int_equal(judge_radiance(0.0f, 0.0f, NULL), 1);
    assert_int_equal(judge_radiance(1e-40f, 1.0f, NULL), 0);
    assert_int_equal(judge_radiance(1e30f, 1.0f, NULL), -1);
    assert_int_equal(judge_radiance(1.0f, 1e-40f, NULL), 0);
    assert_int_equal(judge_radiance(1.0f, 1e30f, NULL), -1);
    assert_int_equal(judge_radiance(1.0f, 0.0f, fine), 1);
    assert_int_equal(judge_radiance(1.0f, 0.0f, bright), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights),
        cmocka_unit_test(radiance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
