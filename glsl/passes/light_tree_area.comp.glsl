/* The area that each VPL stands for, by the spread of those about it: of two that are merged first, the distance is
 * less than usual, of several it is not. */
#include "passes/light_tree_links.glsl"

#define ENOUGH 8u

layout(std430, binding = LSF_BINDING_LIGHT_TREE_AREAS) writeonly buffer lsf_light_tree_area_block
{
    float discs2[]; /* squared radii of discs, by record */
};

void main()
{
    uint place = gl_GlobalInvocationID.x;
    if (place >= tree.live)
        return;
    float disc2 = 0.0; /* of a single VPL nothing is known */
    if (tree.live > 1u) {
        uint node = parent_of_leaf(place);
        for (int i = 0; i < LSF_LIGHT_TREE_TURNS && node != 0u && nodes[node].count < ENOUGH; i++)
            node = parents[node];
        disc2 = light_disc2(nodes[node], light_tree_frame(octahedral_decode(nodes[node].normal)));
    }
    discs2[codes[place].y & CODE_ID_MASK] = disc2;
}
