/* What a file offers to choose from, and extensions that bring geometry. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define GLTF_SCRIPT "gltf_extension_files.py"
#include "gltf_cases.h"
#include "scene/hierarchy.h"
#include "scene/scene.h"

#include <math.h>

static lsf_scene *load(const char *name, const lsf_scene_params *params)
{
    char *path = lsf_format("%s/%s", gltf_folder, name);
    lsf_error error = {0};
    lsf_scene *scene = lsf_scene_load(path, params, &error);
    if (!scene)
        print_error("%s\n", error.message);
    free(path);
    assert_non_null(scene);
    return scene;
}

/* Where an instance shows a point of its mesh. */
static void assert_point(const lsf_scene *scene, uint32_t instance, double time,
                         const double point[3], const double expected[3])
{
    double *worlds = lsf_alloc(scene->node_count, 16 * sizeof(double));
    assert_non_null(worlds);
    lsf_scene_world_matrices(scene, time, worlds);
    const double *m = worlds + 16 * (size_t)scene->instances[instance].node;
    for (int c = 0; c < 3; c++) {
        double shown = m[c] * point[0] + m[4 + c] * point[1] + m[8 + c] * point[2] + m[12 + c];
        if (!(fabs(shown - expected[c]) < 1e-6))
            fail_msg("instance %u, coordinate %d: %g instead of %g", instance, c, shown,
                     expected[c]);
    }
    free(worlds);
}

#define POINT(x, y, z) ((const double[3]){x, y, z})

static void test_scenes(void **state)
{
    (void)state;
    static const struct {
        const char *scene;
        double x;
    } cases[] = {{NULL, 10}, {"left", 0}, {"0", 10}, {"1", 10}};
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS};
        params.scene = cases[i].scene;
        lsf_scene *scene = load("choices.gltf", &params);
        assert_int_equal(scene->scenes.count, 2);
        assert_int_equal(scene->scenes.items[0].chosen, cases[i].x == 0);
        assert_int_equal(scene->scenes.items[1].chosen, cases[i].x != 0);
        assert_int_equal(scene->instance_count, 1);
        assert_point(scene, 0, 0.0, POINT(0, 0, 0), POINT(cases[i].x, 0, 0));
        lsf_scene_destroy(scene);
    }
}

static void test_animations(void **state)
{
    (void)state;
    static const char *const far[] = {"far"}, *const second[] = {"1"},
                             *const both[] = {"far", "near"};
    static const struct {
        const char *const *names;
        uint32_t count;
        double end[3];
    } cases[] = {
        {NULL, 0, {10, 4, 0}},   {far, 0, {10, 0, 0}},  {far, 1, {10, -2, 0}},
        {second, 1, {10, 0, 8}}, {both, 2, {10, 0, 8}}, /* the first of the file's */
    };
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS};
        params.animations = cases[i].names;
        params.animation_count = cases[i].count;
        lsf_scene *scene = load("choices.gltf", &params);
        assert_int_equal(scene->channel_count, cases[i].names && !cases[i].count ? 0 : 1);
        assert_point(scene, 0, 1.0, POINT(0, 0, 0), cases[i].end);
        lsf_scene_destroy(scene);
    }
}

static void test_variants(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {NULL, "plain"}, {"red", "rouge"}, {"blue", "bleu"}, {"1", "bleu"}};
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS};
        params.variant = cases[i][0];
        lsf_scene *scene = load("choices.gltf", &params);
        assert_string_equal(scene->materials[scene->primitives[0].material].name, cases[i][1]);
        assert_int_equal(scene->material_count, 2); /* only those in use, and the default one */
        lsf_scene_destroy(scene);
    }
}

