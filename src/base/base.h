/* What every layer uses: checked allocation, strings, files. */
#ifndef LSF_BASE_BASE_H
#define LSF_BASE_BASE_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lightsheaf/error.h>
#include <lightsheaf/log.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Whether an argument of a public function is there; else LSF_ERROR_USAGE calls it by its name. */
bool lsf_given(const void *argument, const char *name, lsf_error *error);

#define LSF_COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* NULL when count * size overflows or memory is short; zeroed. Freed with free(). */
void *lsf_alloc(uint64_t count, uint64_t size);

/* Grows `*array` (capacity in elements) to hold at least `needed`; keeps the content. */
bool lsf_grow(void **array, uint64_t *capacity, uint64_t needed, uint64_t size);

/* The program may have set a locale with a decimal comma: what is formatted or read here has a
 * point, as JSON, GLSL and options do. */
double lsf_read_number(const char *text, char **end);
int lsf_format_plain(char *buffer, size_t size, const char *format, va_list arguments)
    __attribute__((format(printf, 3, 0)));
int lsf_print(char *buffer, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* "s", or "" for one. */
const char *lsf_plural(uint64_t count);

/* Makes control characters question marks: names in files could steer a terminal. */
void lsf_make_printable(char *text);

/* malloc'ed formatted text; NULL without memory. */
char *lsf_format(const char *format, ...) __attribute__((format(printf, 1, 2)));
char *lsf_format_arguments(const char *format, va_list arguments)
    __attribute__((format(printf, 1, 0)));

/* Text that grows; `text` is always NUL-terminated once something was added. */
typedef struct lsf_string {
    char *text;
    size_t length, capacity;
    bool failed; /* memory ran out; the text is cut */
} lsf_string;
void lsf_string_add(lsf_string *string, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void lsf_string_add_bytes(lsf_string *string, const char *bytes, size_t length);
/* Adds a number of bytes for people, "1.50 MiB". */
void lsf_string_add_size(lsf_string *string, double bytes);
/* Adds `text` as a JSON string with quotes; control characters and invalid UTF-8 are escaped. */
void lsf_string_add_json(lsf_string *string, const char *text);
/* Adds a JSON number; null when it is not finite. */
void lsf_string_add_json_number(lsf_string *string, double value);

/* Seconds from a monotonic clock. */
double lsf_now(void);
/* Seconds for which the calling thread has had a processor. */
double lsf_thread_seconds(void);

/* Reads a regular file of at most `limit` bytes; a NUL follows the content. Refuses FIFOs,
 * devices and directories without blocking. LSF_ERROR_FILE on failure; the caller frees. */
char *lsf_file_read(const char *path, uint64_t limit, size_t *length, lsf_error *error);

/* The same for a file of any size, of which the first `most` bytes are read. */
char *lsf_file_read_start(const char *path, uint64_t most, size_t *length, lsf_error *error);

/* The rest of standard input, of at most `limit` bytes; else as lsf_file_read. */
char *lsf_file_read_standard_input(uint64_t limit, size_t *length, lsf_error *error);

/* Whether there is no file `relative` below `folder`; false for paths that lead out of it. */
bool lsf_path_is_absent(const char *folder, const char *relative);

/* The real path of `relative` below `folder`, for files that a file names: absolute paths, ".."
 * and symbolic links that lead out of the folder are refused. malloc'ed; NULL on failure. */
char *lsf_path_confine(const char *folder, const char *relative, lsf_error *error);

/* A file written aside and renamed on commit, so that readers see the old or the new one whole. */
typedef struct lsf_atomic_file {
    char *path, *temporary_path; /* temporary_path is in the same folder, made with mode 0666 &
                                  * ~umask; it is `path` itself for devices and FIFOs */
} lsf_atomic_file;
bool lsf_atomic_file_begin(lsf_atomic_file *file, const char *path, lsf_error *error);
bool lsf_atomic_file_commit(lsf_atomic_file *file, lsf_error *error); /* fsync, rename */
void lsf_atomic_file_abort(
    lsf_atomic_file *file); /* removes the temporary; harmless after commit */
/* Removes every temporary that is still open; async-signal-safe, for interrupt handlers. */
void lsf_atomic_file_abort_all(void);
/* Whether a file could be written there; goes as far as one can without touching one that is there
 * already. */
bool lsf_file_can_write(const char *path, lsf_error *error);
/* Begin, write, commit. Path "-" is standard output. */
bool lsf_file_write(const char *path, const void *bytes, size_t length, lsf_error *error);

/* dlopen()s NAME.so, a part of the library that is loaded on first use: from the folders in the
 * environment variable LIGHTSHEAF_MODULE_DIR (separated by colons), beside the library or the
 * executable, or where it was installed. Never closed. NULL with LSF_ERROR_FILE, whose message
 * ends with `hint`: the package or the build option to look for. */
void *lsf_module_open(const char *name, const char *hint, lsf_error *error);

/* The table of functions that the module exports under `symbol`, opened on the first call and kept
 * in *loaded; safe from any thread. NULL with LSF_ERROR_FILE. */
const void *lsf_module_table(const char *name, const char *symbol, const char *hint,
                             const void **loaded, lsf_error *error);

#ifdef __cplusplus
}
#endif
#endif
