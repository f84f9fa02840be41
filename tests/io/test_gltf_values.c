/* What the importer makes of the numbers in a file. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gltf_folder.h"
#include "load_gltf.h"
#include "scene/hierarchy.h"
#include "scene/mesh_frame.h"
#include "scene/scene.h"

#include <math.h>

static void assert_floats(const float *values, const float *expected, size_t count, float tolerance)
{
    for (size_t i = 0; i < count; i++)
        if (!(fabsf(values[i] - expected[i]) <= tolerance)) {
            print_error("value %zu is %.9g instead of %.9g\n", i, (double)values[i],
                        (double)expected[i]);
            fail();
        }
}

static void test_normalized_integers(void **state)
{
    (void)state;
    lsf_scene *scene = load("normalized.gltf");
    const float positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, -1, 1, 0};
    assert_floats(scene->vertices.position, positions, 12, 0.0f);
    const float colors[] = {1,
                            1.0f / 65535.0f,
                            0,
                            1,
                            0,
                            1,
                            0,
                            1,
                            0,
                            0,
                            32768.0f / 65535.0f,
                            1,
                            7.0f / 65535.0f,
                            8.0f / 65535.0f,
                            9.0f / 65535.0f,
                            1};
    assert_floats(scene->vertices.color, colors, 16, 0.0f);
    assert_true(scene->requirements.vertex_colored);
    lsf_scene_destroy(scene);

    scene = load("quantized.gltf");
    const float quantized[] = {0, 0, 0, 300, 0, 0, 300, 300, 0, -32768, 300, 0};
    assert_floats(scene->vertices.position, quantized, 12, 0.0f);
    lsf_scene_destroy(scene);
}

static void test_sparse(void **state)
{
    (void)state;
    lsf_scene *scene = load("sparse.gltf");
    const float positions[] = {0, 0, 0, 2, 0, 0, 1, 1, 0, 0, 2, 0};
    assert_floats(scene->vertices.position, positions, 12, 0.0f);
    lsf_scene_destroy(scene);
}

static void test_flat_normals(void **state)
{
    (void)state;
    lsf_scene *scene = load("flat.gltf");
    assert_int_equal(scene->vertices.count, 6); /* un-shared */
    for (int i = 0; i < 6; i++)
        assert_floats(scene->vertices.normal + 3 * i, (const float[]){0, 0, 1}, 3, 0.0f);
    lsf_scene_destroy(scene);

    const float point[3] = {1, 2, 3}, far[3] = {1, 2, 9};
    float normal[3];
    lsf_triangle_normal(point, point, point, normal);
    assert_floats(normal, (const float[]){0, 0, 1}, 3, 0.0f);
    lsf_triangle_normal(point, far, point, normal);
    assert_true(normal[2] == 0.0f);
    assert_true(fabsf(hypotf(normal[0], normal[1]) - 1.0f) < 1e-6f);
    const float tiny[3][3] = {{0, 0, 0}, {1e-44f, 0, 0}, {0, 1e-44f, 0}};
    lsf_triangle_normal(tiny[0], tiny[1], tiny[2], normal);
    assert_floats(normal, (const float[]){0, 0, 1}, 3, 0.0f);
    const float huge[3][3] = {{0, 0, 0}, {3e38f, 0, 0}, {0, 3e38f, 0}};
    lsf_triangle_normal(huge[0], huge[1], huge[2], normal);
    assert_floats(normal, (const float[]){0, 0, 1}, 3, 0.0f);
}

static void test_strips_and_fans(void **state)
{
    (void)state;
    lsf_scene *scene = load("strip.gltf");
    const uint32_t strip[] = {0, 1, 2, 1, 3, 2};
    assert_memory_equal(scene->indices, strip, sizeof(strip));
    lsf_scene_destroy(scene);
    scene = load("fan.gltf");
    const uint32_t fan[] = {1, 2, 0, 2, 3, 0};
    assert_memory_equal(scene->indices, fan, sizeof(fan));
    lsf_scene_destroy(scene);
}

static void test_tangents(void **state)
{
    (void)state;
    lsf_scene *scene = load("tangents.gltf");
    /* u grows along x in the lower triangle, whose texture is upright; in the upper one it falls
     * along -x, seen mirrored: the shared vertices 0 and 2 are split. */
    assert_int_equal(scene->vertices.count, 6);
    const float *tangents = scene->vertices.tangent;
    assert_floats(tangents + 4, (const float[]){1, 0, 0, 1}, 4, 1e-6f);
    for (uint32_t i = 0; i < 6; i++) {
        const float *t = tangents + 4 * scene->indices[i];
        assert_true(fabsf(t[0] * t[0] + t[1] * t[1] + t[2] * t[2] - 1.0f) < 1e-6f);
        assert_true(t[3] == (i < 3 ? 1.0f : -1.0f));
    }
    lsf_scene_destroy(scene);
}

