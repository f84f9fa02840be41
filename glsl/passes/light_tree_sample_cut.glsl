/* Where the descents begin: at the nodes of a cut through the tree (B. Walter et al. 2005, "Lightcuts: A Scalable
 * Approach to Illumination"; one for each point, C. Yuksel 2019, "Stochastic Lightcuts"). A node that a point sees
 * under a small angle is about as far away as all VPLs below it, so that its weight predicts their light; a larger
 * one may hide a near VPL among far ones. Each sample picks one of the cut's nodes in proportion to its weight, in
 * a single pass over the nodes (M. T. Chao 1982, "A General Purpose Unequal Probability Sampling Plan"). Switch
 * LSF_LIGHT_TREE_SAMPLES, samples of a point. */
#ifndef LSF_PASSES_LIGHT_TREE_SAMPLE_CUT
#define LSF_PASSES_LIGHT_TREE_SAMPLE_CUT

#include "passes/light_tree_sample_weight.glsl"

/* Largest number of nodes that are opened; software GL ends all loops of a shader together after 65535 iterations.
 * Any cut is unbiased. */
#define CUT_MOST 512

/* Largest ratio of the variance of positions to the squared distance for nodes of a cut, except leaves; infinite:
 * the root alone. */
layout(location = 3) uniform float cut_bound;

struct light_pick {
    int lobe;   /* 0: diffuse, 1: specular (no bool: drivers over Vulkan fail on arrays of them) */
    uint link;  /* LSF_LIGHT_TREE_NONE: no light reaches the point */
    float u;    /* 0 <= u < 1, the random number, rescaled after each choice */
    float weight; /* of the link */
};

light_pick picks[LSF_LIGHT_TREE_SAMPLES];

/* Sums over the cut's nodes so far, for samples of the diffuse and the specular lobe. */
float weight_sums[2];

void pick_among(uint link, float weight, int lobe)
{
    if (!(weight > 0.0))
        return;
    weight_sums[lobe] += weight;
    float share = weight / weight_sums[lobe];
    for (int i = 0; i < LSF_LIGHT_TREE_SAMPLES; i++) {
        if (picks[i].lobe != lobe)
            continue;
        float u = picks[i].u;
        bool taken = u < share;
        picks[i].u = min(taken ? u / share : (u - share) / (1.0 - share), 1.0 - 1.0 / 16777216.0);
        if (taken) {
            picks[i].link = link;
            picks[i].weight = weight;
        }
    }
}

/* Fills the picks, whose lobes and random numbers are given; `lobes`: which of the two occur among them. Returns
 * the number of nodes that were opened. */
uint light_cut(light_receiver r, bvec2 lobes)
{
    uint stack[WALK_DEPTH];
    uint opened = 0u;
    int top = 0;
    weight_sums[0] = weight_sums[1] = 0.0;
    stack[0] = tree.root;
    if (tree.root == LSF_LIGHT_TREE_NONE)
        return 0u;
    float most = luminance(light_node(tree.root).intensity);
    while (top >= 0) {
        uint link = stack[top--];
        for (; !light_is_leaf(link) && opened < CUT_MOST; opened++) {
            lsf_light_tree_node node = light_inner_node(link);
            vec3 to_node = node.position - r.position;
            if (!(light_variance(node) > cut_bound * dot(to_node, to_node)))
                break;
            stack[++top] = node.right;
            link = node.left;
        }
        vec2 weights = light_weights(r, link, most, lobes.y);
        if (lobes.x)
            pick_among(link, weights.x, 0);
#if LSF_SPECULAR
        if (lobes.y)
            pick_among(link, weights.y, 1);
#endif
    }
    return opened;
}

#endif