static void test_choices_that_are_not_there(void **state)
{
    (void)state;
    static const char *const animations[] = {"near", "3"};
    lsf_scene_params params[4] = {{LSF_SCENE_PARAMS_DEFAULTS},
                                  {LSF_SCENE_PARAMS_DEFAULTS},
                                  {LSF_SCENE_PARAMS_DEFAULTS},
                                  {LSF_SCENE_PARAMS_DEFAULTS}};
    params[0].scene = "2";
    params[1].scene = "-1";
    params[2].variant = "green";
    params[3].animations = animations;
    params[3].animation_count = 2;
    static const char *const parts[][2] = {{"scene \"2\"", "0 \"left\", 1 \"0\""},
                                           {"scene \"-1\"", "0 \"left\", 1 \"0\""},
                                           {"variant \"green\"", "0 \"red\", 1 \"blue\""},
                                           {"animation \"3\"", "1 \"near\", 2 \"far\""}};
    char *path = lsf_format("%s/choices.gltf", gltf_folder);
    for (size_t i = 0; i < LSF_COUNT(params); i++) {
        lsf_error error = {0};
        assert_null(lsf_scene_load(path, &params[i], &error));
        assert_int_equal(error.code, LSF_ERROR_USAGE);
        assert_non_null(strstr(error.message, parts[i][0]));
        assert_non_null(strstr(error.message, parts[i][1]));
    }
    free(path);
}

static void test_description_names_what_there_is(void **state)
{
    (void)state;
    lsf_scene *scene = load("choices.gltf", NULL);
    char *json = lsf_scene_describe(scene, true), *text = lsf_scene_describe(scene, false);
    static const char *const json_parts[] = {
        "{\"name\": \"left\", \"chosen\": false}", "{\"name\": \"red\", \"chosen\": false}",
        "{\"name\": \"near\", \"chosen\": true}",
        "{\"name\": \"EXT_nothing\", \"required\": false, \"honoured\": false}",
        "{\"name\": \"KHR_materials_variants\", \"required\": false, \"honoured\": true}"};
    for (size_t i = 0; i < LSF_COUNT(json_parts); i++)
        assert_non_null(strstr(json, json_parts[i]));
    static const char *const text_parts[] = {
        "\"left\"\n", "\"0\", shown\n",         "\"near\", plays\n",
        "\"red\"\n",  "EXT_nothing, ignored\n", "KHR_materials_variants, used\n"};
    for (size_t i = 0; i < LSF_COUNT(text_parts); i++)
        assert_non_null(strstr(text, text_parts[i]));
    free(json);
    free(text);
    lsf_scene_destroy(scene);
}

static void test_instancing(void **state)
{
    (void)state;
    lsf_scene *scene = load("instanced.gltf", NULL);
    assert_int_equal(scene->instance_count, 3);
    assert_int_equal(scene->primitive_count, 1);
    assert_point(scene, 0, 0.0, POINT(1, 0, 0), POINT(1, 0, 5));
    /* Scaled, then turned by half a turn about z, then moved, then with the node. */
    assert_point(scene, 1, 0.0, POINT(1, 1, 0), POINT(8, -2, 5));
    /* A quarter turn takes y, stretched to 3, to -x. */
    assert_point(scene, 2, 0.0, POINT(0, 1, 0), POINT(-3, 20, 5));
    lsf_scene_destroy(scene);

    scene = load("instanced_nothing.gltf", NULL);
    assert_int_equal(scene->instance_count, 1);
    lsf_scene_destroy(scene);
}

/* Diffuse and specular colour stay as they are: an index of 0 leaves the reflection to the latter.
 */
static void test_glossiness(void **state)
{
    (void)state;
    lsf_scene *scene = load("glossiness.gltf", NULL);
    const lsf_material *material = &scene->materials[scene->primitives[0].material];
    static const float diffuse[] = {0.5f, 0.25f, 0.125f, 1}, specular[] = {0.25f, 0.5f, 1};
    assert_memory_equal(material->base_color, diffuse, sizeof diffuse);
    assert_memory_equal(material->specular_color, specular, sizeof specular);
    assert_true(material->metallic == 0.0f && material->ior == 0.0f && material->specular == 1.0f);
    assert_true(material->roughness == 0.25f);
    assert_int_equal(scene->texture_count, 0); /* that of the metallic model is not loaded */
    lsf_scene_destroy(scene);

    scene = load("glossiness_textured.gltf", NULL);
    material = &scene->materials[scene->primitives[0].material];
    const lsf_texture_slot *tint = &material->specular_color_texture;
    const lsf_texture_slot *rough = &material->metallic_roughness_texture;
    assert_true(scene->textures[tint->texture].srgb && !scene->textures[rough->texture].srgb);
    assert_memory_equal(tint->transform, rough->transform, sizeof rough->transform);
    assert_true(rough->transform[0] == 2.0f && material->roughness == 1.0f);
    const lsf_texture_image *image = &scene->images[scene->textures[rough->texture].image];
    assert_int_equal(image->channels, 1);
    assert_int_equal(image->width, 2);
    assert_int_equal(((uint8_t *)image->texels)[0], 128); /* 255 (1 - 0.5), rounded */
    assert_int_equal(((uint8_t *)image->texels)[1], 223); /* 255 - 0.5 * 64 */
    lsf_scene_destroy(scene);

    scene = load("glossiness_opaque.gltf", NULL); /* no alpha: as glossy as the factor says */
    material = &scene->materials[scene->primitives[0].material];
    image = &scene->images[scene->textures[material->metallic_roughness_texture.texture].image];
    assert_int_equal(((uint8_t *)image->texels)[0], 0);
    lsf_scene_destroy(scene);

    lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS};
    params.diffuse_only = true;
    scene = load("glossiness.gltf", &params);
    material = &scene->materials[scene->primitives[0].material];
    assert_memory_equal(material->base_color, diffuse, sizeof diffuse);
    assert_true(material->ior == 1.5f && material->roughness == 1.0f);
    lsf_scene_destroy(scene);
}

