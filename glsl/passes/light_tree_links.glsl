/* The way up from nodes, while the tree is built. */
#ifndef LSF_PASSES_LIGHT_TREE_LINKS
#define LSF_PASSES_LIGHT_TREE_LINKS

#include "passes/light_tree_codes.glsl"

layout(local_size_x = LSF_LIGHT_TREE_GROUP) in;

layout(std430, binding = LSF_BINDING_LIGHT_TREE_PARENTS) buffer lsf_light_tree_parent_block
{
    uint parents[]; /* of inner nodes, then of VPLs in the order of their codes */
};
/* Of inner nodes: how many of their children are done. */
layout(std430, binding = LSF_BINDING_LIGHT_TREE_VISITS) coherent buffer lsf_light_tree_visit_block
{
    uint visits[];
};

/* Nodes above a leaf are fewer than the bits of a code. */
#define LIGHT_TREE_DEPTH 64

uint parent_of_leaf(uint place)
{
    return parents[uint(cloud.length()) + place];
}

#endif
