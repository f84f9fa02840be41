/* Counts the codes of each tile with each digit. */
#include "passes/light_tree_sort.glsl"

shared uint tile_counts[LSF_LIGHT_TREE_DIGITS];

void main()
{
    uint lane = gl_LocalInvocationID.x;
    tile_counts[lane] = 0u;
    barrier();
    for (uint row = 0u; row < LSF_LIGHT_TREE_ROWS; row++) {
        uint i = code_index(row);
        if (i < record_count)
            atomicAdd(tile_counts[code_digit(codes[i])], 1u);
    }
    barrier();
    counts[gl_WorkGroupID.x * LSF_LIGHT_TREE_DIGITS + lane] = tile_counts[lane];
}
