/* The area that each VPL stands for, from the spread of its neighbours in the tree: two that are merged first are
 * closer together than average, several are not. */
#include "passes/light_tree_links.glsl"

#define ENOUGH 8u

layout(std430, binding = LSF_BINDING_LIGHT_TREE_AREAS) writeonly buffer lsf_light_tree_area_block
{
    float discs2[]; /* squared radii of discs, by record */
};

void main()
{
    uint leaf = gl_GlobalInvocationID.x;
    if (leaf >= tree.live)
        return;
    float disc2 = 0.0; /* a single VPL has no neighbours */
    if (tree.live > 1u) {
        uint node = parent_of_leaf(leaf);
        for (int i = 0; i < LSF_LIGHT_TREE_DISPATCHES && node != 0u && nodes[node].count < ENOUGH; i++)
            node = parents[node];
        disc2 = light_disc2(nodes[node], light_tree_frame(octahedral_decode(nodes[node].normal)));
    }
    discs2[codes[leaf].y & CODE_ID_MASK] = disc2;
}
