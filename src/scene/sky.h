/* Directions drawn by the environment's radiance, as it is interpolated between texels.
 *
 * Half of them have a density proportional to its luminance L, half to min(L, m) with m the mean of
 * L, so that surfaces which a bright sun does not reach have their share: p(w) = 1/2 L(w) /
 * integral of L + 1/2 min(L, m)(w) / integral of min(L, m). No direction then counts for more than
 * twice what it would by either alone (Hesterberg 1995, "Weighted Average Importance Sampling and
 * Defensive Mixture Distributions"). Without a map, 1 / (4 pi). */
#ifndef LSF_SCENE_SKY_H
#define LSF_SCENE_SKY_H

#include "math/distribution.h"
#include "math/vector.h"
#include "scene/scene.h"

typedef struct lsf_sky {
    const lsf_environment *environment;
    float *weights; /* of each texel, with its solid angle; NULL: uniform */
    double sum;     /* of them */
    lsf_distribution_2d texels;
    float whole, held, mean; /* 1/2 over either integral, and m; see lsf_sky_density */
} lsf_sky;

/* False without memory; nothing is left to finish then. */
bool lsf_sky_init(lsf_sky *sky, const lsf_environment *environment);
void lsf_sky_finish(lsf_sky *sky);

/* Draws a unit direction; `pdf` receives its density [1/sr], above 0. */
lsf_float3 lsf_sky_sample(const lsf_sky *sky, const double u[2], float *pdf);
/* The density of a unit direction. */
float lsf_sky_pdf(const lsf_sky *sky, lsf_float3 direction);
/* The density of a direction of this radiance, not averaged over its texel: for weights, which
 * shaders compute from the radiance alike (lib/sky.glsl). */
float lsf_sky_density(const lsf_sky *sky, lsf_float3 radiance);

/* Integral over the sphere of the radiance's luminance [W/m^2]. */
double lsf_sky_fluence(const lsf_environment *environment);

#endif
