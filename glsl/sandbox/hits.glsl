/* Hits of a ray-bundle's rays from the visible points, for user shaders. */
#ifndef LSF_SANDBOX_HITS
#define LSF_SANDBOX_HITS

#include "sandbox/gbuffer.glsl"
#include "shared/sandbox_data.h"

layout(binding = LSF_UNIT_BUNDLE_HITS) uniform usampler2D bundle_hits;

bool lsf_bundle_hit(vec2 pixel, out float distance, out uint node)
{
    uvec2 hit = texelFetch(bundle_hits, seen_texel(pixel), 0).rg;
    distance = uintBitsToFloat(hit.x);
    node = hit.y;
    return node != LSF_NO_NODE;
}

#endif
