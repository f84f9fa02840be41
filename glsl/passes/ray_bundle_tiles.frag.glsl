/* Least and greatest depth of each tile of the picture; with the tile's corners they bound all points that it
 * shows. */
#include "shared/bundle_data.h"

layout(binding = 0) uniform sampler2D depth_texture;
layout(location = 0) uniform int tile_texels; /* LSF_BUNDLE_TILE squared; no compile-time constant, because
                                               * software GL would unroll the loop */
layout(location = 0) out vec2 depths_out; /* least and greatest, reverse-Z; a least of 2: the tile is empty */

void main()
{
    ivec2 first = ivec2(gl_FragCoord.xy) * LSF_BUNDLE_TILE;
    ivec2 last = textureSize(depth_texture, 0) - 1;
    vec2 depths = vec2(2.0, 0.0);
    for (int i = 0; i < tile_texels; i++) {
        ivec2 at = min(first + ivec2(i % LSF_BUNDLE_TILE, i / LSF_BUNDLE_TILE), last);
        float depth = texelFetch(depth_texture, at, 0).r;
        depths = vec2(min(depths.x, depth == 0.0 ? 2.0 : depth), max(depths.y, depth));
    }
    depths_out = depths;
}
