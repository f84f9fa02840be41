/* The lists of a ray-bundle, for user shaders. */
#ifndef LSF_SANDBOX_BUNDLE
#define LSF_SANDBOX_BUNDLE

#include "lib/ray_bundle.glsl"

int lsf_bundle_size()
{
    return int(bundle.side);
}

vec2 lsf_bundle_texel(vec3 position)
{
    return bundle_map_position(bundle_coordinates(position));
}

int lsf_bundle_count(ivec2 texel)
{
    return bundle_has(texel) ? int(bundle_fragments(uint(bundle_texel(texel)))) : 0;
}

uint lsf_bundle_node(ivec2 texel, int i)
{
    uint at = uint(bundle_texel(texel));
    if (i < int(bundle.sliced))
        return bundle_slice_node(at, uint(i));
    uint link = bundle_heads[uint(LSF_BUNDLE_COUNTERS) + at];
    for (int k = int(bundle.sliced); k < i; k++)
        link = bundle_chain[link].y;
    return bundle.first_link + link;
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
