/* The best configuration within a time, or the fastest to an error, with few measurements. */
#ifndef LSF_SWEEP_SEARCH_H
#define LSF_SWEEP_SEARCH_H

#include <lightsheaf/error.h>

#include "sweep/measurement.h"

/* Makes sure that the measurement has a point of so many seeds or more, with derived values,
 * unless the configuration fails. `*stopped` ends the search with the results so far. */
typedef bool lsf_search_measure(void *user, uint32_t configuration, uint32_t samples,
                                uint32_t seeds, bool *stopped, lsf_error *error);

typedef struct lsf_search {
    lsf_measurement *measurement; /* its configurations are the candidates */
    double budget_ms, relmse;     /* the request: one of them, the other is NAN */
    uint32_t seeds;               /* of the points that decide */
    uint32_t most_samples;
    lsf_search_measure *measure;
    void (*expect)(void *user, uint32_t iterations); /* number of iterations to come, as far as
                                                      * known; NULL allowed */
    void *user;
} lsf_search;

/* Fills in the measurement's answer, except its command.
 *
 * Within a time: by rungs, as in successive halving (Jamieson and Talwalkar 2016): frames of
 * 1/64 of the time, then four times as long at each rung. From the variance and bias of a
 * configuration, bounds of its error in the whole time are predicted. A third of the candidates
 * is dropped, and every one that is worse than another one even at its best. The last ones are
 * measured in the whole time, with as many samples as fit and with the power of 2 below, at
 * which low-discrepancy sequences are at their best; where the difference may be chance, with
 * twice as many seeds.
 *
 * To an error: the next step is that of the configuration whose next frame, with four times the
 * samples, is the shortest, until it reaches the error or until that frame would take longer
 * than one that did. */
bool lsf_search_run(const lsf_search *search, lsf_error *error);

#endif
