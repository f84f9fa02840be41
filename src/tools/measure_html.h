/* The HTML report of a measurement, and the pictures that it takes. */
#ifndef LSF_TOOLS_MEASURE_HTML_H
#define LSF_TOOLS_MEASURE_HTML_H

#include <lightsheaf/context.h>

#include "sweep/measurement.h"
#include "tools/options.h"
#include "tools/prices.h"

/* Where a report is asked for and no folder for pictures: one that lasts as long as the command.
 * Sets settings->picture_folder. */
bool lsf_measure_begin_pictures(lsf_settings *settings, char **folder, lsf_error *error);
/* Removes that folder with its pictures, of which the measurement speaks no more. NULL allowed. */
void lsf_measure_end_pictures(lsf_measurement *measurement, char **folder);

/* Nothing without a path. */
bool lsf_measure_write_html(const lsf_measurement *measurement, const lsf_context_info *device,
                            const lsf_prices *prices, const char *path, lsf_error *error);

#endif
