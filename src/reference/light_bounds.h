/* What a group of lights can do at a point. */
#ifndef LSF_REFERENCE_LIGHT_BOUNDS_H
#define LSF_REFERENCE_LIGHT_BOUNDS_H

#include "reference/light_tree.h"

lsf_light_bounds lsf_light_bounds_union(const lsf_light_bounds *a, const lsf_light_bounds *b);

/* How likely such a group is to be drawn where most of it does nothing: intensity times the extent
 * of places times that of directions. */
float lsf_light_bounds_cost(const lsf_light_bounds *bounds);

#endif