/* The helmet comes with tangents that its exporter computed by MikkTSpace. */
static void test_tangents_against_file(void **state)
{
    (void)state;
    const char *shared = getenv("LSF_SHARED");
    char *path = lsf_format("%s/scenes/flight_helmet/FlightHelmet.gltf", shared ? shared : "");
    if (access(path, R_OK) != 0) {
        free(path);
        skip();
    }
    lsf_scene *scene = lsf_scene_load(path, NULL, NULL);
    free(path);
    assert_non_null(scene);
    uint64_t count = scene->vertices.count, close = 0, same_sign = 0, compared = 0;
    float *tangents = calloc(count, 4 * sizeof(float));
    assert_non_null(tangents);
    lsf_make_tangents(scene->vertices.position, scene->vertices.normal, scene->vertices.uv0, count,
                      scene->indices, scene->index_count, tangents);
    for (uint64_t i = 0; i < count; i++) {
        const float *a = tangents + 4 * i, *b = scene->vertices.tangent + 4 * i;
        compared++;
        close += a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > 0.95f;
        same_sign += a[3] == b[3];
    }
    print_message("tangents within 18 degrees: %.4f, same sign: %.4f\n",
                  (double)close / (double)compared, (double)same_sign / (double)compared);
    assert_true((double)close > 0.95 * (double)compared);
    assert_true((double)same_sign > 0.99 * (double)compared);
    free(tangents);
    lsf_scene_destroy(scene);
}

static void position_at(const lsf_scene *scene, double time, double point[3])
{
    double matrix[16];
    assert_int_equal(scene->node_count, 1);
    lsf_scene_world_matrices(scene, time, matrix);
    lsf_transform_point(matrix, (const double[]){1, 0, 0}, point);
}

static void assert_x_at(const lsf_scene *scene, double time, double x)
{
    double point[3];
    position_at(scene, time, point);
    assert_true(fabs(point[0] - x) < 1e-12);
}

static void test_animations(void **state)
{
    (void)state;
    lsf_scene *scene = load("animated.gltf");
    assert_true(scene->requirements.moving);
    assert_x_at(scene, -5.0, 1.0);
    assert_x_at(scene, 1.0, 1.0);
    assert_x_at(scene, 1.25, 2.0);
    assert_x_at(scene, 2.0, 5.0);
    assert_x_at(scene, 1e9, 5.0);
    lsf_scene_destroy(scene);

    scene = load("animated_step.gltf");
    assert_x_at(scene, 1.999, 1.0);
    assert_x_at(scene, 2.0, 5.0);
    lsf_scene_destroy(scene);

    /* Keys 0 and 4 two seconds apart, out-tangent 1: at t = 1/2, 1/2 * 4 + 2 * 1/8 * 1. */
    scene = load("animated_cubic.gltf");
    assert_x_at(scene, 0.0, 1.0);
    assert_x_at(scene, 1.0, 1.0 + 2.0 + 0.25);
    assert_x_at(scene, 3.0, 5.0);
    lsf_scene_destroy(scene);

    /* A quarter turn about z by the short way: (0, 0, -h, -h) is +90 degrees. */
    scene = load("animated_turn.gltf");
    double point[3];
    position_at(scene, 1.0 / 3.0, point);
    assert_true(fabs(point[0] - sqrt(0.75)) < 1e-7 && fabs(point[1] - 0.5) < 1e-7);
    position_at(scene, 2.0, point);
    assert_true(fabs(point[0]) < 1e-7 && fabs(point[1] - 1.0) < 1e-7);
    lsf_scene_destroy(scene);
}

static void test_instances_are_stored_once(void **state)
{
    (void)state;
    lsf_scene *scene = load("instances.gltf");
    assert_int_equal(scene->instance_count, 2);
    assert_int_equal(scene->primitive_count, 1);
    assert_int_equal(scene->requirements.triangles, 4);
    assert_int_equal(scene->requirements.unique_triangles, 2);
    assert_true(scene->requirements.bounds_max[0] == 4.0);
    assert_true(scene->requirements.center[0] == 2.0);
    assert_true(scene->requirements.scale == 0.5);
    lsf_scene_destroy(scene);
}

static void test_children_in_scenes(void **state)
{
    (void)state;
    lsf_scene *scene = load("scene_child.gltf");
    assert_int_equal(scene->node_count, 1);
    assert_true(scene->requirements.bounds_max[0] == 1.0);
    lsf_scene_destroy(scene);

    scene = load("scene_family.gltf");
    assert_int_equal(scene->node_count, 2);
    assert_int_equal(scene->instance_count, 1);
    assert_true(scene->requirements.bounds_max[0] == 6.0);
    lsf_scene_destroy(scene);
}

