/* Texture coordinates of a direction on a latitude-longitude map, 0..1: u = 0.5 + atan(z, x) / 2 pi, v = acos(y) /
 * pi from the top. The arc cosine is computed from the arc tangent, because drivers' own is off by up to 2e-4, a
 * thirtieth of a texel of a map of 512 rows. */
#ifndef LSF_LIB_LAT_LONG
#define LSF_LIB_LAT_LONG

#include "shared/brdf.h"

vec2 lat_long(vec3 direction)
{
    return vec2(0.5 + atan(direction.z, direction.x) / (2.0 * LSF_PI),
                atan(length(direction.xz), direction.y) / LSF_PI);
}

#endif
