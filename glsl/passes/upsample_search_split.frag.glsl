/* What each texel of the grid sees: one pixel of its block, not a mean, so that it is a place of a
 * surface. */
#include "lib/coarse.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform usampler2D surface_texture;
#if LSF_GLOSS
layout(binding = 2) uniform usampler2D gloss_texture;
#endif

layout(location = 0) out float depth_out;
layout(location = 1) out uvec4 surface_out;
#if LSF_GLOSS
layout(location = 2) out uvec2 gloss_out;
#endif

void main()
{
    ivec2 pixel = coarse_pixel(ivec2(gl_FragCoord.xy));
    depth_out = texelFetch(depth_texture, pixel, 0).r;
    surface_out = texelFetch(surface_texture, pixel, 0);
#if LSF_GLOSS
    gloss_out = texelFetch(gloss_texture, pixel, 0).xy;
#endif
}
