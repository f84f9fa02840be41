/* One punctual light and its shadow map's projection, uniform buffer LSF_BINDING_LIGHT.
 * Normalised space. */
#ifndef LSF_SHARED_LIGHT_DATA_H
#define LSF_SHARED_LIGHT_DATA_H

#include "shared/shared.h"

#define LSF_LIGHT_TYPE_POINT 0
#define LSF_LIGHT_TYPE_SPOT 1
#define LSF_LIGHT_TYPE_DIRECTIONAL 2

/* Faces of a map: a cube's 6 (face 2a looks along the map's axis a, 2a + 1 against it), a narrow
 * spot's 1, or a directional light's cascades, nested windows from the smallest on. A face looks
 * along its forward axis from `map_origin`. With q = (right, up, forward) coordinates of a point
 * relative to the origin, and (x, y) its position on the face, -1..1:
 *   perspective   (x, y) = q.xy / (q.z extent) + offset,      depth = near / q.z
 *   orthographic  (x, y) = (q.xy - center) / extent + offset, depth = (far - q.z) / (far - near)
 * Depth is affine in (x, y) over any plane, in both. A VPL's map is one of a hemisphere about the
 * forward axis; see lib/hemisphere.glsl. */
struct lsf_light_data {
    vec4 position;      /* xyz; w: factor of adaptive emission, see lib/emission_pdf.glsl */
    vec4 direction;     /* xyz: unit, away from the light */
    vec4 intensity;     /* rgb: W/sr in normalised units; directional W/m^2; w: for a direction of
                         * the environment, density of all directions of an iteration [1/sr], else
                         * 0 */
    vec4 attenuation;   /* 1/range^2, spot scale, spot offset (light.h), type */
    vec4 map_origin;    /* xyz; w: number of faces */
    vec4 map_shape;     /* near, far (0: perspective), texels along a side, 1 / texels */
    vec4 map_offset;    /* xy: offset, within a texel; z: distance of receivers from their surfaces
                         * by rounding; w: for a direction of the environment, the kernel that
                         * suppresses glossy lobes [sr], see brdf_evaluate */
    vec4 map_window[6]; /* xy: center, zw: extent (perspective: tangent of the half angle) */
    vec4 map_right[6], map_up[6], map_forward[6]; /* unit axes */
};

#include "shared/shared_end.h"
#endif
