/* The values of inner nodes, from the leaves up. A dispatch merges the nodes whose children the previous
 * dispatches completed, left with right, and lists the parents that become ready for the next. The first dispatch
 * only lists. Switch LSF_SPECULAR. */
#include "passes/light_tree_links.glsl"

layout(std430, binding = LSF_BINDING_LIGHT_TREE_DISPATCHES) buffer lsf_light_tree_dispatch_block
{
    uvec4 dispatches[LSF_LIGHT_TREE_DISPATCHES]; /* work groups in x, y and z, and nodes, of each dispatch */
    uint ready[];                      /* nodes of this dispatch and of the next, in alternating halves */
};

layout(location = 0) uniform vec3 limits; /* least similarity, largest deviation along the normal, largest diagonal */
layout(location = 2) uniform uint dispatch;

uint ready_index(uint of_dispatch, uint i)
{
    return (of_dispatch & 1u) * ((record_count + 1u) / 2u) + i;
}

/* Exactly 1 for any number of equal normals. */
float normal_similarity(uint a, uint b)
{
    return a == b ? 1.0 : clamp(dot(octahedral_decode(a), octahedral_decode(b)), 0.0, 1.0);
}

/* Variances along other axes than the given ones; the correlation between axes is lost. */
vec3 rotate_variance(vec3 variance, uint from, mat3 to)
{
    mat3 rotated = transpose(to) * light_tree_frame(octahedral_decode(from));
    return matrixCompMult(rotated, rotated) * variance;
}

/* With q the second child's share of the luminance and d the vector between the children, the distance of their
 * means adds q (1 - q) d^2. */
void merge_spread(inout lsf_light_tree_node node, lsf_light_tree_node a, lsf_light_tree_node b, float q, mat3 frame)
{
    vec3 d = b.position - a.position;
#if LSF_LIGHT_TREE_COVARIANCE
    node.variance = mix(a.variance, b.variance, q) + q * (1.0 - q) * d * d;
    node.covariance = mix(a.covariance, b.covariance, q) + q * (1.0 - q) * d.xxy * d.yzz;
#else
    vec3 along = d * frame;
    node.variance = mix(rotate_variance(a.variance, a.normal, frame), rotate_variance(b.variance, b.normal, frame), q) +
                    q * (1.0 - q) * along * along;
    node.covariance = vec3(0.0);
#endif
}

#if LSF_SPECULAR
/* The mean of unit vectors along the axes is the mean cosine long. With diffuse VPLs among them nothing is known. */
void merge_lobes(inout lsf_light_tree_node node, lsf_light_tree_node a, lsf_light_tree_node b, float q, bool both)
{
    vec3 mean = mix(a.similarity * octahedral_decode(a.normal), b.similarity * octahedral_decode(b.normal), q);
    float size = length(mean);
    node.similarity = both ? size : 0.0;
    if (both && size > 1e-6)
        node.normal = octahedral_encode(mean / size);
}
#endif

void merge(uint index)
{
    lsf_light_tree_node node = nodes[index], a = light_node(node.left), b = light_node(node.right);
    float light = luminance(a.intensity), q = luminance(b.intensity);
    q /= light + q;
    vec3 normal = mix(octahedral_decode(a.normal), octahedral_decode(b.normal), q);
    node.position = mix(a.position, b.position, q);
    node.intensity = a.intensity + b.intensity;
    node.low = min(a.low, b.low);
    node.high = max(a.high, b.high);
    /* Opposite normals have no mean; the first child's normal is kept. */
    float size = length(normal);
    node.normal = a.normal == b.normal || size < 1e-6 ? a.normal : octahedral_encode(normal / size);
    node.similarity = a.similarity * b.similarity * normal_similarity(a.normal, b.normal);
#if LSF_SPECULAR
    bvec2 lobes = equal(uvec2(a.usable, b.usable), uvec2(LSF_LIGHT_TREE_LOBES));
    if (any(lobes))
        merge_lobes(node, a, b, q, all(lobes));
#endif
    mat3 frame = light_tree_frame(octahedral_decode(node.normal));
    merge_spread(node, a, b, q, frame);
    float across = light_variance_along(node, frame[2], frame);
    node.usable = node.similarity >= limits.x && across <= limits.y * limits.y &&
                          distance(node.low, node.high) <= limits.z ? LSF_LIGHT_TREE_USABLE : 0u;
#if LSF_SPECULAR
    if (any(lobes))
        node.usable = all(lobes) ? LSF_LIGHT_TREE_LOBES : 0u;
#endif
    nodes[index] = node;
}

void main()
{
    uint i = gl_GlobalInvocationID.x, node;
    if (dispatch == 0u) {
        if (tree.live < 2u || i >= tree.live)
            return;
        node = parent_of_leaf(i);
    } else {
        if (i >= dispatches[dispatch].w)
            return;
        uint done = ready[ready_index(dispatch, i)];
        merge(done);
        if (done == 0u || dispatch + 1u == LSF_LIGHT_TREE_DISPATCHES)
            return;
        node = parents[done];
    }
    if (atomicAdd(parents[visits_index(node)], 1u) == 0u)
        return;
    uint index = atomicAdd(dispatches[dispatch + 1u].w, 1u);
    atomicMax(dispatches[dispatch + 1u].x, index / LSF_LIGHT_TREE_GROUP + 1u);
    ready[ready_index(dispatch + 1u, index)] = node;
}
