/* The time of a frame. */
#ifndef LSF_SWEEP_STOPWATCH_H
#define LSF_SWEEP_STOPWATCH_H

#include <lightsheaf/lightsheaf.h>

#include "sweep/measurement.h"

typedef struct lsf_stopwatch {
    lsf_clock clock;
    double start; /* [s] */
} lsf_stopwatch;

/* Discards the pass times so far. */
lsf_stopwatch lsf_stopwatch_start(lsf_clock clock, lsf_renderer *renderer);

/* Milliseconds of the frame, after lsf_renderer_run, which waits until it is done. Pass times
 * are stored in the point, where one is given. */
double lsf_stopwatch_stop(const lsf_stopwatch *watch, lsf_renderer *renderer,
                          lsf_measured_point *point);

#endif
