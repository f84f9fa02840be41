/* Fits the window of a bundle to the visible points, one work group per bundle. The points of a tile lie in the
 * part of the view that is bounded by the tile's corners and its least and greatest depth, and a linear function
 * takes its extremes at the corners of that part. Switches LSF_ORTHOGRAPHIC, LSF_BUNDLE_GAPS. */
#include "lib/bundle_map.glsl"
#include "lib/view.glsl"

layout(local_size_x = LSF_BUNDLE_FIT_SIZE) in;

layout(std430, binding = LSF_BINDING_BUNDLE_NODES) buffer lsf_projection_block
{
    lsf_bundle_slot_data projections[];
};
layout(binding = 0) uniform sampler2D tiles;

shared vec4 bounds[LSF_BUNDLE_FIT_SIZE]; /* minima and maxima along right and up */

vec4 merge(vec4 a, vec4 b)
{
    return vec4(min(a.xy, b.xy), max(a.zw, b.zw));
}

void main()
{
    lsf_bundle_data b = projections[gl_WorkGroupID.x].data;
    ivec2 size = textureSize(tiles, 0);
    uint tile_count = uint(size.x * size.y);
    vec4 box = vec4(1e30, 1e30, -1e30, -1e30);
    for (uint i = gl_LocalInvocationIndex; i < tile_count; i += uint(LSF_BUNDLE_FIT_SIZE)) {
        ivec2 tile = ivec2(int(i) % size.x, int(i) / size.x);
        vec2 depths = texelFetch(tiles, tile, 0).rg;
        if (depths.y == 0.0)
            continue;
        vec2 low = sample_ndc(vec2(tile * LSF_BUNDLE_TILE) + 0.5);
        vec2 high = sample_ndc(
            min(vec2((tile + 1) * LSF_BUNDLE_TILE), view.size.xy) - 0.5);
        for (int corner = 0; corner < 8; corner++) {
            vec2 ndc = vec2((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y);
            vec3 p = position_from_depth(ndc, (corner & 4) != 0 ? depths.y : depths.x);
            vec2 q = bundle_map_coordinates(b, p).xy;
            box = merge(box, vec4(q, q));
        }
    }
    bounds[gl_LocalInvocationIndex] = box;
    barrier();
    for (uint half_size = uint(LSF_BUNDLE_FIT_SIZE) / 2u; half_size > 0u; half_size /= 2u) {
        if (gl_LocalInvocationIndex < half_size)
            bounds[gl_LocalInvocationIndex] = merge(
                bounds[gl_LocalInvocationIndex], bounds[gl_LocalInvocationIndex + half_size]);
        barrier();
    }
    if (gl_LocalInvocationIndex != 0u)
        return;
    box = bounds[0];
    if (box.x > box.z) /* nothing is seen */
        box = vec4(0.0);
    float texels = b.range.z;
    vec2 extent = vec2(lsf_bundle_extent(box.x, box.z, texels),
                       lsf_bundle_extent(box.y, box.w, texels));
    /* The host has stored the grid's offset [texels] in place of the window's centre. */
    vec2 center = 0.5 * (box.xy + box.zw) + b.window.xy * 2.0 * extent / texels;
    projections[gl_WorkGroupID.x].data.window = vec4(center, extent * b.right.w);
}
