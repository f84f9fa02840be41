/* The layout of the denoising network for shaders; see src/passes/denoise.md. */
#ifndef LSF_SHARED_DENOISE_DATA_H
#define LSF_SHARED_DENOISE_DATA_H

#include "shared/shared.h"

/* Feature maps are stored in groups of 8 numbers per pixel, half floats in a uvec4. A map of n
 * features has (n + 7) / 8 groups, one after the other, each with rows from the bottom. */
#define LSF_DENOISE_GROUP 8
#define LSF_DENOISE_INPUT_GROUPS 3 /* of 20 features */

/* Light becomes log(1 + 10 x / scale), so that the scale lies at the bend of the logarithm. */
#define LSF_DENOISE_BEND 10.0f
/* Largest change of a logarithm by the network. */
#define LSF_DENOISE_MOST 10.0f

/* Radius [pixels] of the neighbourhood in which the network may blend specular light. */
#define LSF_DENOISE_NEAR 1

/* Side [pixels] of a work group over the picture or a feature map. */
#define LSF_DENOISE_TILE 16

/* Sums of a work group over its pixels, and of all of them: vec4s. For the scale only the first:
 * sum of square roots of luminance, number of pixels. For the gain: light before and after the
 * network, as it counts in the picture, diffuse and specular. */
#define LSF_DENOISE_SUMS 4
#define LSF_DENOISE_SUM_SCALE 0
#define LSF_DENOISE_SUM_GAIN 1 /* the second set of totals */

/* Storage buffers. */
#define LSF_BINDING_DENOISE_TARGET 1
#define LSF_BINDING_DENOISE_SOURCE 2 /* and the next one for the second source */
#define LSF_BINDING_DENOISE_WEIGHTS 4
#define LSF_BINDING_DENOISE_PARTIAL 5 /* sums of the work groups */
#define LSF_BINDING_DENOISE_TOTAL 6

#include "shared/shared_end.h"
#endif
