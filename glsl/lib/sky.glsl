/* How what finds the environment by chance shares its light with directions drawn by its radiance, by the
 * balance heuristic (Veach and Guibas 1995). The density of these is a function of the radiance alone, as
 * lsf_sky_density has it. */
#ifndef LSF_LIB_SKY
#define LSF_LIB_SKY

#include "shared/scene_data.h"

/* Factors of the luminance and of the luminance held below z; w: directions that an iteration draws. */
layout(location = LSF_LOCATION_SKY) uniform vec4 sky_sampling;

/* Of all directions of an iteration [1/sr]. */
float sky_density(vec3 radiance)
{
    float luminance = dot(radiance, vec3(0.2126, 0.7152, 0.0722));
    return sky_sampling.w *
           (sky_sampling.x * luminance + sky_sampling.y * min(luminance, sky_sampling.z));
}

/* What is left of the radiance to a way that finds it with the density `chance` [1/sr], above 0. */
vec3 sky_left(vec3 radiance, float chance)
{
    return radiance * (chance / (chance + sky_density(radiance)));
}

#endif
