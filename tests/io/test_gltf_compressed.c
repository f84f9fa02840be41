/* Meshes and textures that the modules lightsheaf-draco, -meshopt and -webp decompress. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define GLTF_SCRIPT "gltf_compressed_files.py"
#include "gltf_cases.h"
#include "load_gltf.h"
#include "scene/scene.h"

#include <math.h>

/* Points come in another order, triangles begin at another corner: corners are told by their place,
 * and each place has its texture coordinates and its colour. */
static void test_draco(void **state)
{
    (void)state;
    static const char *const names[] = {"draco_sequential.gltf", "draco_edgebreaker.gltf",
                                        "draco_fewer_edgebreaker.gltf", "draco.glb"};
    static const float places[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    static const float colors[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    for (size_t n = 0; n < LSF_COUNT(names); n++) {
        lsf_scene *scene = load(names[n]);
        const lsf_vertices *vertices = &scene->vertices;
        assert_int_equal(vertices->count, 4);
        assert_int_equal(scene->index_count, 6);
        for (uint32_t v = 0; v < 4; v++) {
            const float *position = vertices->position + 3 * v;
            const float *normal = vertices->normal + 3 * v;
            uint32_t corner = 0;
            while (corner < 4 && (fabsf(position[0] - places[corner][0]) > 1e-6f ||
                                  fabsf(position[1] - places[corner][1]) > 1e-6f))
                corner++;
            assert_true(corner < 4 && position[2] == 0.0f);
            assert_true(fabsf(normal[2] - 1.0f) < 1e-4f); /* of 8 bits */
            assert_true(fabsf(vertices->uv0[2 * v] - places[corner][0]) < 1e-6f);
            assert_true(fabsf(vertices->uv0[2 * v + 1] - (1.0f - places[corner][1])) < 1e-6f);
            assert_memory_equal(vertices->color + 4 * v, colors[corner], 3 * sizeof(float));
        }
        for (uint32_t t = 0; t < 2; t++) {
            const float *p[3];
            for (uint32_t c = 0; c < 3; c++)
                p[c] = vertices->position + 3 * (size_t)scene->indices[3 * t + c];
            float area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) -
                         (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
            assert_true(fabsf(area - 1.0f) < 1e-6f); /* twice, and front to +z */
        }
        lsf_scene_destroy(scene);
    }
}

static void test_meshopt(void **state)
{
    (void)state;
    static const char *const names[] = {
        "meshopt.gltf",          "meshopt.glb",      "meshopt_u32.gltf",     "meshopt_indices.gltf",
        "meshopt_fallback.gltf", "meshopt_khr.gltf", "meshopt_unmarked.gltf"};
    enum { GRID = 20 };
    for (size_t n = 0; n < LSF_COUNT(names); n++) {
        lsf_scene *scene = load(names[n]);
        assert_int_equal(scene->vertices.count, GRID * GRID);
        for (int v = 0; v < GRID * GRID; v++) {
            int x = v % GRID, y = v / GRID;
            const float position[3] = {(float)x, (float)y, (float)(3 * y % 7 - x)};
            assert_memory_equal(scene->vertices.position + 3 * v, position, sizeof position);
            const float normal[3] = {1, 0, 0};
            assert_memory_equal(scene->vertices.normal + 3 * v, normal, sizeof normal);
        }
        uint32_t at = 0;
        for (uint32_t y = 0; y + 1 < GRID; y++)
            for (uint32_t x = 0; x + 1 < GRID; x++, at += 3) {
                const uint32_t first = y * GRID + x;
                /* The codec may begin a triangle at another corner. */
                const uint32_t *t = scene->indices + at;
                uint32_t turn = t[0] == first ? 0 : t[1] == first ? 1 : 2;
                assert_int_equal(t[turn], first);
                assert_int_equal(t[(turn + 1) % 3], first + 1);
                assert_int_equal(t[(turn + 2) % 3], first + GRID);
            }
        lsf_scene_destroy(scene);
    }
}

static void test_webp(void **state)
{
    (void)state;
    static const char *const names[] = {"webp.gltf", "webp_alone.gltf"};
    for (size_t n = 0; n < LSF_COUNT(names); n++) {
        lsf_scene *scene = load(names[n]);
        assert_int_equal(scene->image_count, 1);
        assert_int_equal(scene->images[0].width, 4);
        assert_int_equal(scene->images[0].height, 3);
        const uint8_t second[] = {20, 235, 60};
        assert_memory_equal((uint8_t *)scene->images[0].texels + 3, second, 3);
        lsf_scene_destroy(scene);
    }
}

static void test_lenient_ktx2(void **state)
{
    (void)state;
    lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS};
    params.lenient = true;
    char *path = lsf_format("%s/ktx2.gltf", gltf_folder);
    lsf_scene *scene = lsf_scene_load(path, &params, NULL);
    free(path);
    assert_non_null(scene);
    assert_int_equal(scene->texture_count, 0);
    assert_true(has_note(scene, "without a PNG, JPEG or WebP image"));
    lsf_scene_destroy(scene);
}

/* Any byte of what is compressed may be wrong: a result or an error, but no crash. */
static void test_changed_bytes(void **state)
{
    (void)state;
    static const char *const names[] = {"draco.glb", "meshopt.glb"};
    char *changed_path = lsf_format("%s/changed.glb", gltf_folder);
    uint32_t random = 1;
    for (size_t n = 0; n < LSF_COUNT(names); n++) {
        char *path = lsf_format("%s/%s", gltf_folder, names[n]);
        size_t length;
        char *bytes = lsf_file_read(path, 1 << 20, &length, NULL);
        assert_non_null(bytes);
        uint32_t json_length;
        memcpy(&json_length, bytes + 12, 4);
        size_t first = 28 + json_length, step = 1 + (length - first) / 250;
        for (size_t i = first; i < length; i += step) {
            char kept = bytes[i];
            random = random * 1664525u + 1013904223u;
            bytes[i] = (char)(random >> 24);
            FILE *file = fopen(changed_path, "wb");
            assert_non_null(file);
            assert_int_equal(fwrite(bytes, 1, length, file), length);
            fclose(file);
            bytes[i] = kept;
            lsf_error error = {0};
            lsf_scene *scene = lsf_scene_load(changed_path, NULL, &error);
            assert_true(scene || error.code == LSF_ERROR_FILE);
            lsf_scene_destroy(scene);
        }
        free(bytes);
        free(path);
    }
    free(changed_path);
}

int main(void)
{
    static size_t cases_min = 40;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_cases, &cases_min),
        cmocka_unit_test(test_draco),
        cmocka_unit_test(test_meshopt),
        cmocka_unit_test(test_webp),
        cmocka_unit_test(test_lenient_ktx2),
        cmocka_unit_test(test_changed_bytes),
    };
    return cmocka_run_group_tests_name("gltf compressed", tests, make_gltf_folder,
                                       remove_gltf_folder);
}
