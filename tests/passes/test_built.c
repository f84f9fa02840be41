/* A scene that a program builds is rendered to the bits of one that was loaded. */
#include "base/base.h"
#include "render_gl.h"

#include "../scene/rebuild.h"

enum { SIZE = 16 };

static lsf_image *render(const lsf_scene *scene, const char *technique)
{
    static const char *const options[] = {"voxel.resolution=32", "rsm.resolution=64",
                                          "bundle.resolution=64", "vpl.shadow_resolution=64",
                                          "cloud.count=8192"};
    const lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS,
                                      .technique = technique,
                                      .width = SIZE,
                                      .height = SIZE,
                                      .samples = 2,
                                      .options = options,
                                      .option_count = LSF_COUNT(options)};
    return render_gl(gl_test_backend(), scene, &params);
}

static void a_cornell_box(void **state)
{
    (void)state;
    static const char *const techniques[] = {"direct", "bidirectional", "voxel_path", "cone",
                                             "substitute_tree"};
    lsf_scene *loaded = load_default_scene("cornell_point.gltf"), *built = rebuild(loaded);
    for (size_t t = 0; t < LSF_COUNT(techniques); t++) {
        lsf_image *image = render(built, techniques[t]);
        lsf_image *expected = render(loaded, techniques[t]);
        assert_same_pixels(image, expected);
        lsf_image_destroy(image);
        lsf_image_destroy(expected);
    }
    lsf_scene_destroy(loaded);
    lsf_scene_destroy(built);
}

/* Edits reach it as they do one that was loaded. */
static void edits(void **state)
{
    (void)state;
    lsf_error error = {0};
    lsf_scene *scenes[2] = {load_default_scene("cornell_point.gltf")};
    scenes[1] = rebuild(scenes[0]);
    lsf_image *images[2];
    for (int i = 0; i < 2; i++) {
        lsf_scene *scene = scenes[i];
        uint32_t block = lsf_scene_find(scene, LSF_KIND_NODE, "tall block");
        uint32_t red = lsf_scene_find(scene, LSF_KIND_MATERIAL, "red");
        double matrix[16];
        lsf_material_desc material;
        lsf_light_desc light;
        assert_true(lsf_scene_get_node(scene, block, matrix, &error));
        matrix[12] += 0.3;
        assert_true(lsf_scene_set_node(scene, block, matrix, &error));
        assert_true(lsf_scene_get_material(scene, red, &material, &error));
        material.emission[1] = 0.5f;
        assert_true(lsf_scene_set_material(scene, red, &material, &error));
        assert_true(lsf_scene_get_light(scene, 0, &light, &error));
        light.intensity[2] *= 3.0f;
        assert_true(lsf_scene_set_light(scene, 0, &light, &error));
        images[i] = render(scene, "voxel_path");
    }
    assert_same_pixels(images[1], images[0]);
    for (int i = 0; i < 2; i++) {
        lsf_image_destroy(images[i]);
        lsf_scene_destroy(scenes[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cornell_box),
        cmocka_unit_test(edits),
    };
    return cmocka_run_group_tests_name("built", tests, NULL, NULL);
}
