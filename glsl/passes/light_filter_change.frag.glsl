/* The variance that the filter took out of a pixel's light, and the square of what it changed it by; for
 * lib/light_window.glsl. */
#include "lib/luminance.glsl"

layout(binding = 2) uniform sampler2D light_texture; /* A: variance, below 0 where it tells nothing */
layout(binding = 3) uniform sampler2D filtered_texture;
layout(location = 0) out vec4 window_out;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 light = texelFetch(light_texture, pixel, 0), filtered = texelFetch(filtered_texture, pixel, 0);
    float change = luminance(filtered.rgb - light.rgb);
    window_out = light.a < 0.0 ? vec4(0.0) : vec4(max(light.a - filtered.a, 0.0), change * change, 0.0, 1.0);
}
