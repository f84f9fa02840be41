/* Adds up the sums of all work groups: one group, in a fixed order. */
#include "passes/denoise_sums.glsl"

layout(location = 0) uniform uint group_count;
layout(location = 1) uniform uint set; /* of totals */

void main()
{
    for (uint which = 0u; which < LSF_DENOISE_SUMS; which++) {
        vec4 own = vec4(0.0);
        for (uint i = gl_LocalInvocationIndex; i < group_count; i += LSF_DENOISE_INVOCATIONS)
            own += partial_sums[i * LSF_DENOISE_SUMS + which];
        vec4 sum = sum_of_group(own);
        if (gl_LocalInvocationIndex == 0u)
            totals[set * LSF_DENOISE_SUMS + which] = sum;
        barrier();
    }
}
