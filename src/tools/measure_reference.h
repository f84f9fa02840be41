/* The reference of a measurement: from the cache, from the path tracer, or from both. */
#ifndef LSF_TOOLS_MEASURE_REFERENCE_H
#define LSF_TOOLS_MEASURE_REFERENCE_H

#include "sweep/measurement.h"
#include "sweep/reference.h"
#include "tools/options.h"
#include "tools/report.h"

/* Brings the halves of a view to as many samples as are asked for; `key` gets what tells it apart.
 * What was traced stays in the cache even if it is interrupted. */
bool lsf_measure_trace(const lsf_settings *settings, const lsf_scene *scene,
                       const lsf_render_params *params, lsf_kept_reference *kept, char key[33],
                       lsf_error *error);

/* The same of the view that is measured: says in `measurement` what it is, and writes it where
 * pictures go. */
bool lsf_measure_reference(const lsf_settings *settings, const lsf_scene *scene,
                           lsf_measurement *measurement, lsf_kept_reference *kept,
                           lsf_error *error);

#endif
