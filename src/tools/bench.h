/* `lightsheaf bench`: declarations that its measurements share. */
#ifndef LSF_TOOLS_BENCH_H
#define LSF_TOOLS_BENCH_H

#include "base/base.h"
#include "tools/json.h"
#include "tools/options.h"

typedef struct lsf_bench {
    lsf_settings settings;
    char *scene_path;
    lsf_scene *scene;
    lsf_context *context;
    lsf_context_info device;
    lsf_json json; /* its outermost object is open; each measurement adds its own */
} lsf_bench;

/* Each prints its lines as it goes, or adds to `json`. */
bool lsf_bench_rays(lsf_bench *bench, lsf_error *error);
/* The frames of the measurement that the first operand names. */
bool lsf_bench_frames(lsf_bench *bench, lsf_error *error);

/* Prints a part of the text on standard output at once; nothing with --json - or --quiet. */
bool lsf_bench_print(const lsf_bench *bench, lsf_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
