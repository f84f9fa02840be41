/* Files that are not glTF, recognised by their first bytes and the ending of their name. */
#ifndef LSF_IO_FOREIGN_FILE_H
#define LSF_IO_FOREIGN_FILE_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lsf_foreign_file {
    const char *what;   /* "a Wavefront OBJ file" */
    const char *remedy; /* what to do about it */
} lsf_foreign_file;

/* NULL when the file may be glTF. */
const lsf_foreign_file *lsf_foreign_file_find(const char *path, const void *bytes, size_t length);

/* Whether the bytes are what a repository holds in place of a file that Git LFS stores elsewhere.
 */
bool lsf_is_git_lfs_pointer(const void *bytes, size_t length);

#ifdef __cplusplus
}
#endif
#endif
