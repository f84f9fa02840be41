/* Chooses among nodes with one key, surfaces that coincide, for the hits that the search listed: by
 * payload, so that the order in the texel's list does not matter. Switches of lib/ray_bundle.glsl. */
#include "lib/ray_bundle.glsl"

layout(local_size_x = 64) in;

#define LSF_BUNDLE_TIE_ACCESS readonly
#include "passes/ray_bundle_ties.glsl"

layout(binding = 0, rg32ui) uniform uimage2D hits;

/* -1, 0 or 1 */
int compare(uint a, uint b)
{
    return a < b ? -1 : int(a > b);
}

bool comes_before(uint a, uint b)
{
    int order = 0;
    for (uint i = 0u; i < 3u && order == 0; i++)
        order = compare(bundle_surfaces[3u * a + i], bundle_surfaces[3u * b + i]);
#if LSF_BUNDLE_ANISOTROPY
    for (int i = 0; i < 2 && order == 0; i++)
        order = compare(bundle_gloss[a][i], bundle_gloss[b][i]);
#elif LSF_BUNDLE_GLOSS
    if (order == 0)
        order = compare(bundle_gloss[a], bundle_gloss[b]);
#endif
#if LSF_BUNDLE_EMISSION
    for (int i = 0; i < 2 && order == 0; i++)
        order = compare(bundle_emission[a][i], bundle_emission[b][i]);
#endif
    return order < 0;
}

uint choose(uint chosen)
{
    uint key = bundle_key(chosen);
    uint texel = bundle_texel(chosen), count = bundle_texels[texel], link = 0u;
    for (uint turn = 0u; turn < LSF_TURNS && turn * LSF_STEPS < count; turn++)
        for (uint i = turn * LSF_STEPS; i < (turn + 1u) * LSF_STEPS && i < count; i++) {
            uint node = bundle_slice_node(texel, i);
            if (i >= uint(LSF_BUNDLE_SLICES)) {
                link = i == uint(LSF_BUNDLE_SLICES) ? bundle_texels[LSF_BUNDLE_FIRST_HEAD + texel]
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
        ivec2 pixel = ivec2(ties[i] & 0xffffu, ties[i] >> 16);
        uvec2 hit = imageLoad(hits, pixel).xy;
        imageStore(hits, pixel, uvec4(hit.x, choose(hit.y), 0u, 0u));
    }
}
