/* A measurement as JSON and as CSV; docs/measure.md says what each name means. */
#ifndef LSF_TOOLS_MEASURE_JSON_H
#define LSF_TOOLS_MEASURE_JSON_H

#include <lightsheaf/context.h>

#include "sweep/measurement.h"
#include "tools/prices.h"

/* The whole measurement, as one object. */
void lsf_measure_add_json(lsf_json *json, const lsf_measurement *measurement,
                          const lsf_context_info *device, const lsf_prices *prices);

/* A line of names, then one for each point (RFC 4180). */
void lsf_measure_add_csv(lsf_string *text, const lsf_measurement *measurement);

#endif
