/* Directions drawn by the environment's radiance for light without shadows, of which pixels take
 * parts. */
#ifndef LSF_SHARED_OPEN_SKY_DATA_H
#define LSF_SHARED_OPEN_SKY_DATA_H

#include "shared/shared.h"

#define LSF_OPEN_SKY_DRAWN 1024 /* in an iteration; a power of two */
#define LSF_BINDING_OPEN_SKY 3  /* storage buffer */

struct lsf_open_sky_data {
    vec4 direction; /* xyz: unit; w: density by the radiance alone [1/sr], as lsf_sky_density has
                     * it */
    vec4 radiance;  /* rgb: over the density with which it was drawn */
};
#ifndef GL_core_profile
typedef struct lsf_open_sky_data lsf_open_sky_data;
#endif

#include "shared/shared_end.h"
#endif
