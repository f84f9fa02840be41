/* A measurement as a table at the terminal. */
#ifndef LSF_TOOLS_MEASURE_TABLE_H
#define LSF_TOOLS_MEASURE_TABLE_H

#include "base/base.h"
#include "sweep/measurement.h"

/* All points, or where there is an answer, those of the Pareto front and the answer's. */
void lsf_measure_add_table(lsf_string *text, const lsf_measurement *measurement);

#endif
