/* The best configuration within a time, or the soonest to an error, by few measurements. */
#ifndef LSF_SWEEP_SEARCH_H
#define LSF_SWEEP_SEARCH_H

#include <lightsheaf/error.h>

#include "sweep/measurement.h"

/* Sees to it that the measurement has a point of so many seeds or more, worked out, unless the
 * configuration fails. `*stopped` tells that it shall end, with what there is. */
typedef bool lsf_search_measure(void *user, uint32_t configuration, uint32_t samples,
                                uint32_t seeds, bool *stopped, lsf_error *error);

typedef struct lsf_search {
    lsf_measurement *measurement; /* its configurations are the candidates */
    double budget_ms, relmse;     /* what is asked for: one of them, the other is NAN */
    uint32_t seeds;               /* of the points that decide */
    uint32_t most_samples;
    lsf_search_measure *measure;
    void (*expect)(void *user, uint32_t iterations); /* to come, as far as known; NULL */
    void *user;
} lsf_search;

/* Fills in the measurement's answer, all but its command.
 *
 * Within a time: by rungs, as in successive halving (Jamieson and Talwalkar 2016): frames of 1/64
 * of the time, then of four times as long as those before. What a configuration's error will be in
 * the whole time is foretold within bounds by what of it is variance and what bias; a third is left
 * behind, and whatever is worse than another one even at the best of its bounds. The last ones are
 * measured in the whole time, with as many samples as fit and with the power of 2 below, at which
 * low-discrepancy sequences are at their best; and where chance may have decided, from twice as
 * many seeds.
 *
 * To an error: the configuration goes on whose next frame, of four times the samples, takes the
 * shortest, until it gets there or until that frame would take longer than one that did. */
bool lsf_search_run(const lsf_search *search, lsf_error *error);

#endif