static void test_materials(void **state)
{
    (void)state;
    lsf_scene *scene = load("material_ok.gltf");
    const lsf_material *material = &scene->materials[scene->primitives[0].material];
    assert_floats(material->emission, (const float[]){10, 5, 0}, 3, 0.0f);
    assert_true(material->ior == 1.33f && material->transmission == 1.0f);
    assert_true(material->specular == 0.5f && scene->requirements.specular_varied);
    assert_true(material->coat == 0.5f && material->coat_roughness == 0.25f);
    assert_true(scene->requirements.coated && scene->requirements.sheened);
    assert_floats(material->sheen_color, (const float[]){0.5f, 0.25f, 1}, 3, 0.0f);
    assert_true(material->sheen_roughness == 0.75f);
    assert_floats(material->specular_color, (const float[]){1, 2, 0.25f}, 3, 0.0f);
    assert_true(material->volume && material->attenuation_distance == 0.5f);
    assert_floats(material->attenuation_color, (const float[]){1, 0.5f, 0.25f}, 3, 0.0f);
    assert_true(scene->requirements.emissive && scene->requirements.variable_ior &&
                scene->requirements.transmissive && scene->requirements.refractive &&
                scene->requirements.anisotropic);
    /* It glows, but lights nothing. */
    assert_true(scene->environment.by_default && scene->key_light.present);
    lsf_scene_destroy(scene);

    char *path = lsf_format("%s/material_ok.gltf", gltf_folder);
    lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS};
    params.diffuse_only = true;
    scene = lsf_scene_load(path, &params, NULL);
    free(path);
    assert_non_null(scene);
    material = &scene->materials[scene->primitives[0].material];
    assert_true(material->metallic == 0.0f && material->roughness == 1.0f);
    assert_floats(material->emission, (const float[]){10, 5, 0}, 3, 0.0f);
    assert_false(scene->requirements.specular || scene->requirements.transmissive ||
                 scene->requirements.anisotropic);
    assert_null(scene->vertices.tangent);
    lsf_scene_destroy(scene);
}

static void test_defaults(void **state)
{
    (void)state;
    lsf_scene *scene = load("quad.glb");
    assert_true(scene->environment.by_default && scene->requirements.environment);
    assert_true(scene->key_light.present && scene->requirements.directional_lights == 1);
    assert_int_equal(scene->camera_count, 1);
    const lsf_camera *camera = &scene->cameras[0];
    assert_true(camera->node == LSF_NONE && camera->frames_scene);
    char *json = lsf_scene_describe(scene, true), *text = lsf_scene_describe(scene, false);
    assert_non_null(strstr(json, "\"triangles\": 2"));
    assert_non_null(strstr(text, "triangles    2"));
    free(json);
    free(text);
    lsf_scene_destroy(scene);

    scene = load("empty.gltf");
    assert_true(scene->requirements.scale == 1.0);
    assert_true(scene->requirements.bounds_min[0] > scene->requirements.bounds_max[0]);
    assert_int_equal(lsf_scene_camera_count(scene), 1);
    lsf_scene_destroy(scene);
}

static lsf_scene *load_text(const char *text)
{
    char *path = lsf_format("%s/text.gltf", gltf_folder);
    assert_true(lsf_file_write(path, text, strlen(text), NULL));
    free(path);
    return load("text.gltf");
}

static void test_names_do_not_steer_a_terminal(void **state)
{
    (void)state;
    lsf_scene *scene =
        load_text("{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"\\u001b[31mX\"],"
                  "\"nodes\":[{\"camera\":0}],\"cameras\":[{\"name\":\"\\u001b[2J\\n\\rerror: "
                  "\\u009b1m\\u00e9\","
                  "\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":0.1}}]}");
    assert_string_equal(lsf_scene_camera_name(scene, 0), "?[2J??error: ??1m\xc3\xa9");
    assert_true(lsf_scene_note_count(scene) > 0);
    assert_non_null(strstr(lsf_scene_note(scene, 0), "?[31mX"));
    char *shown = lsf_scene_describe(scene, false);
    for (const char *c = shown; *c; c++)
        assert_true(*c == '\n' || (unsigned char)*c >= 0x20);
    free(shown);
    lsf_scene_destroy(scene);
}

static void test_negative_colours_are_set_to_0(void **state)
{
    (void)state;
    lsf_scene *scene = load_text(
        "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
        "AACAvwAAgD8AAAC/AACAvwAAgD8AAAC/AACAvwAAgD8AAAC/\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":0,\"COLOR_0\":0}}]"
        "}]}");
    const float expected[4] = {0.0f, 1.0f, 0.0f, 1.0f};
    assert_floats(scene->vertices.color, expected, 4, 0.0f);
    assert_non_null(strstr(lsf_scene_note(scene, 0), "6 components of vertex colours"));
    lsf_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_normalized_integers),
        cmocka_unit_test(test_sparse),
        cmocka_unit_test(test_flat_normals),
        cmocka_unit_test(test_strips_and_fans),
        cmocka_unit_test(test_tangents),
        cmocka_unit_test(test_tangents_against_file),
        cmocka_unit_test(test_animations),
        cmocka_unit_test(test_instances_are_stored_once),
        cmocka_unit_test(test_children_in_scenes),
        cmocka_unit_test(test_materials),
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_names_do_not_steer_a_terminal),
        cmocka_unit_test(test_negative_colours_are_set_to_0),
    };
    return cmocka_run_group_tests_name("gltf values", tests, make_gltf_folder, remove_gltf_folder);
}
