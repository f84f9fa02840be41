/* Appends nodes to the texels' lists, for both rasterisers. Switches of lib/ray_bundle.glsl, LSF_BUNDLE_SURFACES:
 * surfaces are stored, not only distances, and LSF_ABSORPTION: there are media. */
#ifndef LSF_PASSES_RAY_BUNDLE_APPEND
#define LSF_PASSES_RAY_BUNDLE_APPEND

#define LSF_BUNDLE_ACCESS coherent
#include "lib/ray_bundle.glsl"
#if LSF_STRAIGHT
#include "lib/chance.glsl"
#include "lib/straight.glsl"
#endif

layout(location = 0) uniform uint chain_capacity; /* nodes for chaining */

/* Allocates a node for the fragment and stores its key. LSF_NO_NODE where the buffer is full; the counter then
 * still tells the capacity that is needed. */
uint append_node(uint texel, uint key)
{
    uint fragment = atomicAdd(bundle_keys[4u * texel], 1u);
    if (fragment < bundle.sliced) {
        uint node = bundle_slice_node(texel, fragment);
        bundle_keys[node] = key;
        return node;
    }
    uint link = atomicAdd(bundle_heads[LSF_BUNDLE_CHAINED], 1u);
    if (link >= chain_capacity)
        return LSF_NO_NODE;
    uint before = atomicExchange(bundle_heads[uint(LSF_BUNDLE_COUNTERS) + texel], link);
    bundle_chain[link] = uvec2(key, before);
    return bundle.first_link + link;
}

/* `sides`: LSF_BUNDLE_EMITS_BACK and LSF_BUNDLE_EMITS_AHEAD. */
void append_surface(uint texel, bundle_plane_bits plane, surface s, vec3 emission, uint sides)
{
    uint color = bundle_color_pack(s.base_color), normal = octahedral_encode(s.normal);
#if LSF_BUNDLE_SURFACES && LSF_STRAIGHT
    float passes = straight_chance(straight_transmittance(s, bundle.forward.xyz));
    if (passes > 0.0 && chance_number(uvec3(plane.key, plane.rest, texel)) < passes) {
        plane = bundle_veil_pack(plane);
        color = bundle_tint_pack(straight_tint(s, bundle.forward.xyz));
#if LSF_ABSORPTION
        normal = bundle_absorption_pack(s.volume ? materials[s.material].absorption.rgb : vec3(0.0), s.front);
#endif
    }
#endif
    uint node = append_node(texel, plane.key);
    if (node == LSF_NO_NODE)
        return;
#if LSF_BUNDLE_SURFACES
    bundle_surfaces[3u * node] = normal;
    bundle_surfaces[3u * node + 1u] = color;
    bundle_surfaces[3u * node + 2u] = plane.rest;
#if LSF_BUNDLE_ANISOTROPY
#if LSF_STRAIGHT
    uvec3 more = uvec3(clamp(vec3(s.anisotropy, s.anisotropy_angle, s.transmission), 0.0, 1.0) *
                           vec3(4095.0, 4095.0, 255.0) + 0.5);
    uint rest = more.x | more.y << 12 | more.z << 24;
#else
    uint rest = packUnorm2x16(vec2(s.anisotropy, s.anisotropy_angle));
#endif
    bundle_specular_params[node] = uvec2(bundle_specular_params_pack(s.roughness, s.metallic, s.f0), rest);
#elif LSF_BUNDLE_SPECULAR_PARAMS
    bundle_specular_params[node] = bundle_specular_params_pack(s.roughness, s.metallic, s.f0);
#endif
#if LSF_BUNDLE_EMISSION
    bundle_emission[node] = bundle_emission_pack(emission, s.unlit ? 0u : sides);
#endif
#endif
}

#endif
