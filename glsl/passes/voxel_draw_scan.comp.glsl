/* Replaces each brick's sum by that of the bricks before it. One work group, in which each invocation has a part of
 * the bricks. */
#include "passes/voxel_draw_list.glsl"

#define INVOCATIONS 256

layout(local_size_x = INVOCATIONS) in;

shared float parts[INVOCATIONS];

void main()
{
    uint own = gl_LocalInvocationID.x;
    uint all = 1u << (3 * LSF_VOXEL_DRAW_BITS), each = (all + INVOCATIONS - 1u) / INVOCATIONS;
    uint first = own * each, last = min(first + each, all);
    float sum = 0.0;
    for (uint i = first; i < last; i++)
        sum += brick_sums[i];
    parts[own] = sum;
    barrier();
    float before = 0.0;
    for (uint i = 0u; i < own; i++)
        before += parts[i];
    for (uint i = first; i < last; i++) {
        sum = brick_sums[i];
        brick_sums[i] = before;
        before += sum;
    }
    if (own == INVOCATIONS - 1u)
        voxel_draw_total = before;
}
