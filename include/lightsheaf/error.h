/* Errors: a code that doubles as the command's exit status, and one sentence for the user. */
#ifndef LIGHTSHEAF_ERROR_H
#define LIGHTSHEAF_ERROR_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

typedef enum lsf_error_code {
    LSF_OK = 0,
    LSF_ERROR_RENDER =
        1,               /* rendering failed: GL error, lost context, out of memory, shader error */
    LSF_ERROR_USAGE = 2, /* an option or argument is wrong */
    LSF_ERROR_FILE = 3,  /* a file is missing, unreadable, malformed or cannot be written */
    LSF_ERROR_NO_GL = 4, /* no OpenGL 4.5 context could be made */
    LSF_ERROR_DIFFERS = 5, /* compared images differ by more than a threshold */
} lsf_error_code;

#define LSF_ERROR_MESSAGE_SIZE 4096

/* Filled by a failing call; untouched by a succeeding one. The message names the file or option,
 * the cause, and what to do about it; it has no trailing newline. */
typedef struct lsf_error {
    lsf_error_code code;
    char message[LSF_ERROR_MESSAGE_SIZE];
} lsf_error;

/* Formats into `error` (NULL allowed) and returns false, so that a failing function can end with
 * `return lsf_error_set(error, LSF_ERROR_FILE, "%s: ...", path);`. */
bool lsf_error_set(lsf_error *error, lsf_error_code code, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 3, 4)))
#endif
    ;

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
