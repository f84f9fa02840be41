/* Emissive triangles as light sources. */
#ifndef LSF_REFERENCE_EMITTERS_H
#define LSF_REFERENCE_EMITTERS_H

#include "reference/geometry.h"
#include "reference/light_tree.h"

typedef struct lsf_reference_emitters {
    uint64_t count;
    uint32_t *instance, *triangle; /* of each emitter */
    lsf_float3 *normal;            /* of its front, unit; 0: it has no area */
    float *area;
    float *intensity; /* mean luminance times area [W/sr]; above 0 where few samples may have
                       * missed emission */
    uint64_t *first;  /* of each instance; UINT64_MAX: it does not emit */
} lsf_reference_emitters;

bool lsf_reference_emitters_init(lsf_reference_emitters *emitters,
                                 const lsf_reference_geometry *geometry, lsf_error *error);
void lsf_reference_emitters_finish(lsf_reference_emitters *emitters);

lsf_light_bounds lsf_reference_emitter_bounds(const lsf_reference_emitters *emitters,
                                              const lsf_reference_geometry *geometry,
                                              uint64_t index);

typedef struct lsf_reference_emitter_sample {
    lsf_float3 direction; /* unit, towards the emitter */
    lsf_float3 target;    /* where the shadow ray ends: just before the emitter */
    lsf_float3 radiance;
    float pdf; /* per steradian; 0: no point was found */
} lsf_reference_emitter_sample;

/* A point on the emitter, uniform by area; `u` is uniform in [0, 1). */
lsf_reference_emitter_sample lsf_reference_emitter_draw(const lsf_reference_emitters *emitters,
                                                        const lsf_reference_geometry *geometry,
                                                        uint64_t index, lsf_float3 from,
                                                        const float u[2]);

/* The emitter that was hit; UINT64_MAX: the surface does not emit. */
uint64_t lsf_reference_emitter_of(const lsf_reference_emitters *emitters,
                                  const lsf_reference_hit *hit);
/* Density per steradian of drawing the point `at` of the emitter, which a ray of the unit
 * `direction` from `from` has found. */
float lsf_reference_emitter_pdf(const lsf_reference_emitters *emitters, uint64_t index,
                                lsf_float3 at, lsf_float3 from, lsf_float3 direction);

#endif
