/* The configurations to measure: techniques times the values of options. */
#ifndef LSF_SWEEP_GRID_H
#define LSF_SWEEP_GRID_H

#include <lightsheaf/error.h>

#include "sweep/measurement.h"

/* Adds each technique with each combination of the values in `sweeps` of the options that it
 * takes ("vpl.count=4,16,64"). An option that no technique takes is LSF_ERROR_USAGE. */
bool lsf_sweep_grid_add(lsf_measurement *measurement, const char *const *techniques,
                        uint32_t technique_count, const char *const *sweeps, uint32_t sweep_count,
                        lsf_error *error);

#endif
