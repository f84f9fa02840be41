/* What a millisecond buys: the Pareto front, gains, and times to an error. */
#ifndef LSF_SWEEP_FRONT_H
#define LSF_SWEEP_FRONT_H

#include "sweep/measurement.h"

/* Marks the points for which no other one has less relMSE in as little time, nor as little in
 * less. */
void lsf_front_mark(lsf_measured_point *points, uint32_t count);

/* Gain in SSIM for each millisecond more than the point of the lowest SSIM takes (Tatzgern 2020,
 * table 6.1), in per cent. */
void lsf_front_gain(lsf_measured_point *points, uint32_t count);

/* When a configuration gets to a relMSE: between points of its curve by a straight line in
 * logarithms of samples and error, beyond the last one by the fit. */
lsf_time_to_error lsf_front_time_to(const lsf_measurement *measurement, uint32_t configuration,
                                    double relmse);

/* All configurations' times to the powers of 10 and half powers between the largest and the
 * smallest error measured. False without memory. */
bool lsf_front_times(lsf_measurement *measurement);

/* Milliseconds of a frame of so many samples, by its points' medians: a line through the nearest
 * two, or in proportion to the only one. NAN of none. */
double lsf_front_milliseconds(const lsf_measurement *measurement, uint32_t configuration,
                              double samples);

#endif
