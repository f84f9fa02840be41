/* The first of two steps of lib/light_window.glsl. */
#include "lib/view.glsl"

#include "lib/light_window.glsl"

layout(location = 0) out vec4 window_out;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    light_guide g = light_guide_at(pixel);
    window_out = g.depth == 0.0 ? vec4(0.0) : window_gather(g, pixel, 1);
}
