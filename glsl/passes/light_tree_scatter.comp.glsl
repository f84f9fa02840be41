/* Moves the codes of a tile to the positions of their digits, row by row: within a row, each code goes behind
 * those of the same digit in lower lanes. */
#include "passes/light_tree_sort.glsl"

#define MASK_WORDS (LSF_LIGHT_TREE_GROUP / 32)

layout(std430, binding = LSF_BINDING_LIGHT_TREE_CODES + 1) writeonly buffer lsf_light_tree_sorted_block
{
    uvec2 sorted_codes[];
};

shared uint first[LSF_LIGHT_TREE_DIGITS];              /* position of the next code with that digit */
shared uint lanes[LSF_LIGHT_TREE_DIGITS * MASK_WORDS]; /* a bit for each lane that has the digit */

void main()
{
    uint lane = gl_LocalInvocationID.x;
    first[lane] = counts[gl_WorkGroupID.x * LSF_LIGHT_TREE_DIGITS + lane];
    for (uint word = 0u; word < MASK_WORDS; word++)
        lanes[word * LSF_LIGHT_TREE_DIGITS + lane] = 0u;
    uint own_word = lane / 32u, own_bit = 1u << (lane % 32u);
    for (uint row = 0u; row < LSF_LIGHT_TREE_ROWS; row++) {
        uint i = code_index(row);
        bool there = i < record_count;
        uvec2 code = there ? codes[i] : uvec2(0u);
        uint digit = code_digit(code);
        barrier();
        if (there)
            atomicOr(lanes[own_word * LSF_LIGHT_TREE_DIGITS + digit], own_bit);
        barrier();
        uint before = 0u, all = 0u;
        for (uint word = 0u; word < MASK_WORDS; word++) {
            uint bits = lanes[word * LSF_LIGHT_TREE_DIGITS + digit];
            all += uint(bitCount(bits));
            uint earlier = word < own_word ? bits : word == own_word ? bits & (own_bit - 1u) : 0u;
            before += uint(bitCount(earlier));
        }
        uint target = first[digit] + before;
        if (there)
            sorted_codes[target] = code;
        barrier();
        /* The last lane with this digit updates the position. */
        if (there && before + 1u == all) {
            first[digit] = target + 1u;
            for (uint word = 0u; word < MASK_WORDS; word++)
                lanes[word * LSF_LIGHT_TREE_DIGITS + digit] = 0u;
        }
    }
}
