/* What a search found, for people and as a preset. */
#ifndef LSF_TOOLS_MEASURE_ANSWER_H
#define LSF_TOOLS_MEASURE_ANSWER_H

#include "base/base.h"
#include "sweep/measurement.h"
#include "tools/options.h"

/* A paragraph, and the command that renders it. */
void lsf_measure_add_answer(lsf_string *text, const lsf_measurement *measurement);

/* Technique, options and samples, and what of the picture was given beside them. */
bool lsf_measure_save_preset(const char *path, const lsf_settings *settings,
                             const lsf_measurement *measurement, lsf_error *error);

#endif
