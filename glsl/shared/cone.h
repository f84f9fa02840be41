/* Cones that gather a hemisphere, for the shaders and for the host. */
#ifndef LSF_SHARED_CONE_H
#define LSF_SHARED_CONE_H

#include "shared/shared.h"

/* The disc that the hemisphere projects to is cut into `count` rings of equal area, one a cone. How
 * far from the disc's middle the cone of a ring (from 0) is, that lies at `place` (0 to 1) in it,
 * squared: sin^2 of its angle to the normal. */
LSF_SHARED_FUNCTION float lsf_cone_radius2(float ring, float place, float count)
{
    return (ring + place) / count;
}

#include "shared/shared_end.h"
#endif
