/* Small files that could take much. One that is let pass takes no more memory at any moment than
 * the limit allows; one that could take more is refused. Files are grown until they are refused;
 * the largest that were not are loaded by a process of their own, whose peak is measured. And what
 * primitives share is looked at once. */
#include "gltf_folder.h"

#include "scene/scene.h"

#include <lightsheaf/lightsheaf.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <malloc.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>

#define MEMORY_LIMIT ((uint64_t)48 << 20)
/* Code, stacks, what the C library keeps for later, and the text of the largest file below. */
#define OVERHEAD_KIB (6 << 10)

/* `item` as often as it takes, separated by commas; or, where there is none, '@' for the count. */
typedef struct file_shape {
    const char *name, *before, *item, *after;
} file_shape;

#define NOTHING_BUT "{\"asset\":{\"version\":\"2.0\"},"
#define ONE_NODE NOTHING_BUT "\"nodes\":[{\"mesh\":0}],\"scenes\":[{\"nodes\":[0]}],"
#define NAME_10 "aaaaaaaaaa"
#define NAME_100 NAME_10 NAME_10 NAME_10 NAME_10 NAME_10 NAME_10 NAME_10 NAME_10 NAME_10 NAME_10
#define LONG_NAME                                                                                  \
    NAME_100 NAME_100 NAME_100 NAME_100 NAME_100 NAME_100 NAME_100 NAME_100 NAME_100 NAME_100
#define VEC(n) "{\"componentType\":5126,\"type\":\"VEC" #n "\",\"count\":@}"

static const file_shape shapes[] = {
    {"numbers in extras", NOTHING_BUT "\"extras\":[", "0", "]}"},
    {"objects in extras", NOTHING_BUT "\"extras\":[", "{\"\":0}", "]}"},
    {"texts in extras", NOTHING_BUT "\"extras\":[", "\"\"", "]}"},
    {"nodes", NOTHING_BUT "\"nodes\":[", "{}", "]}"},
    {"materials", NOTHING_BUT "\"materials\":[", "{}", "]}"},
    {"textures", NOTHING_BUT "\"textures\":[", "{}", "]}"},
    {"images", NOTHING_BUT "\"images\":[", "{\"uri\":\"a.png\"}", "]}"},
    {"cameras of one long name",
     NOTHING_BUT "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":"
                 "1},\"name\":\"" LONG_NAME "\"}],\"nodes\":[",
     "{\"camera\":0}", "]}"},
    {"instances of a long name",
     NOTHING_BUT "\"extensionsUsed\":[\"EXT_mesh_gpu_instancing\"],\"accessors\":["
                 "{\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}," VEC(
                     3) "],"
                        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
                        "\"nodes\":[{\"mesh\":0,\"name\":\"" LONG_NAME "\",\"extensions\":{"
                        "\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":1}}}}]}",
     NULL, ""},
    {"lights",
     NOTHING_BUT "\"extensionsUsed\":[\"KHR_lights_punctual\"],"
                 "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[",
     "{\"type\":\"point\"}", "]}}}"},
    {"primitives",
     ONE_NODE "\"accessors\":[{\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}],"
              "\"meshes\":[{\"primitives\":[",
     "{\"attributes\":{\"POSITION\":0}}", "]}]}"},
    {"base64",
     NOTHING_BUT "\"buffers\":[{\"byteLength\":3,\"uri\":\"data:application/octet-stream;base64,"
                 "AAAA\"}],\"images\":[{\"uri\":\"data:image/png;base64,AAAA",
     NULL, "\"}]}"},
    {"vertices without normals",
     ONE_NODE "\"accessors\":[" VEC(3) "],\"meshes\":[{\"primitives\":[{\"attributes\":{"
                                       "\"POSITION\":0}}]}]}",
     NULL, ""},
    {"a strip with normals of no length",
     ONE_NODE "\"accessors\":[" VEC(3) "],\"meshes\":[{\"primitives\":[{\"mode\":5,"
                                       "\"attributes\":{\"POSITION\":0,\"NORMAL\":0}}]}]}",
     NULL, ""},
    {"colours without alpha",
     ONE_NODE
     "\"accessors\":[" VEC(3) "],\"meshes\":[{\"primitives\":[{"
                              "\"attributes\":{\"POSITION\":0,\"NORMAL\":0,\"COLOR_0\":0}}]}]}",
     NULL, ""},
    {"a fan without normals",
     ONE_NODE "\"accessors\":[" VEC(3) "],\"meshes\":[{\"primitives\":[{\"mode\":6,"
                                       "\"attributes\":{\"POSITION\":0}}]}]}",
     NULL, ""},
    {"tangents",
     ONE_NODE "\"materials\":[{\"extensions\":{\"KHR_materials_anisotropy\":{"
              "\"anisotropyStrength\":1}}}],\"accessors\":[" VEC(3) "," VEC(
                  2) "],"
                     "\"meshes\":[{\"primitives\":[{\"material\":0,\"attributes\":{"
                     "\"POSITION\":0,\"NORMAL\":0,\"TEXCOORD_0\":1}}]}]}",
     NULL, ""},
};

