/* Light without the tint of the surface that reflected it, and in alpha the variance of its mean's luminance:
 * below 0, which means unknown, where nothing is reflected, or where a value is not finite or its square
 * overflows. Beside it the values from which neighbours estimate the variance (lib/light_window.glsl). */
#include "lib/light_clear.glsl"

layout(binding = 2) uniform sampler2D light_textures[1 + LSF_LOBE]; /* of lsf_light_mean_part */
layout(binding = 4) uniform sampler2D factor_textures[1 + LSF_LOBE];
layout(binding = 6) uniform sampler2D half_texture; /* luminances of the means of the first m */
layout(location = 1) uniform float iterations;
layout(location = 2) uniform float half_weight; /* m / (n - m); below 0: there is no such mean */
layout(location = 0) out vec4 light_out[1 + LSF_LOBE];
layout(location = 1 + LSF_LOBE) out vec4 window_out[1 + LSF_LOBE]; /* the variance, and that from the first m;
                                                                    * after one iteration the luminance, 0 */

void divide(ivec2 pixel, int part)
{
    vec4 light = texelFetch(light_textures[part], pixel, 0), clear;
    vec3 factor = texelFetch(factor_textures[part], pixel, 0).rgb;
    light_out[part] = vec4(vec3(0.0), -1.0);
    window_out[part] = vec4(0.0);
    if (!light_clear(light, factor, clear))
        return;
    float variance = iterations > 1.0 ? clear.a / (iterations * (iterations - 1.0)) : 0.0;
    light_out[part] = vec4(clear.rgb, variance);
    /* The variance from the distance between the mean of the first m iterations and that of all. */
    float apart = (texelFetch(half_texture, pixel, 0)[part] - luminance(light.rgb)) / max(luminance(factor), 1e-20);
    float halves = half_weight >= 0.0 ? apart * apart * half_weight : 0.0;
    window_out[part] = vec4(iterations > 1.0 ? vec2(variance, halves) : vec2(luminance(clear.rgb), 0.0), 0.0, 1.0);
}

void main()
{
    for (int part = 0; part <= LSF_LOBE; part++)
        divide(ivec2(gl_FragCoord.xy), part);
}
