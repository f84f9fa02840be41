/* The tree over a cloud of VPLs: its buffers, and the nodes that links lead to. Switches LSF_SPECULAR (VPLs may have
 * lobes), LSF_LIGHT_TREE_COVARIANCE. Shaders that build the tree define LIGHT_TREE_ACCESS as empty, because they write
 * it; those that sample it define LIGHT_TREE_FETCH as 1 and read buffer textures, which software GL fetches for all
 * lanes at once, and storage buffers lane by lane. */
#ifndef LSF_LIB_LIGHT_TREE
#define LSF_LIB_LIGHT_TREE

#include "lib/luminance.glsl"
#include "lib/octahedral.glsl"
#include "lib/vpl_lobe.glsl"
#include "shared/light_tree_data.h"
#include "shared/vpl_record.h"

#ifndef LIGHT_TREE_ACCESS
#define LIGHT_TREE_ACCESS readonly
#endif

layout(std430, binding = LSF_BINDING_LIGHT_TREE) LIGHT_TREE_ACCESS buffer lsf_light_tree_block
{
    lsf_light_tree_data tree;
};
#if LIGHT_TREE_FETCH
layout(binding = LSF_UNIT_LIGHT_TREE_CLOUD) uniform usamplerBuffer cloud_fetch;
layout(binding = LSF_UNIT_LIGHT_TREE_NODES) uniform usamplerBuffer node_fetch;

lsf_vpl_record light_record_at(uint record)
{
    uvec4 place = texelFetch(cloud_fetch, int(2u * record)), light = texelFetch(cloud_fetch, int(2u * record + 1u));
    return lsf_vpl_record(uintBitsToFloat(place.xyz), place.w, uintBitsToFloat(light.xyz), light.w);
}

lsf_light_tree_node light_inner_node(uint index)
{
    uvec4 t[6];
    for (int i = 0; i < 6; i++)
        t[i] = texelFetch(node_fetch, int(6u * index) + i);
    return lsf_light_tree_node(uintBitsToFloat(t[0].xyz), uintBitsToFloat(t[0].w), uintBitsToFloat(t[1].xyz), t[1].w,
                               uintBitsToFloat(t[2].xyz), t[2].w, uintBitsToFloat(t[3].xyz), t[3].w,
                               uintBitsToFloat(t[4].xyz), t[4].w, uintBitsToFloat(t[5].xyz), t[5].w);
}
#else
layout(std430, binding = LSF_BINDING_CLOUD) readonly buffer lsf_cloud_block
{
    lsf_vpl_record cloud[];
};
layout(std430, binding = LSF_BINDING_LIGHT_TREE_NODES) LIGHT_TREE_ACCESS buffer lsf_light_tree_node_block
{
    lsf_light_tree_node nodes[];
};

lsf_vpl_record light_record_at(uint record)
{
    return cloud[record];
}

lsf_light_tree_node light_inner_node(uint index)
{
    return nodes[index];
}
#endif

bool light_is_leaf(uint link)
{
    return (link & LSF_LIGHT_TREE_LEAF) != 0u;
}

uint light_record(uint link)
{
    return link & ~LSF_LIGHT_TREE_LEAF;
}

/* A single VPL as a node. */
lsf_light_tree_node light_leaf(uint record)
{
    lsf_light_tree_node leaf;
    lsf_vpl_record vpl = light_record_at(record);
    leaf.position = leaf.low = leaf.high = vpl.position;
    leaf.intensity = vpl.intensity;
    leaf.normal = vpl.normal;
    leaf.similarity = 1.0;
    leaf.variance = leaf.covariance = vec3(0.0);
    leaf.left = leaf.right = LSF_LIGHT_TREE_NONE;
    leaf.count = 1u;
    leaf.usable = LSF_LIGHT_TREE_USABLE;
#if LSF_SPECULAR
    if (vpl_has_lobe(vpl)) {
        vpl_lobe lobe = vpl_lobe_unpack(vpl);
        leaf.normal = octahedral_encode(vpl_lobe_axis(octahedral_decode(leaf.normal), lobe));
        leaf.similarity = vpl_lobe_mean_cosine(lsf_alpha_from_roughness(lobe.roughness));
        leaf.usable = LSF_LIGHT_TREE_LOBES;
    }
#endif
    return leaf;
}

lsf_light_tree_node light_node(uint link)
{
    if (light_is_leaf(link))
        return light_leaf(light_record(link));
    return light_inner_node(link);
}

#if LSF_LIGHT_TREE_COVARIANCE
mat3 light_covariance(lsf_light_tree_node node)
{
    vec3 v = node.variance, c = node.covariance;
    return mat3(v.x, c.x, c.y, c.x, v.y, c.z, c.y, c.z, v.z);
}
#endif

/* Axes of a node: z is the normal, x and y lie in its plane. */
mat3 light_tree_frame(vec3 normal)
{
    vec3 t, b;
    orthonormal_basis(normal, t, b);
    return mat3(t, b, normal);
}

/* Variance of positions along a unit vector; `frame`: the node's. */
float light_variance_along(lsf_light_tree_node node, vec3 axis, mat3 frame)
{
#if LSF_LIGHT_TREE_COVARIANCE
    return max(dot(axis, light_covariance(node) * axis), 0.0);
#else
    vec3 along = axis * frame;
    return dot(along * along, node.variance);
#endif
}

/* Sum of the variances of positions along all three axes. */
float light_variance(lsf_light_tree_node node)
{
    return node.variance.x + node.variance.y + node.variance.z;
}

/* Squared radius of the disc whose area each VPL of the node stands for: VPLs that are spread evenly over a disc
 * have a radius of 2 sigma, along either axis. */
float light_disc2(lsf_light_tree_node node, mat3 frame)
{
#if LSF_LIGHT_TREE_COVARIANCE
    mat3 world = light_covariance(node);
    float xy = dot(frame[0], world * frame[1]);
    float square = dot(frame[0], world * frame[0]) * dot(frame[1], world * frame[1]) - xy * xy;
#else
    float square = node.variance.x * node.variance.y;
#endif
    return 4.0 * sqrt(max(square, 0.0)) / float(node.count);
}

#endif
