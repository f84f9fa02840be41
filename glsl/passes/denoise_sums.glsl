/* Sums over the picture in two steps, in the same order each time: within work groups, then over the work groups. */
#ifndef LSF_PASSES_DENOISE_SUMS
#define LSF_PASSES_DENOISE_SUMS

#include "shared/denoise_data.h"

#define LSF_DENOISE_INVOCATIONS (LSF_DENOISE_TILE * LSF_DENOISE_TILE)

layout(local_size_x = LSF_DENOISE_TILE, local_size_y = LSF_DENOISE_TILE) in;

layout(std430, binding = LSF_BINDING_DENOISE_PARTIAL) buffer lsf_denoise_partial_block
{
    vec4 partial_sums[];
};
layout(std430, binding = LSF_BINDING_DENOISE_TOTAL) buffer lsf_denoise_total_block
{
    vec4 totals[];
};

shared vec4 sums[LSF_DENOISE_INVOCATIONS];

/* The sum over the group's invocations; valid in the first of them. */
vec4 sum_of_group(vec4 value)
{
    uint own = gl_LocalInvocationIndex;
    sums[own] = value;
    barrier();
    for (uint half_count = LSF_DENOISE_INVOCATIONS / 2; half_count > 0u; half_count /= 2u) {
        if (own < half_count)
            sums[own] += sums[own + half_count];
        barrier();
    }
    return sums[0];
}

/* Adds a value to the sums of the group. */
void sum_add(uint which, vec4 value)
{
    vec4 sum = sum_of_group(value);
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (gl_LocalInvocationIndex == 0u)
        partial_sums[group * LSF_DENOISE_SUMS + which] = sum;
    barrier();
}

#endif
