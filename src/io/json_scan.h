/* A look at JSON text before any parser sees it. */
#ifndef LSF_IO_JSON_SCAN_H
#define LSF_IO_JSON_SCAN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The structure outside of strings, found without recursion; the text need not be valid. */
typedef struct lsf_json_shape {
    uint64_t depth; /* deepest nesting of arrays and objects */
    uint64_t objects, arrays, strings, commas;
} lsf_json_shape;
lsf_json_shape lsf_json_scan(const char *text, size_t length);

/* Line and column, both from 1, of the byte at `offset`. */
void lsf_json_location(const char *text, size_t length, size_t offset, uint64_t *line,
                       uint64_t *column);

#ifdef __cplusplus
}
#endif
#endif
