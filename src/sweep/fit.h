/* Separates an error into noise and floor. */
#ifndef LSF_SWEEP_FIT_H
#define LSF_SWEEP_FIT_H

#include "sweep/measurement.h"

/* Computes error, squared bias and variance from the products of `seeds` seeds. */
void lsf_squared_error_derive(lsf_squared_error *error, uint32_t seeds);

/* Fits error(N) = floor + noise N^-p to points of one configuration with as many seeds each: the
 * variance over seeds is a power of N, the squared bias a floor plus a part that falls like the
 * variance. Intervals are by the jackknife over seeds. */
lsf_error_fit lsf_error_fit_make(const lsf_squared_error *const *errors, const uint32_t *samples,
                                 uint32_t points, uint32_t seeds);

/* The error that the fit predicts for a number of samples. */
double lsf_error_fit_at(const lsf_error_fit *fit, double samples);

#endif
