/* The environment as a light source. */
#ifndef LSF_REFERENCE_SKY_H
#define LSF_REFERENCE_SKY_H

#include "math/distribution.h"
#include "math/vector.h"
#include "scene/scene.h"

typedef struct lsf_reference_sky {
    const lsf_environment *environment;
    bool sampled;               /* a map that is drawn from; else rays find what there is */
    lsf_distribution_2d texels; /* by luminance times solid angle */
} lsf_reference_sky;

bool lsf_reference_sky_init(lsf_reference_sky *sky, const lsf_environment *environment,
                            lsf_error *error);
void lsf_reference_sky_finish(lsf_reference_sky *sky);

/* Draws a direction; returns its density per steradian (0: none). */
float lsf_reference_sky_sample(const lsf_reference_sky *sky, const double u[2],
                               lsf_float3 *direction);
float lsf_reference_sky_pdf(const lsf_reference_sky *sky, lsf_float3 direction);

#endif
