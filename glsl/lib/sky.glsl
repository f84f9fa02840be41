/* Weights by the balance heuristic (Veach and Guibas 1995) between directions drawn by the environment's radiance
 * and strategies that find the environment otherwise. The density of these directions is a function of the
 * radiance alone, as in lsf_sky_density. */
#ifndef LSF_LIB_SKY
#define LSF_LIB_SKY

#include "shared/scene_data.h"

/* Factors on the luminance and on the luminance clamped to z; w: directions drawn in an iteration. */
layout(location = LSF_LOCATION_SKY) uniform vec4 sky_sampling;

/* Density of all directions of an iteration [1/sr]. */
float sky_density(vec3 radiance)
{
    float luminance = dot(radiance, vec3(0.2126, 0.7152, 0.0722));
    return sky_sampling.w *
           (sky_sampling.x * luminance + sky_sampling.y * min(luminance, sky_sampling.z));
}

/* Weighted radiance for a strategy that finds it with the density `chance` [1/sr], above 0. */
vec3 sky_left(vec3 radiance, float chance)
{
    return radiance * (chance / (chance + sky_density(radiance)));
}

#endif
