/* Target positions of the codes of each tile with each digit: after all codes with a lower digit, and those of
 * earlier tiles. One work group, one digit per invocation. */
#include "passes/light_tree_sort.glsl"

shared uint sums[LSF_LIGHT_TREE_DIGITS];

void main()
{
    uint digit = gl_LocalInvocationID.x;
    uint tiles = (record_count + LSF_LIGHT_TREE_TILE - 1u) / LSF_LIGHT_TREE_TILE;
    uint size = tiles * LSF_LIGHT_TREE_DIGITS;
    uint own = 0u;
    for (uint i = digit; i < size; i += LSF_LIGHT_TREE_DIGITS)
        own += counts[i];
    sums[digit] = own;
    barrier();
    for (uint reach = 1u; reach < LSF_LIGHT_TREE_DIGITS; reach *= 2u) {
        uint before = digit >= reach ? sums[digit - reach] : 0u;
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
