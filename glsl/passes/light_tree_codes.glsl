/* Codes of the VPLs, whose order builds the tree. From the highest bit on: 1 for a dead VPL, 30 bits of a Morton
 * code of its position, 9 of its normal, and its number in the cloud, which makes codes unique. With the switch
 * LSF_SPECULAR the first of the 30 bits is 1 for a VPL with a lobe, and the last one is left out: VPLs with lobes have a
 * subtree of their own. */
#ifndef LSF_PASSES_LIGHT_TREE_CODES
#define LSF_PASSES_LIGHT_TREE_CODES

#define LIGHT_TREE_ACCESS
#include "lib/light_tree.glsl"

layout(location = LSF_LOCATION_LIGHT_TREE_RECORDS) uniform uint record_count;

#define CODE_DEAD 0x80000000u
#define CODE_LOBE 0x20000000u /* of the 30 bits of place */
#define CODE_ID_MASK ((1u << LSF_LIGHT_TREE_ID_BITS) - 1u)

layout(std430, binding = LSF_BINDING_LIGHT_TREE_CODES) buffer lsf_light_tree_code_block
{
    uvec2 codes[]; /* high and low words */
};

/* Whether |x| is far from overflowing; tested by its bits, because compilers assume that there are no NaNs. */
bool is_small(float x)
{
    return (floatBitsToUint(x) & 0x7fffffffu) < floatBitsToUint(1e30);
}

/* Whether the record has no light, or values that are not finite. */
bool light_is_dead(lsf_vpl_record record)
{
    float light = luminance(record.intensity);
    vec3 p = record.position;
    return !is_small(light) || light <= 0.0 || !is_small(p.x) || !is_small(p.y) || !is_small(p.z);
}

#endif
