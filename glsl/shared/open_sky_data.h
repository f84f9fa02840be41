/* Directions drawn by the environment's radiance for unoccluded light; pixels use parts of them. */
#ifndef LSF_SHARED_OPEN_SKY_DATA_H
#define LSF_SHARED_OPEN_SKY_DATA_H

#include "shared/shared.h"

#define LSF_OPEN_SKY_DRAWN 1024 /* in an iteration; a power of two */
#define LSF_UNIT_OPEN_SKY 22    /* buffer texture, RGBA32F: two texels for each direction */

struct lsf_open_sky_data {
    vec4 direction; /* xyz: unit; w: density by the radiance alone [1/sr], as in lsf_sky_density */
    vec4 radiance;  /* rgb: over the density with which it was drawn */
};
#ifndef GL_core_profile
typedef struct lsf_open_sky_data lsf_open_sky_data;
#endif

#include "shared/shared_end.h"
#endif
