/* The lists of a ray-bundle, for user shaders. */
#ifndef LSF_SANDBOX_BUNDLE
#define LSF_SANDBOX_BUNDLE

#include "lib/ray_bundle.glsl"

int lsf_bundle_size()
{
    return LSF_BUNDLE_SIDE;
}

vec2 lsf_bundle_texel(vec3 position)
{
    return bundle_map_position(bundle_coordinates(position));
}

bool bundle_has(ivec2 texel)
{
    return min(texel.x, texel.y) >= 0 && max(texel.x, texel.y) < LSF_BUNDLE_SIDE;
}

int lsf_bundle_count(ivec2 texel)
{
    return bundle_has(texel) ? int(bundle_fragments(uint(bundle_texel(texel)))) : 0;
}

uint lsf_bundle_node(ivec2 texel, int i)
{
    uint at = uint(bundle_texel(texel));
    if (i < LSF_BUNDLE_SLICES)
        return bundle_slice_node(at, uint(i));
    uint link = bundle_heads[uint(LSF_BUNDLE_COUNTERS) + at];
    for (int k = LSF_BUNDLE_SLICES; k < i; k++)
        link = bundle_chain[link].y;
    return LSF_BUNDLE_FIRST_LINK + link;
}

float lsf_bundle_depth(uint node)
{
    return bundle_plane(node).x;
}

surface lsf_bundle_surface(uint node, vec3 direction, out vec3 emission)
{
    return bundle_surface(node, direction, emission);
}

vec3 lsf_bundle_direction()
{
    return bundle.forward.xyz;
}

#endif
