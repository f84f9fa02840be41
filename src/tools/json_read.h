/* A JSON text (RFC 8259) as values, for files that the command wrote itself. */
#ifndef LSF_TOOLS_JSON_READ_H
#define LSF_TOOLS_JSON_READ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lightsheaf/error.h>

typedef enum lsf_json_kind {
    LSF_JSON_NULL,
    LSF_JSON_BOOL,
    LSF_JSON_NUMBER,
    LSF_JSON_STRING,
    LSF_JSON_ARRAY,
    LSF_JSON_OBJECT,
} lsf_json_kind;

typedef struct lsf_json_value {
    lsf_json_kind kind;
    const char *name;  /* of a member; NULL: none */
    const char *text;  /* of a string */
    double number;     /* 0 or 1 of a bool; NAN unless it is a number */
    uint32_t next;     /* index of what stands behind it in array or object; 0: nothing */
    uint32_t children; /* index of the first one in it; 0: none */
} lsf_json_value;

typedef struct lsf_json_document {
    char *text;
    uint32_t count;
    uint64_t capacity;
    lsf_json_value *values; /* the first one is the whole */
} lsf_json_document;

/* LSF_ERROR_FILE names `path` and the line. Finish it either way. */
bool lsf_json_parse(lsf_json_document *document, const char *text, size_t length, const char *path,
                    lsf_error *error);
void lsf_json_document_finish(lsf_json_document *document);

/* The first value in an array or object, and the one behind another; NULL: none. */
const lsf_json_value *lsf_json_first(const lsf_json_document *document,
                                     const lsf_json_value *value);
const lsf_json_value *lsf_json_next(const lsf_json_document *document, const lsf_json_value *value);

/* A member of an object; NULL where there is no such one, or no such object. */
const lsf_json_value *lsf_json_find(const lsf_json_document *document, const lsf_json_value *object,
                                    const char *name);
/* The number or the text of a member; NAN or NULL where there is none. */
double lsf_json_find_number(const lsf_json_document *document, const lsf_json_value *object,
                            const char *name);
const char *lsf_json_find_string(const lsf_json_document *document, const lsf_json_value *object,
                                 const char *name);

#endif
