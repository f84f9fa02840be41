/* A look at JSON text before any parser sees it. */
#ifndef LSF_IO_JSON_SCAN_H
#define LSF_IO_JSON_SCAN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Deepest nesting of arrays and objects, found without recursion; the text need not be valid. */
uint64_t lsf_json_depth(const char *text, size_t length);

/* Line and column, both from 1, of the byte at `offset`. */
void lsf_json_location(const char *text, size_t length, size_t offset, uint64_t *line,
                       uint64_t *column);

#ifdef __cplusplus
}
#endif
#endif
