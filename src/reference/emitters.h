/* Emissive triangles as light sources: one is drawn by its power, a point on it by area. */
#ifndef LSF_REFERENCE_EMITTERS_H
#define LSF_REFERENCE_EMITTERS_H

#include "math/distribution.h"
#include "reference/geometry.h"

typedef struct lsf_reference_emitters {
    uint64_t count;
    uint32_t *instance, *triangle; /* of each emitter */
    float *area_pdf;               /* probability of the triangle over its area [1 / area] */
    uint64_t *first;               /* of each instance; UINT64_MAX: it does not emit */
    lsf_distribution power;
} lsf_reference_emitters;

bool lsf_reference_emitters_init(lsf_reference_emitters *emitters,
                                 const lsf_reference_geometry *geometry, lsf_error *error);
void lsf_reference_emitters_finish(lsf_reference_emitters *emitters);

typedef struct lsf_reference_emitter_sample {
    lsf_float3 direction; /* unit, towards the emitter */
    lsf_float3 target;    /* where the shadow ray ends: just before the emitter */
    lsf_float3 radiance;
    float pdf; /* per steradian; 0: nothing was found */
} lsf_reference_emitter_sample;

/* `choice` and `u` are uniform in [0, 1). */
lsf_reference_emitter_sample lsf_reference_emitters_sample(const lsf_reference_emitters *emitters,
                                                           const lsf_reference_geometry *geometry,
                                                           lsf_float3 from, double choice,
                                                           const float u[2]);

/* Density per steradian with which the sampling above gives the hit point that a ray of the unit
 * `direction` from `from` found; 0 for what does not emit. */
float lsf_reference_emitters_pdf(const lsf_reference_emitters *emitters,
                                 const lsf_reference_geometry *geometry,
                                 const lsf_reference_hit *hit, lsf_float3 from,
                                 lsf_float3 direction);

#endif