/* The text of a file of this shape. */
static char *write_shape(const file_shape *shape, uint64_t count)
{
    lsf_string text = {0};
    char number[32];
    snprintf(number, sizeof number, "%llu", (unsigned long long)count);
    bool base64 = strcmp(shape->name, "base64") == 0;
    for (const char *at = shape->before; *at; at++)
        lsf_string_add_bytes(&text, *at == '@' ? number : at, *at == '@' ? strlen(number) : 1);
    for (uint64_t i = 0; (shape->item || base64) && i < count; i++) {
        if (i && !base64)
            lsf_string_add_bytes(&text, ",", 1);
        lsf_string_add_bytes(&text, base64 ? "AAAA" : shape->item,
                             base64 ? 4 : strlen(shape->item));
    }
    lsf_string_add_bytes(&text, shape->after, strlen(shape->after));
    assert_false(text.failed);
    return text.text;
}

typedef struct outcome {
    bool loaded;
    long peak_kib;
} outcome;

static outcome load_elsewhere(const char *path)
{
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        mallopt(M_PERTURB, 0); /* which would touch memory that is never used */
        lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS};
        params.memory_limit = MEMORY_LIMIT;
        lsf_error error = {0};
        lsf_scene *scene = path ? lsf_scene_load(path, &params, &error) : NULL;
        bool limit = path && !scene && strstr(error.message, "memory limit");
        if (path && !scene && !limit)
            fprintf(stderr, "%s\n", error.message);
        _exit(scene ? 0 : limit || !path ? 1 : 2);
    }
    int status;
    struct rusage usage;
    assert_int_equal(wait4(child, &status, 0, &usage), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) < 2);
    return (outcome){WEXITSTATUS(status) == 0, usage.ru_maxrss};
}

static outcome load_shape(const file_shape *shape, uint64_t count)
{
    char *path = lsf_format("%s/shape.gltf", gltf_folder);
    char *text = write_shape(shape, count);
    assert_true(lsf_file_write(path, text, strlen(text), NULL));
    free(text);
    outcome found = load_elsewhere(path);
    free(path);
    return found;
}

static void test_what_is_let_pass_fits(void **state)
{
    (void)state;
    long base = load_elsewhere(NULL).peak_kib;
    for (size_t i = 0; i < LSF_COUNT(shapes); i++) {
        uint64_t good = 1000, bad = good;
        outcome largest = load_shape(&shapes[i], good);
        assert_true(largest.loaded);
        while (load_shape(&shapes[i], bad *= 8).loaded)
            good = bad;
        while (bad > good + good / 4) {
            uint64_t middle = good + (bad - good) / 2;
            outcome found = load_shape(&shapes[i], middle);
            if (found.loaded) {
                good = middle;
                largest = found;
            } else {
                bad = middle;
            }
        }
        long peak = largest.peak_kib - base;
        print_message("%s: %llu take %ld KiB\n", shapes[i].name, (unsigned long long)good, peak);
#ifndef __SANITIZE_ADDRESS__ /* which pads every block and keeps freed ones */
        if (peak > (long)(MEMORY_LIMIT >> 10) + OVERHEAD_KIB)
            fail_msg("%s: %llu take %ld KiB", shapes[i].name, (unsigned long long)good, peak);
#endif
    }
}

