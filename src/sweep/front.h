/* Error against time: the Pareto front, gains, and times to an error. */
#ifndef LSF_SWEEP_FRONT_H
#define LSF_SWEEP_FRONT_H

#include "sweep/measurement.h"

/* Marks the points that are not dominated: no other point has less relMSE in as little time, or
 * as little in less. */
void lsf_front_mark(lsf_measured_point *points, uint32_t count);

/* Gain in SSIM over the point of the lowest SSIM, for each additional millisecond (Tatzgern
 * 2020, table 6.1), in per cent. */
void lsf_front_gain(lsf_measured_point *points, uint32_t count);

/* Time at which a configuration reaches a relMSE: between points of its curve by a straight line
 * in logarithms of samples and error, beyond the last one by the fit. */
lsf_time_to_error lsf_front_time_to(const lsf_measurement *measurement, uint32_t configuration,
                                    double relmse);

/* Times of all configurations to the powers of 10 and half powers between the largest and the
 * smallest error measured. False when memory is exhausted. */
bool lsf_front_times(lsf_measurement *measurement);

/* Milliseconds of a frame with so many samples, from its points' medians: by a line through the
 * nearest two, or in proportion to the only one. NAN without points. */
double lsf_front_milliseconds(const lsf_measurement *measurement, uint32_t configuration,
                              double samples);

#endif
