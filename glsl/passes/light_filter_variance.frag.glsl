/* Brings the variance closer to what neighbours on the same surface have on the average, the fewer iterations tell
 * it; after one iteration, which tells none, it is the variance among them. */
#include "lib/view.glsl"

#include "lib/light_window.glsl"

layout(binding = 3) uniform sampler2D light_texture; /* A: variance, below 0 where it tells nothing */
layout(location = 2) uniform float uncertainty;      /* relative variance of the pixel's own variance */
layout(location = 3) uniform bool halves;            /* the mean of a first part of the iterations is known */
layout(location = 0) out vec4 light_out;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    light_guide g = light_guide_at(pixel);
    light_out = texelFetch(light_texture, pixel, 0);
    if (g.depth == 0.0 || light_out.a < 0.0)
        return;
    vec4 window = window_gather(g, pixel, 3);
    if (window_moments) {
        light_out.a = window.y;
        return;
    }
    float variance = window.x, even = halves && variance > 0.0 ? min(window.y / variance, 1.0) : 1.0;
    /* Variances of light differ by factors: their logarithms are mixed. */
    float part = uncertainty / (1.0 + uncertainty);
    light_out.a = pow(even, 1.0 - part) * variance * pow(max(light_out.a / max(variance, 1e-37), 1e-3), 1.0 - part);
}
