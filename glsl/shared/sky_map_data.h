/* Maps of some directions of the environment, one in each layer, in the uniform buffer of a
 * light, LSF_BINDING_LIGHT. Normalised space. */
#ifndef LSF_SHARED_SKY_MAP_DATA_H
#define LSF_SHARED_SKY_MAP_DATA_H

#include "shared/shared.h"

/* Largest number of layers in a batch. */
#define LSF_SKY_MAPS_MAX 8

/* Affine functions for a point's position on the map and its depth: dot(row.xyz, p) + row.w.
 * Depths are 0 to 1 over all points that can be lit, 1 on the sky's side; points that only cast
 * shadows may lie outside. */
struct lsf_sky_map_data {
    vec4 right, up;  /* place, in texels */
    vec4 towards;    /* depth */
    vec4 to_sky;     /* xyz: unit; w: density of all directions of an iteration [1/sr] */
    vec4 irradiance; /* rgb: on a plane that faces the sky there [W/m^2]; w: the kernel that
                      * suppresses glossy lobes [sr], see brdf_evaluate */
    vec4 texel;      /* width and height of a texel, extent of depths; texels along a side */
    vec4 error;      /* x: distance of receivers from their surfaces by rounding; y: 1 where the
                      * map serves all points of the scene, 0 where only those that the camera
                      * sees */
    vec4 unused;     /* pads a batch to a multiple of 256 bytes */
};

#include "shared/shared_end.h"
#endif
