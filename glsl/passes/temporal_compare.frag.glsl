/* Noise of a frame's light without tint, and its difference from the reprojected history. A single iteration shows
 * no noise: its luminance is stored, whose variance among neighbours temporal_window takes. Switch LSF_LOBE: there is
 * specular light. */
#include "lib/light_clear.glsl"

layout(binding = 2) uniform sampler2D light_textures[1 + LSF_LOBE]; /* of lsf_light_mean_part */
layout(binding = 4) uniform sampler2D factor_textures[1 + LSF_LOBE];
layout(binding = 6) uniform sampler2D carried_textures[1 + LSF_LOBE]; /* light without tint */
layout(binding = 8) uniform sampler2D reach_texture;                  /* X, Y: samples of both parts */
layout(location = 1) uniform float iterations;
layout(location = 0) out vec4 compared_out; /* of diffuse light and of specular: variance of the luminance among
                                             * iterations, or the luminance of a single one; difference */

#include "passes/temporal_none.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 reach = texelFetch(reach_texture, pixel, 0);
    compared_out = vec4(NONE);
    for (int part = 0; part <= LSF_LOBE; part++) {
        vec4 light;
        if (!light_clear(texelFetch(light_textures[part], pixel, 0), texelFetch(factor_textures[part], pixel, 0).rgb,
                         light))
            continue;
        compared_out[2 * part] =
            iterations > 1.0 ? light.a / (iterations * (iterations - 1.0)) : luminance(light.rgb);
        if (reach[part] > 0.0)
            compared_out[2 * part + 1] =
                luminance(light.rgb) - luminance(texelFetch(carried_textures[part], pixel, 0).rgb);
    }
}
