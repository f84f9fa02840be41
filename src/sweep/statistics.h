/* Medians, means and their confidence intervals. */
#ifndef LSF_SWEEP_STATISTICS_H
#define LSF_SWEEP_STATISTICS_H

#include "sweep/measurement.h"

/* Quartiles by interpolation (Hyndman and Fan 1996, type 7). NAN without values. Sorts `values`. */
lsf_quartiles lsf_quartiles_of(double *values, size_t count);

/* Median of independent values, with an interval of at least 95 % between two of them, whatever
 * their distribution (Conover 1971, "Practical Nonparametric Statistics", section 3.2): for nine
 * values the second and the last but one. Fewer than six have none. Sorts `values`. */
lsf_estimate lsf_median_of(double *values, size_t count);

/* The quantile 0.975 of Student's distribution. */
double lsf_student_quantile(uint32_t degrees);
/* P(T <= t). */
double lsf_student_probability(double t, uint32_t degrees);

/* Mean of independent values, with an interval by Student's distribution; `shared` is the
 * standard deviation of an error that they all share. A single value has no interval. */
lsf_estimate lsf_mean_of(const double *values, uint32_t count, double shared);

/* `value` with an interval by the jackknife (Tukey 1958): `left_out[s]` is the value computed
 * without s. */
lsf_estimate lsf_jackknife(double value, const double *left_out, uint32_t count, double shared);

#endif
