#include "tools/bench_table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static size_t row_of(const lsf_bench_table *t, const char *pass)
{
    size_t others = t->row_count - 1;
    for (size_t r = 0; r < others; r++)
        for (size_t i = 0; i < LSF_COUNT(t->rows[r].passes) && t->rows[r].passes[i]; i++)
            if (strcmp(t->rows[r].passes[i], pass) == 0)
                return r;
    return others;
}

/* Adds the times of all passes since the renderer was made, times `sign`. */
static void add_passes(lsf_bench_table *t, lsf_renderer *renderer, double sign)
{
    lsf_renderer_stats stats = lsf_renderer_get_stats(renderer);
    for (uint32_t i = 0; i < stats.pass_count; i++) {
        size_t row = row_of(t, stats.passes[i].name);
        t->ms[row] += sign * stats.passes[i].milliseconds * (double)stats.samples;
        t->ran[row] = t->ran[row] || stats.passes[i].runs > 0;
    }
}

static bool iterate(lsf_renderer *renderer, uint32_t frames, lsf_error *error)
{
    for (uint32_t i = 0; i < frames; i++)
        if (!lsf_renderer_iterate(renderer, error))
            return false;
    return true;
}

static double sum_of(const lsf_bench_table *t)
{
    double sum = 0.0;
    for (size_t r = 0; r < t->row_count; r++)
        sum += t->ms[r];
    return sum;
}

/* Tone mapping belongs to the output, reading it back does not: it runs separately, by its own
 * timer. */
bool lsf_bench_table_measure(lsf_bench_table *t, lsf_renderer *renderer, uint8_t *rgb,
                             uint32_t warm_up, uint32_t frames, lsf_error *error)
{
    bool good = iterate(renderer, warm_up, error) &&
                lsf_renderer_read_rgb8(renderer, 0.0f, LSF_TONE_CURVE_NEUTRAL, rgb, error);
    add_passes(t, renderer, -1.0); /* which waits until all is done */
    lsf_bench_table before = *t;
    double start = lsf_now();
    good = good && iterate(renderer, frames, error);
    add_passes(t, renderer, 1.0);
    double milliseconds = 1e3 * (lsf_now() - start);
    lsf_bench_table drawn = *t;
    for (uint32_t i = 0; good && i < frames; i++)
        good = lsf_renderer_read_rgb8(renderer, 0.0f, LSF_TONE_CURVE_NEUTRAL, rgb, error);
    *t = before;
    add_passes(t, renderer, 1.0);
    milliseconds += sum_of(t) - sum_of(&drawn);
    for (size_t r = 0; r < t->row_count; r++)
        t->ms[r] /= frames;
    t->total_ms = milliseconds / frames;
    t->ms[t->row_count - 1] += t->total_ms - sum_of(t);
    t->ran[t->row_count - 1] = true;
    return good;
}

static bool print_row(const lsf_bench *bench, const char *title, bool ran, double ms,
                      double paper_ms, lsf_error *error)
{
    char ours[32] = "-", theirs[32] = "-";
    if (ran)
        snprintf(ours, sizeof ours, "%.2f", ms);
    if (!isnan(paper_ms))
        snprintf(theirs, sizeof theirs, "%.1f", paper_ms);
    return lsf_bench_print(bench, error, "%-42s%10s%10s\n", title, ours, theirs);
}

bool lsf_bench_table_print(const lsf_bench_table *t, const lsf_bench *bench, double paper_total_ms,
                           lsf_error *error)
{
    bool good = lsf_bench_print(bench, error, "%-42s%10s%10s\n", "procedure", "ms", "paper ms");
    for (size_t r = 0; good && r < t->row_count; r++)
        good = print_row(bench, t->rows[r].title, t->ran[r], t->ms[r], t->rows[r].paper_ms, error);
    return good && print_row(bench, "Total", true, t->total_ms, paper_total_ms, error);
}

void lsf_bench_table_add(const lsf_bench_table *t, lsf_json *json, double paper_total_ms)
{
    lsf_json_begin(json, "rows", '[');
    for (size_t r = 0; r < t->row_count; r++) {
        lsf_json_begin(json, NULL, '{');
        lsf_json_string(json, "procedure", t->rows[r].title);
        lsf_json_number(json, "ms", t->ran[r] ? t->ms[r] : NAN);
        lsf_json_number(json, "paper_ms", t->rows[r].paper_ms);
        lsf_json_begin(json, "passes", '[');
        for (size_t i = 0; i < LSF_COUNT(t->rows[r].passes) && t->rows[r].passes[i]; i++)
            lsf_json_string(json, NULL, t->rows[r].passes[i]);
        lsf_json_end(json, ']');
        lsf_json_end(json, '}');
    }
    lsf_json_end(json, ']');
    lsf_json_number(json, "total_ms", t->total_ms);
    lsf_json_number(json, "paper_total_ms", paper_total_ms);
}
