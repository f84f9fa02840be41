/* Holds the files of the table against what is expected of them. */
#ifndef LSF_TESTS_GLTF_CASES_H
#define LSF_TESTS_GLTF_CASES_H

#include "gltf_folder.h"

#include <lightsheaf/scene.h>

#include <time.h>

/* Seconds of processor time, so that a busy machine does not fail the test; what waits instead of
 * working (a pipe) runs into the test's own time limit. Sanitizers make it all several times
 * slower; a million nodes are the one big file. */
#define TIME_LIMIT 5.0
#define TIME_LIMIT_MILLION 60.0

static bool has_note(const lsf_scene *scene, const char *part)
{
    for (uint32_t i = 0; i < lsf_scene_note_count(scene); i++)
        if (strstr(lsf_scene_note(scene, i), part))
            return true;
    return *part == '\0';
}

/* Loads the file and reports what differs from the expectation. */
static bool check_case(const char *path, const char *expected, const char *triangles,
                       const char *note)
{
    lsf_error error = {0};
    clock_t start = clock();
    lsf_scene *scene = lsf_scene_load(path, NULL, &error);
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    double limit = strstr(path, "million") ? TIME_LIMIT_MILLION : TIME_LIMIT;
    bool wanted = strcmp(expected, "ok") == 0, good = seconds < limit;
    if (!good)
        print_error("%s: took %.1f s\n", path, seconds);
    if (!scene) {
        bool named = !wanted && error.code == LSF_ERROR_FILE && strstr(error.message, expected) &&
                     strncmp(error.message, path, strlen(path)) == 0;
        if (!named)
            print_error("%s: expected %s, got: %s\n", path, expected, error.message);
        return good && named;
    }
    unsigned long long count = lsf_scene_get_requirements(scene)->triangles;
    if (!wanted || (*triangles && count != strtoull(triangles, NULL, 10)) ||
        !has_note(scene, note)) {
        print_error("%s: expected %s, %s triangles, note \"%s\"; loaded %llu triangles\n", path,
                    expected, triangles, note, count);
        good = false;
    }
    lsf_scene_destroy(scene);
    return good;
}

/* Every file of the table; *state points to the number of them that there are at least. */
static void test_cases(void **state)
{
    size_t cases_min = *(const size_t *)*state;
    char *table_path = lsf_format("%s/cases.tsv", gltf_folder);
    FILE *table = fopen(table_path, "r");
    assert_non_null(table);
    char *line = NULL;
    size_t capacity = 0;
    size_t failures = 0, count = 0;
    while (getline(&line, &capacity, table) > 0) {
        char *rest = line;
        line[strcspn(line, "\n")] = '\0';
        char *name = strsep(&rest, "\t"), *expected = strsep(&rest, "\t");
        char *triangles = strsep(&rest, "\t");
        assert_non_null(rest);
        char *path = lsf_format("%s/%s", gltf_folder, name);
        failures += !check_case(path, expected, triangles, rest);
        count++;
        free(path);
    }
    free(line);
    free(table_path);
    fclose(table);
    assert_true(count >= cases_min);
    assert_int_equal(failures, 0);
}

#endif
