/* Consecutive frames: their error, that of the changes between them, and flicker. */
#ifndef LSF_SWEEP_PATH_H
#define LSF_SWEEP_PATH_H

#include "sweep/run.h"

/* The view of a frame, and its reference; borrowed. */
typedef struct lsf_path_frame {
    double time; /* seconds */
    lsf_view view;
    const lsf_image *halves[2];
} lsf_path_frame;

/* Renders the frames of a path in order, with as many samples each as the point has, then as
 * many frames of its first view in which nothing moves, for each of the point's seeds. Fills in
 * the point's path unless it was told to stop, which leaves *stopped true. */
bool lsf_sweep_run_path(const lsf_sweep_stage *stage, lsf_measurement *measurement,
                        lsf_measured_point *point, const lsf_path_frame *frames, uint32_t count,
                        bool temporal, bool *stopped, lsf_error *error);

/* Errors of a picture and of its change from the one before, without the noise of the reference.
 * Weighted as relMSE weights the later frame. */
typedef struct lsf_path_change {
    double difference; /* mean(w ((x_t - x_s) - (r_t - r_s))^2) */
    double motion;     /* mean(w (r_t - r_s)^2): the change of the reference itself */
} lsf_path_change;

lsf_path_change lsf_path_change_of(const lsf_image *now, const lsf_image *before,
                                   const lsf_image *const halves_now[2],
                                   const lsf_image *const halves_before[2]);

/* mean(w (x - y)^2), weighted by the reference's halves likewise. */
double lsf_path_flicker_of(const lsf_image *x, const lsf_image *y,
                           const lsf_image *const halves[2]);

#endif
