/* Light without the tint of what reflected it, and in alpha the variance of its mean's luminance: below 0 where
 * nothing is reflected, or what is not a number whose square is one, so that there is no telling. */
#include "lib/luminance.glsl"

layout(binding = 2) uniform sampler2D light_texture; /* of lsf_light_mean_part */
layout(binding = 3) uniform sampler2D factor_texture;
layout(location = 1) uniform float iterations;
layout(location = 0) out vec4 light_out;

#define LARGEST 1e18

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 light = texelFetch(light_texture, pixel, 0);
    vec3 factor = texelFetch(factor_texture, pixel, 0).rgb;
    float tint = luminance(factor);
    light_out = vec4(vec3(0.0), -1.0);
    if (!(tint > 0.0))
        return;
    /* A colour that is not reflected is as bright as the others. */
    float grey = luminance(light.rgb) / tint;
    vec3 clear = vec3(factor.r > 0.0 ? light.r / factor.r : grey, factor.g > 0.0 ? light.g / factor.g : grey,
                      factor.b > 0.0 ? light.b / factor.b : grey);
    float variance = iterations > 1.0 ? light.a / (iterations * (iterations - 1.0) * tint * tint) : 0.0;
    /* No comparison holds for what is not a number. */
    if (all(lessThan(abs(clear), vec3(LARGEST))) && variance < LARGEST * LARGEST)
        light_out = vec4(clear, variance);
}
