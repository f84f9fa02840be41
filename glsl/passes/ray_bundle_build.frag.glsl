/* Appends every fragment of the scene to its texel's list. Switches of lib/material.glsl and
 * lib/ray_bundle.glsl. */
#define LSF_BUNDLE_ACCESS coherent
#include "lib/material.glsl"
#include "lib/ray_bundle.glsl"

layout(location = 0) uniform uint chain_room; /* nodes for chaining */

/* LSF_NO_NODE where there is no room left; the counter then still tells how much was needed. */
uint append_node(uint texel)
{
    uint slices = uint(LSF_BUNDLE_SLICES) * bundle_texel_count();
    uint rank = atomicAdd(bundle_texels[texel], 1u);
    if (rank < uint(LSF_BUNDLE_SLICES))
        return rank * bundle_texel_count() + texel;
    uint link = atomicAdd(bundle_texels[bundle_texel_count()], 1u);
    if (link >= chain_room)
        return LSF_NO_NODE;
    bundle_next[link] =
        atomicExchange(bundle_texels[bundle_texel_count() + 1u + texel], slices + link);
    return slices + link;
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
    uint node = append_node(at.y * bundle_side() + at.x);
    if (node == LSF_NO_NODE)
        return;
    vec2 slope = depth_change * bundle.range.y / bundle_texel_size();
    bundle_keys[node] = bundle_key_pack(gl_FragCoord.z, slope);
    bundle_surfaces[node] =
        uvec4(octahedral_encode(s.normal), bundle_color_pack(s.base_color),
              floatBitsToUint(gl_FragCoord.z), packHalf2x16(clamp(slope, -65504.0, 65504.0)));
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