static void test_of_a_shared_file_only_the_declared_bytes_are_kept(void **state)
{
    (void)state;
    lsf_string text = {0};
    lsf_string_add(&text, NOTHING_BUT "\"buffers\":[");
    for (int i = 0; i < 100; i++)
        lsf_string_add(&text, "%s{\"byteLength\":1,\"uri\":\"large.bin\"}", i ? "," : "");
    lsf_string_add(&text, "]}");
    char *path = lsf_format("%s/shared.gltf", gltf_folder);
    char *large = lsf_format("%s/large.bin", gltf_folder);
    FILE *file = fopen(large, "wb");
    assert_non_null(file);
    assert_int_equal(ftruncate(fileno(file), 20 << 20), 0);
    fclose(file);
    assert_true(lsf_file_write(path, text.text, text.length, NULL));
    long base = load_elsewhere(NULL).peak_kib;
    outcome found = load_elsewhere(path);
    assert_true(found.loaded);
    assert_true(found.peak_kib - base < 20 << 10);
    free(text.text);
    free(path);
    free(large);
}

static double seconds_of(clock_t ticks)
{
    return (double)ticks / CLOCKS_PER_SEC;
}

static void test_shared_data_is_checked_once(void **state)
{
    (void)state;
    enum { PRIMITIVES = 4000, TRIANGLES = 100000 };
    lsf_string text = {0};
    lsf_string_add(&text,
                   ONE_NODE "\"accessors\":[{\"componentType\":5126,\"type\":\"VEC3\","
                            "\"count\":%d}],\"meshes\":[{\"primitives\":[",
                   3 * TRIANGLES);
    for (int i = 0; i < PRIMITIVES; i++)
        lsf_string_add(&text, "%s{\"attributes\":{\"POSITION\":0,\"NORMAL\":0}}", i ? "," : "");
    lsf_string_add(&text, "]}]}");
    char *path = lsf_format("%s/share.gltf", gltf_folder);
    assert_true(lsf_file_write(path, text.text, text.length, NULL));
    clock_t start = clock();
    lsf_scene *scene = lsf_scene_load(path, NULL, NULL);
    assert_non_null(scene);
    assert_true(seconds_of(clock() - start) < 2.0);
    const lsf_requirements *found = lsf_scene_get_requirements(scene);
    assert_true(found->triangles == (uint64_t)PRIMITIVES * TRIANGLES);
    assert_int_equal(found->unique_triangles, TRIANGLES);
    assert_int_equal(found->degenerate_triangles, TRIANGLES);
    lsf_scene_destroy(scene);
    free(text.text);
    free(path);
}

static void test_notes_are_limited(void **state)
{
    (void)state;
    enum { TEXTURES = 20000 };
    lsf_string text = {0};
    lsf_string_add(&text, ONE_NODE "\"textures\":[");
    for (int i = 0; i < TEXTURES; i++)
        lsf_string_add(&text, "%s{}", i ? "," : "");
    lsf_string_add(&text, "],\"materials\":[");
    for (int i = 0; i < TEXTURES; i++)
        lsf_string_add(&text, "%s{\"normalTexture\":{\"index\":%d}}", i ? "," : "", i);
    lsf_string_add(&text,
                   "],\"accessors\":[{\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}],"
                   "\"meshes\":[{\"primitives\":[");
    for (int i = 0; i < TEXTURES; i++)
        lsf_string_add(&text, "%s{\"attributes\":{\"POSITION\":0},\"material\":%d}", i ? "," : "",
                       i);
    lsf_string_add(&text, "]}]}");
    char *path = lsf_format("%s/textures.gltf", gltf_folder);
    assert_true(lsf_file_write(path, text.text, text.length, NULL));
    lsf_scene *scene = lsf_scene_load(path, NULL, NULL);
    assert_non_null(scene);
    bool found = false;
    for (uint32_t i = 0; i < lsf_scene_note_count(scene); i++)
        found |= strstr(lsf_scene_note(scene, i), "20000 textures without a ") != NULL;
    assert_true(found);
    for (int i = 0; i < 1000; i++)
        lsf_scene_add_note(scene, "note %d", i);
    assert_true(lsf_scene_note_count(scene) < 300);
    assert_non_null(strstr(lsf_scene_note(scene, lsf_scene_note_count(scene) - 1), "more"));
    lsf_scene_destroy(scene);
    free(text.text);
    free(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_let_pass_fits),
        cmocka_unit_test(test_of_a_shared_file_only_the_declared_bytes_are_kept),
        cmocka_unit_test(test_shared_data_is_checked_once),
        cmocka_unit_test(test_notes_are_limited),
    };
    return cmocka_run_group_tests(tests, make_gltf_folder, remove_gltf_folder);
}
