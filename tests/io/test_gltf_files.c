/* Good and bad glTF files: an outcome is expected of each, and it must come soon. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gltf_cases.h"

static void test_cut_at_every_byte(void **state)
{
    (void)state;
    char *path = lsf_format("%s/quad.glb", gltf_folder);
    char *cut_path = lsf_format("%s/cut.glb", gltf_folder);
    size_t length;
    char *bytes = lsf_file_read(path, 1 << 20, &length, NULL);
    assert_non_null(bytes);
    for (size_t cut = 0; cut < length; cut++) {
        FILE *file = fopen(cut_path, "wb");
        assert_non_null(file);
        assert_int_equal(fwrite(bytes, 1, cut, file), cut);
        fclose(file);
        lsf_error error = {0};
        assert_null(lsf_scene_load(cut_path, NULL, &error));
        assert_int_equal(error.code, LSF_ERROR_FILE);
        assert_non_null(strstr(error.message, cut_path));
    }
    free(bytes);
    free(path);
    free(cut_path);
}

/* Any byte may be wrong: a result or an error, but no crash. */
static void test_every_byte_changed(void **state)
{
    (void)state;
    char *path = lsf_format("%s/quad.glb", gltf_folder);
    char *changed_path = lsf_format("%s/changed.glb", gltf_folder);
    size_t length;
    char *bytes = lsf_file_read(path, 1 << 20, &length, NULL);
    assert_non_null(bytes);
    uint32_t random = 1;
    for (size_t i = 0; i < length; i++) {
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
    free(changed_path);
}

static void test_memory_limit(void **state)
{
    (void)state;
    char *path = lsf_format("%s/million_nodes.gltf", gltf_folder);
    lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS};
    params.memory_limit = 1 << 20;
    lsf_error error = {0};
    assert_null(lsf_scene_load(path, &params, &error));
    assert_non_null(strstr(error.message, "larger than the 1048576 bytes"));
    params.memory_limit = 300 << 20;
    assert_null(lsf_scene_load(path, &params, &error));
    assert_non_null(strstr(error.message, "memory limit"));
    free(path);
}

/* --- scenes from elsewhere --- */

static const struct {
    const char *path, *expected, *triangles;
} shared_cases[] = {
    {"atrium/atrium_point.gltf", "ok", "195168"},
    {"atrium/atrium_sun.gltf", "ok", "195168"},
    {"cornell/cornell_emissive.gltf", "ok", "38"},
    {"cornell/cornell_point.gltf", "ok", "30"},
    {"cornell/cornell_sun.gltf", "ok", "30"},
    {"flight_helmet/FlightHelmet.gltf", "ok", "94722"},
    {"furnace_box/furnace_box.gltf", "ok", "12"},
    {"stanford_bunny/stanford_bunny.gltf", "ok", "144046"},
    {"tonemapping_test/TonemappingTest.gltf", "ok", "6590"},
    {"cubes/Cubes.glb", "ok", "36"},
    {"bad/assimp/BoxBadNormals-glTF-Binary/BoxBadNormals.glb", "ok", "12"},
    {"bad/assimp/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", "ACCESSOR_INVALID_FLOAT", ""},
    {"bad/assimp/IncorrectVertexArrays/Cube.gltf", "BUFFER_VIEW_TOO_LONG", ""},
    {"bad/assimp/IndexOutOfRange/AllIndicesOutOfRange.gltf", "ACCESSOR_INDEX_PRIMITIVE_RESTART",
     ""},
    {"bad/assimp/IndexOutOfRange/IndexOutOfRange.gltf", "ACCESSOR_INDEX_OOB", ""},
    {"bad/assimp/MissingBin/BoxTextured.gltf", "cannot be found", ""},
    {"bad/assimp/RecursiveNodes/RecursiveNodes.gltf", "NODE_LOOP", ""},
    {"bad/assimp/SchemaFailures/sceneWrongType.gltf", "TYPE_MISMATCH", ""},
    {"bad/assimp/TestNoRootNode/NoScene.gltf", "UNRESOLVED_REFERENCE", ""},
    {"bad/assimp/TestNoRootNode/SceneWithoutNodes.gltf", "ok", "0"},
    {"bad/assimp/issue_3269/texcoord_crash.gltf", "ok", "10"},
    {"bad/assimp/wrongTypes/badArray.gltf", "TYPE_MISMATCH", ""},
    {"bad/assimp/wrongTypes/badExtension.gltf", "TYPE_MISMATCH", ""},
    {"bad/assimp/wrongTypes/badNumber.gltf", "UNDEFINED_PROPERTY", ""},
    {"bad/assimp/wrongTypes/badObject.gltf", "TYPE_MISMATCH", ""},
    {"bad/assimp/wrongTypes/badString.gltf", "TYPE_MISMATCH", ""},
    {"bad/assimp/wrongTypes/badUint.gltf", "UNRESOLVED_REFERENCE", ""},
    {"bad/tinygltf/BoundsChecking/integer-out-of-bounds.gltf", "TYPE_MISMATCH", ""},
    {"bad/tinygltf/BoundsChecking/invalid-buffer-index.gltf", "UNRESOLVED_REFERENCE", ""},
    {"bad/tinygltf/BoundsChecking/invalid-buffer-view-index.gltf", "UNRESOLVED_REFERENCE", ""},
    {"bad/tinygltf/BoundsChecking/invalid-primitive-indices.gltf", "UNRESOLVED_REFERENCE", ""},
    {"bad/tinygltf/Cube-texture-ext/Cube-textransform.gltf", "ok", "12"},
    {"bad/tinygltf/Cube/Cube.gltf", "ok", "12"},
    {"bad/tinygltf/CubeImageUriSpaces/CubeImageUriMultipleSpaces.gltf", "ok", "12"},
    {"bad/tinygltf/CubeImageUriSpaces/CubeImageUriSpaces.gltf", "ok", "12"},
    {"bad/tinygltf/Extensions-issue97/test.gltf", "ok", "1"},
    {"bad/tinygltf/Extensions-overwrite-issue261/issue-261.gltf", "ok", "12"},
    {"bad/tinygltf/SparseMorphTargets-issue280/singleBlendshapeCube_sparse.glb", "ok", "12"},
    {"bad/tinygltf/box01.glb", "ok", "12"},
    {"bad/tinygltf/regression/unassigned-skeleton.gltf", "ok", "8"},
    {"bad/tinygltf/regression/zero-sized-bin-chunk-issue-440.glb", "ok", "1"},
};

static void test_shared_scenes(void **state)
{
    (void)state;
    const char *shared = getenv("LSF_SHARED");
    char *folder = shared ? lsf_format("%s/scenes", shared) : NULL;
    if (!folder || access(folder, R_OK) != 0) {
        free(folder);
        skip();
    }
    int failures = 0;
    for (size_t i = 0; i < LSF_COUNT(shared_cases); i++) {
        char *path = lsf_format("%s/%s", folder, shared_cases[i].path);
        failures += !check_case(path, shared_cases[i].expected, shared_cases[i].triangles, "");
        free(path);
    }
    free(folder);
    assert_int_equal(failures, 0);
}

int main(void)
{
    static size_t cases_min = 150;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_cases, &cases_min),
        cmocka_unit_test(test_cut_at_every_byte),
        cmocka_unit_test(test_every_byte_changed),
        cmocka_unit_test(test_memory_limit),
        cmocka_unit_test(test_shared_scenes),
    };
    return cmocka_run_group_tests_name("gltf files", tests, make_gltf_folder, remove_gltf_folder);
}
