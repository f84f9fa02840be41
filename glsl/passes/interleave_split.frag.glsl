/* The G-buffer in split order. */
#include "lib/gbuffer_copy.glsl"
#include "lib/interleave.glsl"

void main()
{
    gbuffer_copy(interleave_pixel(ivec2(gl_FragCoord.xy), textureSize(depth_texture, 0)));
}
