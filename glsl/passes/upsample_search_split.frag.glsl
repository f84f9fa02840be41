/* What each texel of the grid sees: one pixel of its block, not a mean, so that it is a place of a
 * surface. */
#include "lib/coarse.glsl"
#include "lib/gbuffer_copy.glsl"

void main()
{
    gbuffer_copy(coarse_pixel(ivec2(gl_FragCoord.xy)));
}
