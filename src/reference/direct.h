/* Next-event estimation: direct light at a vertex from lights that are drawn. */
#ifndef LSF_REFERENCE_DIRECT_H
#define LSF_REFERENCE_DIRECT_H

#include "reference/walk.h"

void lsf_add_direct(lsf_walk *walk);

#endif
