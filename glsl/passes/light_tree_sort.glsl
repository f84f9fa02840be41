/* A radix sort of the codes from the lowest digit on (D. Merrill, A. Grimshaw 2010, "Revisiting Sorting for GPGPU
 * Stream Architectures", without its fused steps): each pass counts the digits of every tile, adds up the counts,
 * and moves the codes in a stable order. The records' numbers are in order from the start. */
#ifndef LSF_PASSES_LIGHT_TREE_SORT
#define LSF_PASSES_LIGHT_TREE_SORT

#include "shared/light_tree_data.h"

layout(local_size_x = LSF_LIGHT_TREE_GROUP) in;

layout(std430, binding = LSF_BINDING_LIGHT_TREE_CODES) readonly buffer lsf_light_tree_code_block
{
    uvec2 codes[]; /* high and low words */
};
/* The number of codes of each tile with each digit; later the position of the first of them. */
layout(std430, binding = LSF_BINDING_LIGHT_TREE_COUNTS) buffer lsf_light_tree_count_block
{
    uint counts[];
};

layout(location = 0) uniform uint shift; /* of the current digit, from the code's lowest bit */
layout(location = LSF_LOCATION_LIGHT_TREE_RECORDS) uniform uint record_count;

uint code_digit(uvec2 code)
{
    return (shift < 32u ? code.y >> shift : code.x >> (shift - 32u)) & uint(LSF_LIGHT_TREE_DIGITS - 1);
}

/* The code of this invocation in a row of the group's tile. */
uint code_index(uint row)
{
    return gl_WorkGroupID.x * LSF_LIGHT_TREE_TILE + row * LSF_LIGHT_TREE_GROUP + gl_LocalInvocationID.x;
}

#endif
