/* Chooses among nodes with one key, surfaces that coincide, for the hits that the search listed: by
 * payload, so that the order in the texel's list does not matter. Switches of lib/ray_bundle.glsl. */
#include "lib/ray_bundle.glsl"

layout(local_size_x = 64) in;

#define LSF_BUNDLE_TIE_ACCESS readonly
#include "passes/ray_bundle_ties.glsl"

layout(binding = 0, rg32ui) uniform uimage2D hits;

bool less(uvec2 a, uvec2 b)
{
    return a.x < b.x || (a.x == b.x && a.y < b.y);
}

bool comes_before(uint a, uint b)
{
    if (bundle_surfaces[a] != bundle_surfaces[b])
        return less(bundle_surfaces[a], bundle_surfaces[b]);
#if LSF_BUNDLE_ANISOTROPY
    if (bundle_gloss[a] != bundle_gloss[b])
        return less(bundle_gloss[a], bundle_gloss[b]);
#elif LSF_BUNDLE_GLOSS
    if (bundle_gloss[a] != bundle_gloss[b])
        return bundle_gloss[a] < bundle_gloss[b];
#endif
#if LSF_BUNDLE_EMISSION
    return less(bundle_emission[a], bundle_emission[b]);
#else
    return false;
#endif
}

uint choose(uint texel, uint chosen)
{
    uint key = bundle_key(chosen), count = bundle_texels[texel], link = 0u;
    for (uint turn = 0u; turn < LSF_TURNS && turn * LSF_STEPS < count; turn++)
        for (uint i = turn * LSF_STEPS; i < (turn + 1u) * LSF_STEPS && i < count; i++) {
            uint node = bundle_slice_node(texel, i);
            if (i >= uint(LSF_BUNDLE_SLICES)) {
                link = i == uint(LSF_BUNDLE_SLICES) ? bundle_texels[LSF_BUNDLE_TEXELS + 1u + texel]
                                                    : bundle_chain[link].y;
                node = LSF_BUNDLE_FIRST_LINK + link;
            }
            if (bundle_key(node) == key && comes_before(node, chosen))
                chosen = node;
        }
    return chosen;
}

void main()
{
    uint stride = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    for (uint i = gl_GlobalInvocationID.x; i < tie_count; i += stride) {
        ivec2 pixel = ivec2(ties[i].x & 0xffffu, ties[i].x >> 16);
        uvec2 hit = imageLoad(hits, pixel).xy;
        imageStore(hits, pixel, uvec4(hit.x, choose(ties[i].y, hit.y), 0u, 0u));
    }
}
