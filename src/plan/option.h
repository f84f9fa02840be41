/* Options of passes: one table a pass drives the command line, its help, and the JSON. */
#ifndef LSF_PLAN_OPTION_H
#define LSF_PLAN_OPTION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lightsheaf/error.h>
#include <lightsheaf/renderer.h>

typedef enum lsf_option_type {
    LSF_OPTION_INT,   /* int32_t */
    LSF_OPTION_FLOAT, /* float */
    LSF_OPTION_BOOL,  /* bool */
    LSF_OPTION_ENUM,  /* int32_t: index into choices */
} lsf_option_type;

typedef struct lsf_option_row {
    const char *key; /* "pass.key" */
    lsf_option_type type;
    size_t offset;           /* of the value in the pass's params */
    double minimum, maximum; /* inclusive; int and float */
    const char *choices;     /* "none|pcf"; enum */
    const char *unit;
    const char *help;
} lsf_option_row;

typedef struct lsf_option_table {
    const lsf_option_row *rows;
    uint32_t count;
    const void *defaults; /* params of the pass as its _DEFAULTS say */
    size_t params_offset; /* of the pass's params in the struct of all passes' params */
} lsf_option_table;

/* Sets the option that `assignment` ("key=value") names in `params`, the struct that holds every
 * pass's params. LSF_ERROR_USAGE names the key, the value and what is allowed. */
bool lsf_option_set(const lsf_option_table *tables, uint32_t table_count, void *params,
                    const char *assignment, lsf_error *error);

/* The `index`-th option over all tables, as text; the text lives until the next call on the same
 * thread. False past the end. */
bool lsf_option_at(const lsf_option_table *tables, uint32_t table_count, uint32_t index,
                   lsf_option *option);

#endif
