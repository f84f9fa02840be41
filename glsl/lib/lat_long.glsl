/* Where a direction lies on a map of all directions, 0..1: u = 0.5 + atan(z, x) / 2 pi, v = acos(y) / pi
 * from the top. */
#ifndef LSF_LIB_LAT_LONG
#define LSF_LIB_LAT_LONG

#include "shared/brdf.h"

vec2 lat_long(vec3 direction)
{
    return vec2(0.5 + atan(direction.z, direction.x) / (2.0 * LSF_PI),
                acos(clamp(direction.y, -1.0, 1.0)) / LSF_PI);
}

#endif
