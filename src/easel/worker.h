/* The process that runs the shader. */
#ifndef LSF_EASEL_WORKER_H
#define LSF_EASEL_WORKER_H

#include "easel/easel.h"

/* As lsf_easel_module's work. */
int lsf_easel_work(const lsf_easel_start *start);

#endif
