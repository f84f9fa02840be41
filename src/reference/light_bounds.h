/* Bounds of the light that a group of lights can send to a point. */
#ifndef LSF_REFERENCE_LIGHT_BOUNDS_H
#define LSF_REFERENCE_LIGHT_BOUNDS_H

#include "reference/light_tree.h"

lsf_light_bounds lsf_light_bounds_union(const lsf_light_bounds *a, const lsf_light_bounds *b);

/* Cost of a group in the heuristic that builds the tree: intensity times the extent of positions
 * times that of directions. */
float lsf_light_bounds_cost(const lsf_light_bounds *bounds);

#endif
