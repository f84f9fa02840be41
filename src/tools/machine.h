/* The machine that a measurement was made on. */
#ifndef LSF_TOOLS_MACHINE_H
#define LSF_TOOLS_MACHINE_H

#include "tools/json.h"

/* The key "machine": processor, cores, memory and system, as far as they are known. */
void lsf_machine_add(lsf_json *json);

#endif
