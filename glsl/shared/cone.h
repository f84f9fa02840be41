/* Sets of cones that gather a hemisphere, for the shaders and for the host. */
#ifndef LSF_SHARED_CONE_H
#define LSF_SHARED_CONE_H

#include "shared/shared.h"

/* The largest float below 1. */
#define LSF_CONE_RADIUS2_MAX 0.99999994f

/* The disc to which the hemisphere projects is cut into `count` rings of equal area, one for
 * each cone. Returns the squared distance from the disc's centre of the cone of a ring (from 0)
 * at the position `position` (0 to 1) in it: sin^2 of its angle to the normal. Rounding puts none
 * on the horizon, where the density of directions is 0. */
LSF_SHARED_FUNCTION float lsf_cone_radius2(float ring, float position, float count)
{
    return min((ring + position) / count, LSF_CONE_RADIUS2_MAX);
}

#include "shared/shared_end.h"
#endif
