/* Scenes that are loaded from memory: as from a file, and files beside them only where asked for.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gltf_folder.h"

#include <lightsheaf/lightsheaf.h>

/* A block of just that size, so that a sanitizer sees a byte that is read beyond it. */
static lsf_scene *load_block(const char *bytes, size_t length, const char *folder,
                             const lsf_scene_params *params, lsf_error *error)
{
    char *block = malloc(length);
    assert_true(block || length == 0);
    if (length > 0)
        memcpy(block, bytes, length);
    lsf_scene *scene = lsf_scene_load_memory(block, length, folder, params, error);
    free(block);
    return scene;
}

/* Every file that the script writes, good and bad. */
static void test_as_from_a_file(void **state)
{
    (void)state;
    char *cases_path = lsf_format("%s/cases.tsv", gltf_folder);
    FILE *cases = fopen(cases_path, "r");
    assert_non_null(cases);
    char line[1024];
    uint32_t good = 0, bad = 0;
    while (fgets(line, sizeof line, cases)) {
        line[strcspn(line, "\t")] = '\0';
        char *path = lsf_format("%s/%s", gltf_folder, line);
        lsf_error file_error = {0}, memory_error = {0};
        lsf_scene *from_file = lsf_scene_load(path, NULL, &file_error);
        size_t length;
        char *bytes = lsf_file_read(path, 1 << 24, &length, &memory_error);
        if (bytes) {
            lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS};
            params.name = path;
            char *folder = lsf_format("%.*s", (int)(strrchr(path, '/') - path), path);
            lsf_scene *scene = load_block(bytes, length, folder, &params, &memory_error);
            free(folder);
            assert_int_equal(scene != NULL, from_file != NULL);
            assert_string_equal(memory_error.message, file_error.message);
            good += scene != NULL;
            bad += scene == NULL;
            if (scene) {
                char *a = lsf_scene_describe(scene, true), *b = lsf_scene_describe(from_file, true);
                assert_string_equal(a, b);
                free(a);
                free(b);
            }
            lsf_scene_destroy(scene);
        }
        lsf_scene_destroy(from_file);
        free(bytes);
        free(path);
    }
    fclose(cases);
    free(cases_path);
    assert_true(good > 20 && bad > 20);
}

static void test_cut_at_every_byte(void **state)
{
    (void)state;
    static const char *const names[] = {"quad.glb", "flat.gltf"};
    for (size_t i = 0; i < LSF_COUNT(names); i++) {
        char *path = lsf_format("%s/%s", gltf_folder, names[i]);
        size_t length;
        char *bytes = lsf_file_read(path, 1 << 20, &length, NULL);
        assert_non_null(bytes);
        size_t end = length;
        while (end > 0 && strchr("\n\r ", bytes[end - 1]))
            end--;
        for (size_t cut = 0; cut < end; cut++) {
            lsf_error error = {0};
            assert_null(load_block(bytes, cut, NULL, NULL, &error));
            assert_int_equal(error.code, LSF_ERROR_FILE);
            assert_memory_equal(error.message, "memory: ", 8);
        }
        free(bytes);
        free(path);
    }
}

static void test_files_beside_it(void **state)
{
    (void)state;
    static const char scene_text[] =
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":3,"
        "\"uri\":\"beside.bin\"}]}";
    char *buffer = lsf_format("%s/beside.bin", gltf_folder);
    assert_true(lsf_file_write(buffer, "abc", 3, NULL));
    lsf_scene *scene = load_block(scene_text, strlen(scene_text), gltf_folder, NULL, NULL);
    assert_non_null(scene);
    lsf_scene_destroy(scene);

    lsf_error error = {0};
    assert_null(load_block(scene_text, strlen(scene_text), NULL, NULL, &error));
    assert_int_equal(error.code, LSF_ERROR_FILE);
    static const char *const says[] = {"memory: ", "/buffers/0/uri", "beside.bin", "embed"};
    for (size_t i = 0; i < LSF_COUNT(says); i++)
        assert_non_null(strstr(error.message, says[i]));
    assert_int_equal(remove(buffer), 0);
    assert_null(load_block(scene_text, strlen(scene_text), gltf_folder, NULL, &error));
    free(buffer);
}

/* The content counts, though it is not copied: as a file's does. */
static void test_limit(void **state)
{
    (void)state;
    lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS};
    static const char scene_text[] = "{\"asset\":{\"version\":\"2.0\"}}";
    params.memory_limit = strlen(scene_text) - 1;
    lsf_error error = {0};
    assert_null(load_block(scene_text, strlen(scene_text), NULL, &params, &error));
    assert_non_null(strstr(error.message, "MEMORY_LIMIT"));
    assert_null(lsf_scene_load_memory(NULL, 0, NULL, NULL, &error));
    assert_non_null(strstr(error.message, "an empty file"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_as_from_a_file),
        cmocka_unit_test(test_cut_at_every_byte),
        cmocka_unit_test(test_files_beside_it),
        cmocka_unit_test(test_limit),
    };
    return cmocka_run_group_tests(tests, make_gltf_folder, remove_gltf_folder);
}
