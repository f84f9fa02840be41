/* Searches again where the slices do not decide: texels with chained nodes, and hits on surfaces that coincide,
 * among which the payload decides, so that the order of the texel's list does not matter. Switches as in
 * ray_bundle_ray.glsl. */
#define LSF_BUNDLE_REST_ACCESS readonly
#include "passes/ray_bundle_ray.glsl"
#include "passes/ray_bundle_rest.glsl"

layout(local_size_x = 64) in;

layout(binding = 0, rg32ui) writeonly uniform uimage2D hits;

/* In software GL idle lanes run loops up to their bound, so that bounds are low and long lists take several
 * rounds. */
#define LSF_STEPS 64u
#define LSF_ROUNDS 65535u

void search_chain(bundle_ray ray, inout bundle_hit hit)
{
    int left = ray.count - int(bundle.sliced);
    int link = left > 0 ? int(texelFetch(head_fetch, LSF_BUNDLE_COUNTERS + ray.texel).x) : 0;
    for (uint round_index = 0u; round_index < LSF_ROUNDS && left > 0; round_index++)
        for (uint i = 0u; i < LSF_STEPS && left > 0; i++) {
            uvec2 node = texelFetch(chain_fetch, link).xy;
            visit(ray, true, node.x, int(bundle.first_link) + link, hit);
            link = int(node.y);
            left--;
        }
}

#if LSF_BUNDLE_SURFACES

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
        order = compare(bundle_specular_params[a][i], bundle_specular_params[b][i]);
#elif LSF_BUNDLE_SPECULAR_PARAMS
    if (order == 0)
        order = compare(bundle_specular_params[a], bundle_specular_params[b]);
#endif
#if LSF_BUNDLE_EMISSION
    for (int i = 0; i < 2 && order == 0; i++)
        order = compare(bundle_emission[a][i], bundle_emission[b][i]);
#endif
    return order < 0;
}

uint choose(uint texel, uint chosen)
{
    uint key = bundle_key(chosen);
    uint count = bundle_fragments(texel), link = 0u;
    for (uint round_index = 0u; round_index < LSF_ROUNDS && round_index * LSF_STEPS < count; round_index++)
        for (uint i = round_index * LSF_STEPS; i < (round_index + 1u) * LSF_STEPS && i < count; i++) {
            uint node = bundle_slice_node(texel, i);
            if (i >= bundle.sliced) {
                link = i == bundle.sliced ? bundle_heads[uint(LSF_BUNDLE_COUNTERS) + texel]
                                          : bundle_chain[link].y;
                node = bundle.first_link + link;
            }
            if (bundle_key(node) == key && comes_before(node, chosen))
                chosen = node;
        }
    return chosen;
}

#endif

void main()
{
    uint stride = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    for (uint i = gl_GlobalInvocationID.x; i < rest_count; i += stride) {
        ivec2 pixel = ivec2(rest[i] & 0xffffu, rest[i] >> 16);
        bundle_frame frame = frame_at(vec2(pixel) + 0.5);
        bundle_ray ray = ray_of(pixel, frame);
        bundle_hit hit = search_slices(ray);
        search_chain(ray, hit);
#if LSF_BUNDLE_SURFACES
        if (hit.tie)
            hit.node = int(choose(uint(ray.texel), uint(hit.node)));
#endif
        imageStore(hits, pixel, uvec4(hit_pack(ray, hit, frame), 0u, 0u));
    }
}
