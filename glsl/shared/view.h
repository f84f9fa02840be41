/* The camera of one iteration, uniform buffer LSF_BINDING_VIEW. Normalised space. */
#ifndef LSF_SHARED_VIEW_H
#define LSF_SHARED_VIEW_H

#include "shared/shared.h"

/* A view ray through ndc (x, y), x right, y up, -1..1, starts at origin + x origin_dx +
 * y origin_dy and runs along forward + x forward_dx + y forward_dy, where view depth grows by 1. */
struct lsf_view_data {
    mat4 clip_from_position; /* with the iteration's jitter; reverse-Z */
    mat4 previous_clip_from_position; /* the same jitter, at the previous frame's time */
    vec4 origin, origin_dx, origin_dy;
    vec4 forward, forward_dx, forward_dy;
    vec4 size;   /* width, height, 1 / width, 1 / height [pixels] */
    vec4 jitter; /* xy: ndc of the sample minus ndc of the pixel's centre */
    vec4 depth;  /* near, far (orthographic), scene units per normalised unit, 0 */
};

#include "shared/shared_end.h"
#endif
