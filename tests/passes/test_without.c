/* Scenes without one of their features: the scene stays what it is, and both render. */
#include "base/base.h"
#include "render_gl.h"

enum { SIZE = 16 };

static const uint8_t texels[4 * 4] = {255, 180, 120, 255, 100, 200, 255, 40,
                                      220, 255, 140, 255, 128, 128, 255, 10};

static void texture_all(lsf_scene *scene)
{
    lsf_vertices *v = &scene->vertices;
    v->uv0 = calloc(v->count, 2 * sizeof *v->uv0);
    v->tangent = calloc(v->count, 4 * sizeof *v->tangent);
    v->color = calloc(v->count, 4 * sizeof *v->color);
    assert_true(v->uv0 && v->tangent && v->color);
    for (uint64_t i = 0; i < v->count; i++) {
        lsf_float3 n = lsf_f3_load(v->normal + 3 * i);
        lsf_float3 t = lsf_f3_normalize(lsf_f3_cross(n, lsf_f3(0.2f, 0.5f, 0.8f)));
        memcpy(v->uv0 + 2 * i, (float[]){v->position[3 * i], v->position[3 * i + 2]}, 8);
        memcpy(v->tangent + 4 * i, (float[]){t.x, t.y, t.z, 1.0f}, 16);
        memcpy(v->color + 4 * i, (float[]){0.9f, 0.8f, 0.7f, 1.0f}, 16);
    }
    uint32_t map = build_texture(scene, 2, 2, 4, texels, false);
    for (uint32_t i = 0; i < scene->material_count; i++) {
        scene->materials[i].base_color_texture.texture = map;
        scene->materials[i].normal_texture.texture = map;
        scene->materials[i].metallic_roughness_texture.texture = map;
    }
}

/* One of each. */
static lsf_scene *rich_scene(void)
{
    lsf_scene *scene = build_scene();
    build_corner(scene);
    lsf_material *lamp = build_material(scene, 0.5f, 0.5f, 0.5f);
    lamp->emission[0] = lamp->emission[1] = lamp->emission[2] = 4.0f;
    lamp->anisotropy_strength = 0.5f;
    lamp->coat = lamp->sheen_color[0] = 0.5f;
    lamp->ior = 1.7f;
    lamp->alpha_mode = LSF_ALPHA_MASK;
    build_quad(scene, lsf_f3(-1, 2, -1), lsf_f3(0, 2, -1), lsf_f3(0, 2, 0), lsf_f3(-1, 2, 0));
    build_material(scene, 0.5f, 0.5f, 0.5f)->alpha_mode = LSF_ALPHA_BLEND;
    build_quad(scene, lsf_f3(-1, 1, -1), lsf_f3(0, 1, -1), lsf_f3(0, 1, 0), lsf_f3(-1, 1, 0));
    build_material(scene, 0.5f, 0.5f, 0.5f)->unlit = true;
    build_quad(scene, lsf_f3(1, 1, -1), lsf_f3(2, 1, -1), lsf_f3(2, 1, 0), lsf_f3(1, 1, 0));
    build_glass(scene, 0.9f, 0.2f, 0.0f);
    build_quad(scene, lsf_f3(-1.5f, 0, 0.5f), lsf_f3(0, 0, 0.5f), lsf_f3(0, 1, 0.5f),
               lsf_f3(-1.5f, 1, 0.5f));
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
    texture_all(scene);
    float *sky = build_environment_map(scene, 4, 2);
    for (int i = 0; i < 24; i++)
        sky[i] = i < 12 ? 1.0f : 0.25f;
    finish_gl_scene(scene);
    return scene;
}

static void test_each_feature(void **state)
{
    (void)state;
    lsf_scene *scene = rich_scene();
    const lsf_requirements before = scene->requirements;
    lsf_render_params params = corner_params((lsf_render_params){LSF_RENDER_PARAMS_DEFAULTS}, SIZE);
    params.technique = "direct";
    params.samples = 1;
    params.raw = true;
    lsf_image *whole = render_gl(gl_test_backend(), scene, &params);
    for (int f = 0; f < LSF_FEATURE_COUNT; f++) {
        lsf_error error = {0};
        assert_non_null(lsf_feature_name((lsf_feature)f));
        if (f != LSF_FEATURE_MOTION)
            assert_true(lsf_scene_has(scene, (lsf_feature)f));
        lsf_scene *without = lsf_scene_without(scene, (lsf_feature)f, &error);
        if (!without)
            fail_msg("%s", error.message);
        assert_false(lsf_scene_has(without, (lsf_feature)f));
        assert_memory_equal(&scene->requirements, &before, sizeof before);
        lsf_image_destroy(render_gl(gl_test_backend(), without, &params));
        lsf_scene_destroy(without);
    }
    lsf_image *again = render_gl(gl_test_backend(), scene, &params);
    assert_same_pixels(again, whole);
    assert_null(lsf_feature_name(LSF_FEATURE_COUNT));
    lsf_image_destroy(again);
    lsf_image_destroy(whole);
    destroy_scene(scene);
}

/* A quarter below the horizon and 1 above it: 5/8 on average over the sphere. */
static void test_a_map_becomes_its_mean(void **state)
{
    (void)state;
    lsf_scene *scene = rich_scene();
    lsf_scene *without = lsf_scene_without(scene, LSF_FEATURE_ENVIRONMENT_MAP, NULL);
    assert_non_null(without);
    assert_true(lsf_scene_has(without, LSF_FEATURE_ENVIRONMENT));
    for (int c = 0; c < 3; c++)
        assert_float_equal(without->environment.radiance[c], 0.625f, 1e-6f);
    lsf_scene_destroy(without);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_feature),
        cmocka_unit_test(test_a_map_becomes_its_mean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
