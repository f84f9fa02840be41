/* The times of published procedures, in the rows of a paper's table. */
#ifndef LSF_TOOLS_BENCH_TABLE_H
#define LSF_TOOLS_BENCH_TABLE_H

#include "tools/bench.h"

typedef struct lsf_bench_row {
    const char *title;
    double paper_ms;       /* NAN: the paper does not say */
    const char *passes[6]; /* of ours, by name */
} lsf_bench_row;

#define LSF_BENCH_MAX_ROWS 16

/* The last row counts the passes that no other row names. */
typedef struct lsf_bench_table {
    const lsf_bench_row *rows;
    size_t row_count;
    double ms[LSF_BENCH_MAX_ROWS];
    bool ran[LSF_BENCH_MAX_ROWS]; /* some pass of the row */
    double total_ms;
} lsf_bench_table;

/* Times `frames` frames after `warm_up` others; `rgb` has room for a picture of 8 bits. */
bool lsf_bench_table_measure(lsf_bench_table *table, lsf_renderer *renderer, uint8_t *rgb,
                             uint32_t warm_up, uint32_t frames, lsf_error *error);
/* The rows and their total, `paper_total_ms` beside it. */
bool lsf_bench_table_print(const lsf_bench_table *table, const lsf_bench *bench,
                           double paper_total_ms, lsf_error *error);
/* "rows", "total_ms" and "paper_total_ms" in the object that is open. */
void lsf_bench_table_add(const lsf_bench_table *table, lsf_json *json, double paper_total_ms);

#endif