static void test_lenient(void **state)
{
    (void)state;
    lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS};
    params.lenient = true;
    lsf_scene *scene = load("require_KHR_materials_nothing.gltf", &params);
    assert_true(has_note(scene, "KHR_materials_nothing is ignored, though the file requires it"));
    lsf_scene_destroy(scene);
    scene = load("require_KHR_techniques_webgl.gltf", &params);
    assert_true(has_note(scene, "KHR_techniques_webgl is ignored, though the file requires it"));
    lsf_scene_destroy(scene);

    lsf_error error = {0};
    char *path = lsf_format("%s/require_KHR_materials_nothing.gltf", gltf_folder);
    assert_null(lsf_scene_load(path, NULL, &error));
    assert_non_null(strstr(error.message, "leniently"));
    free(path);
    /* What nobody knows may place things. */
    path = lsf_format("%s/require_EXT_nothing.gltf", gltf_folder);
    assert_null(lsf_scene_load(path, &params, &error));
    assert_int_equal(error.code, LSF_ERROR_FILE);
    assert_null(strstr(error.message, "leniently"));
    free(path);
}

static const lsf_material *first_material(const lsf_scene *scene)
{
    return &scene->materials[scene->primitives[0].material];
}

static void test_factors_beyond_their_range(void **state)
{
    (void)state;
    lsf_scene *scene = load("rounding.gltf", NULL);
    const float rounded[] = {1.0f, 0.5f, 0.0f, 1.0f};
    assert_memory_equal(first_material(scene)->base_color, rounded, sizeof rounded);
    assert_int_equal(lsf_scene_note_count(scene), 1); /* that nothing lights it */
    lsf_scene_destroy(scene);

    lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS};
    params.lenient = true;
    scene = load("factors.gltf", &params);
    assert_true(has_note(scene, "2 factors beyond 0 to 1"));
    assert_true(first_material(scene)->metallic == 1.0f);
    assert_true(first_material(scene)->roughness == 0.0f);
    lsf_scene_destroy(scene);
}

static void test_absent_images(void **state)
{
    (void)state;
    lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS};
    params.lenient = true;
    lsf_scene *scene = load("absent.gltf", &params);
    assert_true(has_note(scene, "1 image file that cannot be found"));
    assert_true(first_material(scene)->base_color_texture.texture == LSF_NONE);
    assert_int_equal(scene->image_count, 0);
    lsf_scene_destroy(scene);
}

int main(void)
{
    static size_t cases_min = 30;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_cases, &cases_min),
        cmocka_unit_test(test_scenes),
        cmocka_unit_test(test_animations),
        cmocka_unit_test(test_variants),
        cmocka_unit_test(test_choices_that_are_not_there),
        cmocka_unit_test(test_description_names_what_there_is),
        cmocka_unit_test(test_instancing),
        cmocka_unit_test(test_glossiness),
        cmocka_unit_test(test_lenient),
        cmocka_unit_test(test_factors_beyond_their_range),
        cmocka_unit_test(test_absent_images),
    };
    return cmocka_run_group_tests_name("gltf extensions", tests, make_gltf_folder,
                                       remove_gltf_folder);
}
