/* The part that all layers of the network share: feature maps in groups of 8, and their weights. */
#ifndef LSF_PASSES_DENOISE_LAYER
#define LSF_PASSES_DENOISE_LAYER

#include "shared/denoise_data.h"

layout(std430, binding = LSF_BINDING_DENOISE_TARGET) writeonly buffer lsf_denoise_target_block
{
    uvec4 target_maps[];
};
layout(std430, binding = LSF_BINDING_DENOISE_SOURCE) readonly buffer lsf_denoise_source_block
{
    uvec4 source_maps[];
};
/* For each group of the target, each group of the sources and each tap of the kernel: rows of 8 weights, one for
 * each feature of the target. Then 8 biases for each group of the target. */
layout(std430, binding = LSF_BINDING_DENOISE_WEIGHTS) readonly buffer lsf_denoise_weight_block
{
    vec4 weights[];
};

layout(location = 0) uniform uvec2 size; /* of the maps that invocations cover */
/* Groups of the source and of the second source beside it; groups that have weights; groups of the target. */
layout(location = 1) uniform uvec4 groups;
layout(location = 2) uniform uint first_weight;
layout(location = 3) uniform uint first_bias;
layout(location = 4) uniform float leak;  /* factor on negative values; 1: no activation function */
layout(location = 5) uniform bool pooled; /* the source has twice the size, and the maximum of 2 x 2 is taken */

#define LSF_ROW 2 /* vec4s */

vec4 low_of(uvec4 texel)
{
    return vec4(unpackHalf2x16(texel.x), unpackHalf2x16(texel.y));
}

vec4 high_of(uvec4 texel)
{
    return vec4(unpackHalf2x16(texel.z), unpackHalf2x16(texel.w));
}

/* Half floats, clamped to finite values: infinity times a weight of 0 would be NaN. */
uvec4 halves_of(vec4 low, vec4 high)
{
    low = clamp(low * mix(vec4(leak), vec4(1.0), greaterThan(low, vec4(0.0))), -65504.0, 65504.0);
    high = clamp(high * mix(vec4(leak), vec4(1.0), greaterThan(high, vec4(0.0))), -65504.0, 65504.0);
    return uvec4(packHalf2x16(low.xy), packHalf2x16(low.zw), packHalf2x16(high.xy), packHalf2x16(high.zw));
}

/* Four features of the target for one tap, from 8 of a source: rows of weights from `at` on. */
vec4 four_features(uint at, vec4 low, vec4 high)
{
    return vec4(dot(weights[at], low) + dot(weights[at + 1u], high),
                dot(weights[at + 2u], low) + dot(weights[at + 3u], high),
                dot(weights[at + 4u], low) + dot(weights[at + 5u], high),
                dot(weights[at + 6u], low) + dot(weights[at + 7u], high));
}

#endif
