/* What a measurement measures where the command line leaves it open. */
#ifndef LSF_TOOLS_MEASURE_PRESETS_H
#define LSF_TOOLS_MEASURE_PRESETS_H

#include "tools/options.h"

/* Fills in techniques, sweeps, samples, seeds and samples of the reference that were not given. An
 * answer looks at more options than a table does. */
bool lsf_measure_fill_in(lsf_settings *settings, lsf_error *error);

#endif
