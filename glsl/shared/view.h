/* The camera of one iteration, uniform buffer LSF_BINDING_VIEW. Normalised space. */
#ifndef LSF_SHARED_VIEW_H
#define LSF_SHARED_VIEW_H

#include "shared/shared.h"

/* A view ray through ndc (x, y), x right, y up, -1..1, passes start + x start_dx + y start_dy and
 * runs along forward + x forward_dx + y forward_dy, where view depth grows by 1. The start is the
 * camera's position, or, of a camera far off, on the far plane (lsf_camera_state). At a view depth
 * of s more than the start's, with (a, b) = depth.xy, the depth buffer holds (reverse-Z)
 *   perspective  (a s + b) / (s + start's view depth),   orthographic  a s + b. */
struct lsf_view_data {
    mat4 clip;                      /* of a position less the start; with the iteration's jitter */
    mat4 previous_clip;             /* the same jitter, at the previous frame's time */
    vec4 previous_start;            /* xyz */
    vec4 start, start_dx, start_dy; /* start.w: error of positions computed from depths */
    vec4 forward, forward_dx, forward_dy;
    vec4 size;   /* width, height, 1 / width, 1 / height of what is seen [sample points] */
    vec4 jitter; /* xy: ndc of the sample minus ndc of the centre of its part of a pixel; z: sample
                  * points along a pixel's side; w: side of the interleaving pattern, 0: none */
    vec4 depth;  /* a, b, scene units per normalised unit, view depth of the start */
};

#include "shared/shared_end.h"
#endif
