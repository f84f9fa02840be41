/* The first of two steps of lib/light_window.glsl, over the variance that the filter removed from a pixel's light
 * and the square of the change. */
#include "lib/view.glsl"

#include "lib/luminance.glsl"

layout(binding = 2) uniform sampler2D light_textures[1 + LSF_LOBE]; /* A: variance, below 0: unknown */
layout(binding = 4) uniform sampler2D filtered_textures[1 + LSF_LOBE];
layout(location = 0) out vec4 window_out[1 + LSF_LOBE];

vec4 window_value(ivec2 at, int part)
{
    vec4 light = texelFetch(light_textures[part], at, 0), filtered = texelFetch(filtered_textures[part], at, 0);
    float change = luminance(filtered.rgb - light.rgb);
    return vec4(max(light.a - filtered.a, 0.0), change * change, 0.0, light.a < 0.0 ? 0.0 : 1.0);
}

#include "lib/light_window.glsl"

void main()
{
    window_begin(ivec2(gl_FragCoord.xy), window_out);
}
