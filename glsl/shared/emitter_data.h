/* A point on an emissive triangle, storage buffer LSF_BINDING_EMITTERS, drawn by the host
 * (scene/emitters.h). Normalised space. */
#ifndef LSF_SHARED_EMITTER_DATA_H
#define LSF_SHARED_EMITTER_DATA_H

#include "shared/shared.h"

struct lsf_emitter_point_data {
    vec4 position; /* xyz */
    vec4 normal;   /* xyz: unit, on the emitting side; w: density by area of sides with which it
                    * was drawn */
    vec4 radiance; /* rgb; w: number of sides that emit, 1 or 2 */
};

/* Points of an iteration: one for each cell of a square with LSF_EMITTER_CELLS cells a side,
 * from which random numbers are taken. */
#define LSF_EMITTER_CELLS 64

#define LSF_BINDING_EMITTERS 1

#include "shared/shared_end.h"
#endif
