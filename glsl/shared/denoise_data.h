/* The network that takes noise out of light, as shaders see it; see src/passes/denoise.md. */
#ifndef LSF_SHARED_DENOISE_DATA_H
#define LSF_SHARED_DENOISE_DATA_H

#include "shared/shared.h"

/* Feature maps are kept in groups of 8 numbers a pixel, half floats in a uvec4; a map of n features
 * has (n + 7) / 8 of them, one after the other, each with rows from the bottom. */
#define LSF_DENOISE_GROUP 8
#define LSF_DENOISE_INPUT_GROUPS 3 /* of 20 features */

/* Light is to be log(1 + 10 x / scale): the scale lies where the logarithm bends. */
#define LSF_DENOISE_BEND 10.0f
/* What the network adds to a logarithm, at most. */
#define LSF_DENOISE_MOST 10.0f

/* Pixels to a side of a work group that goes over the picture or a feature map. */
#define LSF_DENOISE_TILE 16

/* What a work group adds up over its pixels, and all of them together: vec4s. Of the scale the
 * first alone: sum of square roots of luminance, pixels. Of the gain: light before and after the
 * network, as it counts in the picture, diffuse and specular. */
#define LSF_DENOISE_SUMS 4
#define LSF_DENOISE_SUM_SCALE 0
#define LSF_DENOISE_SUM_GAIN 1 /* the second set of totals */

/* Storage buffers. */
#define LSF_BINDING_DENOISE_TARGET 1
#define LSF_BINDING_DENOISE_SOURCE 2 /* and, of what is read beside it, the next */
#define LSF_BINDING_DENOISE_WEIGHTS 4
#define LSF_BINDING_DENOISE_PARTIAL 5 /* sums of work groups */
#define LSF_BINDING_DENOISE_TOTAL 6

#include "shared/shared_end.h"
#endif
