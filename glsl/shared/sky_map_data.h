/* Maps of some directions of the environment, one a layer, uniform buffer LSF_BINDING_LIGHT in the
 * place of a light's. Normalised space. */
#ifndef LSF_SHARED_SKY_MAP_DATA_H
#define LSF_SHARED_SKY_MAP_DATA_H

#include "shared/shared.h"

/* Layers of a batch at most. */
#define LSF_SKY_MAPS_MAX 8

/* A point's place on the map and its depth are affine: dot(row.xyz, p) + row.w. Depths are 0 to 1
 * over what can be lit, 1 on the sky's side; what only casts shadows may lie outside. */
struct lsf_sky_map_data {
    vec4 right, up;  /* place, in texels */
    vec4 towards;    /* depth */
    vec4 to_sky;     /* xyz: unit; w: density of all directions of an iteration [1/sr] */
    vec4 irradiance; /* rgb: on a plane that faces the sky there [W/m^2]; w: the kernel that
                      * suppresses glossy lobes [sr], see brdf_evaluate */
    vec4 texel;      /* width and height of a texel, extent of depths; texels along a side */
    vec4 error;      /* x: how far what is lit may be off its surface by rounding */
    vec4 unused;     /* a batch begins at a multiple of 256 bytes */
};

#include "shared/shared_end.h"
#endif
