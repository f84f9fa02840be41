/* Going on with a measurement that was written before. */
#ifndef LSF_TOOLS_MEASURE_READ_H
#define LSF_TOOLS_MEASURE_READ_H

#include <lightsheaf/error.h>

#include "sweep/measurement.h"

/* Takes the points from JSON that lsf_measure_add_json made, of configurations that are in the
 * measurement or are added to it. LSF_ERROR_FILE when it is none, or when its key says that
 * something else was measured. What follows from the points is not worked out. */
bool lsf_measure_read(lsf_measurement *measurement, const char *path, lsf_error *error);

#endif
