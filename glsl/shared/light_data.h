/* One punctual light and its shadow map's projection, uniform buffer LSF_BINDING_LIGHT.
 * Normalised space. */
#ifndef LSF_SHARED_LIGHT_DATA_H
#define LSF_SHARED_LIGHT_DATA_H

#include "shared/shared.h"

#define LSF_LIGHT_TYPE_POINT 0
#define LSF_LIGHT_TYPE_SPOT 1
#define LSF_LIGHT_TYPE_DIRECTIONAL 2

/* A face of the map looks along its forward axis from `map_origin`. With q = (right, up, forward)
 * coordinates of a point relative to the origin, and (x, y) its place on the map, -1..1:
 *   perspective   (x, y) = q.xy / (q.z extent) + offset,  depth = near / q.z
 *   orthographic  (x, y) = q.xy / extent + offset,        depth = (far - q.z) / (far - near)
 * Depth is affine in (x, y) over any plane, in both. */
struct lsf_light_data {
    vec4 position;    /* xyz */
    vec4 direction;   /* xyz: unit, the way the light shines */
    vec4 intensity;   /* rgb: W/sr in normalised units; directional W/m^2 */
    vec4 attenuation; /* 1/range^2, spot scale, spot offset (light.h), type */
    vec4 map_origin;  /* xyz; w: number of faces, 1 or 6 */
    vec4 map_shape;   /* near, far (0: perspective), texels along a side, 1 / texels */
    vec4 map_extent;  /* xy: half extents (perspective: tangents of half angles); zw: offset */
    vec4 map_right[6], map_up[6], map_forward[6]; /* unit axes of each face; a cube's face 2a
                                                   * looks along its axis a, 2a + 1 against it */
};

#include "shared/shared_end.h"
#endif
