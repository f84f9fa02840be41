/* Where the codes of each tile with each digit go: after all with a lower digit, and those of the tiles before. One
 * work group, whose invocations take a digit each. */
#include "passes/light_tree_sort.glsl"

shared uint sums[LSF_LIGHT_TREE_DIGITS];

void main()
{
    uint digit = gl_LocalInvocationID.x, size = uint(counts.length());
    uint own = 0u;
    for (uint i = digit; i < size; i += LSF_LIGHT_TREE_DIGITS)
        own += counts[i];
    sums[digit] = own;
    barrier();
    for (uint step = 1u; step < LSF_LIGHT_TREE_DIGITS; step *= 2u) {
        uint before = digit >= step ? sums[digit - step] : 0u;
        barrier();
        sums[digit] += before;
        barrier();
    }
    uint first = sums[digit] - own;
    for (uint i = digit; i < size; i += LSF_LIGHT_TREE_DIGITS) {
        uint count = counts[i];
        counts[i] = first;
        first += count;
    }
}
