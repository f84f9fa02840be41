/* A JSON text written from front to back; commas and indentation take care of themselves. */
#ifndef LSF_TOOLS_JSON_H
#define LSF_TOOLS_JSON_H

#include "base/base.h"

typedef struct lsf_json {
    lsf_string text;
    uint32_t depth;
    bool filled; /* something stands before, in the same object or array */
} lsf_json;

/* `name` NULL: an element of an array, or the whole text. */
void lsf_json_begin(lsf_json *json, const char *name, char bracket);       /* '{' or '[' */
void lsf_json_end(lsf_json *json, char bracket);                           /* '}' or ']' */
void lsf_json_string(lsf_json *json, const char *name, const char *value); /* NULL: null */
void lsf_json_number(lsf_json *json, const char *name, double value);      /* not finite: null */
void lsf_json_integer(lsf_json *json, const char *name, uint64_t value);
void lsf_json_bool(lsf_json *json, const char *name, bool value);
/* The members of a malloc'ed JSON text that is an object, which it frees; NULL: there was no memory
 * for it. */
void lsf_json_members(lsf_json *json, char *object);
/* The whole text to a file, or to standard output by "-"; nothing without a path. */
bool lsf_json_write(const lsf_json *json, const char *path, lsf_error *error);
/* A short array on one line; `values` NULL: null. */
void lsf_json_vector(lsf_json *json, const char *name, const float *values, uint32_t count);

#endif
