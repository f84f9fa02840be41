/* Appends every fragment of the scene to its texel's list. Switches of lib/material.glsl and
 * lib/ray_bundle.glsl. */
#define LSF_BUNDLE_ACCESS coherent
#include "lib/material.glsl"
#include "lib/ray_bundle.glsl"

layout(location = 0) uniform uint chain_room; /* nodes for chaining */

/* Gives the fragment a node and stores its key. LSF_NO_NODE where there is no room left; the counter
 * then still tells how much was needed. */
uint append_node(uint texel, uint key)
{
    uint fragment = atomicAdd(bundle_texels[texel], 1u);
#if LSF_BUNDLE_SLICES
    if (fragment < uint(LSF_BUNDLE_SLICES)) {
        uint node = bundle_slice_node(texel, fragment);
        bundle_keys[node] = key;
        return node;
    }
#endif
    uint link = atomicAdd(bundle_texels[LSF_BUNDLE_TEXELS], 1u);
    if (link >= chain_room)
        return LSF_NO_NODE;
    uint before = atomicExchange(bundle_texels[LSF_BUNDLE_TEXELS + 1u + texel], link);
    bundle_chain[link] = uvec4(key, before, texel, 0u);
    return LSF_BUNDLE_FIRST_LINK + link;
}

void main()
{
    vec2 depth_change = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));
    surface s;
    vec3 emission;
    bool front;
    if (!material_evaluate(-bundle.forward.xyz, s, emission, front))
        discard;
    uvec2 at = uvec2(gl_FragCoord.xy);
    bundle_plane_bits plane =
        bundle_plane_pack(gl_FragCoord.z, depth_change * bundle.range.y / bundle_texel_size());
    uint node = append_node(at.y * uint(LSF_BUNDLE_SIDE) + at.x, plane.key);
    if (node == LSF_NO_NODE)
        return;
    bundle_surfaces[3u * node] = octahedral_encode(s.normal);
    bundle_surfaces[3u * node + 1u] = bundle_color_pack(s.base_color);
    bundle_surfaces[3u * node + 2u] = plane.rest;
#if LSF_BUNDLE_ANISOTROPY
    bundle_gloss[node] = uvec2(bundle_gloss_pack(s.roughness, s.metallic, s.f0),
                               packUnorm2x16(vec2(s.anisotropy, s.anisotropy_turn)));
#elif LSF_BUNDLE_GLOSS
    bundle_gloss[node] = bundle_gloss_pack(s.roughness, s.metallic, s.f0);
#endif
#if LSF_BUNDLE_EMISSION
    uint sides = s.unlit ? 0u
                         : (material_emits(front) ? LSF_BUNDLE_EMITS_BACK : 0u) |
                               (material_emits(!front) ? LSF_BUNDLE_EMITS_AHEAD : 0u);
    bundle_emission[node] = bundle_emission_pack(emission, sides);
#endif
}
