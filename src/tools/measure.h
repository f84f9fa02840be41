/* A measurement in progress. */
#ifndef LSF_TOOLS_MEASURE_H
#define LSF_TOOLS_MEASURE_H

#include "base/base.h"
#include "sweep/measurement.h"
#include "sweep/path.h"
#include "sweep/reference.h"
#include "tools/options.h"
#include "tools/prices.h"
#include "tools/report.h"

typedef struct lsf_measure_job {
    lsf_settings settings;
    char *scene_path;
    lsf_scene *scene;
    lsf_context *context;
    lsf_context_info device;
    lsf_kept_reference reference;
    lsf_path_frame *frames; /* of the path; NULL: none is measured */
    lsf_kept_reference *frame_references;
    uint32_t frame_count;
    lsf_string path_key; /* of their references */
    lsf_measurement measurement;
    lsf_progress_bar bar;
    uint32_t done, total; /* iterations, as far as they are foreseen */
    double start;
    lsf_prices prices;    /* of the first technique; none unless they are asked for */
    char *picture_folder; /* that lasts as long as the command; NULL: none */
} lsf_measure_job;

/* Where frames are asked for: their views and references, which the measurement's key depends on.
 * End it either way. */
bool lsf_measure_begin_path(lsf_measure_job *job, lsf_error *error);
void lsf_measure_end_path(lsf_measure_job *job);

/* Measures the grid, or searches it for what is asked for. An interrupt ends it with what there is.
 * After each point the file of --json is written anew. */
bool lsf_measure_points(lsf_measure_job *job, lsf_error *error);

/* Where prices are asked for: plans and times frames without each feature of the scene. */
bool lsf_measure_prices(lsf_measure_job *job, lsf_error *error);

/* Writes the JSON where --json says. What follows from the points is worked out first. */
bool lsf_measure_write_json(lsf_measure_job *job, lsf_error *error);

/* The shell command that renders a configuration: with so many samples, or 0: without saying how
 * many. malloc'ed; NULL without memory. */
char *lsf_measure_command(const lsf_measure_job *job, uint32_t configuration, uint32_t samples);

#endif
