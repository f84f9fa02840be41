/* The reference of a measurement: from the cache, from the path tracer, or from both. */
#ifndef LSF_TOOLS_MEASURE_REFERENCE_H
#define LSF_TOOLS_MEASURE_REFERENCE_H

#include "sweep/measurement.h"
#include "sweep/reference.h"
#include "tools/options.h"
#include "tools/report.h"

/* Brings both halves to as many samples as are asked for, says in `measurement` what they are, and
 * writes them where pictures go. What was traced stays in the cache even if it is interrupted. */
bool lsf_measure_reference(const lsf_settings *settings, const lsf_scene *scene,
                           lsf_measurement *measurement, lsf_kept_reference *kept,
                           lsf_error *error);

#endif
