/* Links from nodes to their parents, while the tree is built. */
#ifndef LSF_PASSES_LIGHT_TREE_LINKS
#define LSF_PASSES_LIGHT_TREE_LINKS

#include "passes/light_tree_codes.glsl"

layout(local_size_x = LSF_LIGHT_TREE_GROUP) in;

layout(std430, binding = LSF_BINDING_LIGHT_TREE_PARENTS) buffer lsf_light_tree_parent_block
{
    uint parents[]; /* of inner nodes, then of VPLs in the order of their codes; then the number of merged children
                     * of each inner node */
};

uint parent_of_leaf(uint leaf)
{
    return parents[record_count + leaf];
}

uint visits_index(uint node)
{
    return 2u * record_count + node;
}

#endif
