/* A shader folder of a test's own: the folders of glsl in the source tree, and files that the test
 * writes beside them. */
#ifndef LSF_TESTS_SHADER_FOLDER_H
#define LSF_TESTS_SHADER_FOLDER_H

#include "gl_test.h"

#include <ftw.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/base.h"

typedef struct shader_folder {
    char path[64];
} shader_folder;

static inline void shader_folder_create(shader_folder *folder)
{
    const char *root = getenv("LSF_SOURCE_ROOT");
    strcpy(folder->path, "lsf-shaders-XXXXXX");
    assert_non_null(mkdtemp(folder->path));
    static const char *const names[] = {"shared", "lib", "passes"};
    for (size_t i = 0; root && i < LSF_COUNT(names); i++) {
        char *target = lsf_format("%s/glsl/%s", root, names[i]);
        char *link = lsf_format("%s/%s", folder->path, names[i]);
        assert_int_equal(symlink(target, link), 0);
        free(target);
        free(link);
    }
}

static inline void shader_folder_write(const shader_folder *folder, const char *name,
                                       const char *text)
{
    char *path = lsf_format("%s/%s", folder->path, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
    free(path);
}

static inline int shader_folder_remove_one(const char *path, const struct stat *status, int type,
                                           struct FTW *walk)
{
    (void)status;
    (void)type;
    (void)walk;
    return remove(path);
}

static inline void shader_folder_destroy(const shader_folder *folder)
{
    nftw(folder->path, shader_folder_remove_one, 8, FTW_DEPTH | FTW_PHYS);
}

#endif
