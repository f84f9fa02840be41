/* One ray-bundle's projection, uniform buffer LSF_BINDING_BUNDLE. Normalised space. */
#ifndef LSF_SHARED_BUNDLE_DATA_H
#define LSF_SHARED_BUNDLE_DATA_H

#include "shared/shared.h"

/* With q = (right, up, forward) . p of a point p, its place on the map, 0..texels, and its depth,
 * 0..1 over the whole scene, are
 *   place = ((q.xy - center) / extent * 0.5 + 0.5) * texels,   depth = (q.z - start) / length
 * Both are affine in p. */
struct lsf_bundle_data {
    vec4 right, up; /* unit axes */
    vec4 forward;   /* unit: the bundle's direction; w: its density [1/sr], p_r in the paper */
    vec4 window;    /* xy: center, zw: extent (half width and height) */
    vec4 range;     /* start, length (along forward), texels along a side, 1 / texels */
};

#include "shared/shared_end.h"
#endif
