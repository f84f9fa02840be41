/* What the filter changes of the picture: added to it. Of the filtered light no more is taken than the noise
 * explains: where light and filtered light differ by more than that, the difference is the filter's bias. */
#include "lib/view.glsl"

#include "lib/light_guide.glsl"

layout(binding = 2) uniform sampler2D light_texture; /* A: variance */
#if !LSF_LOBE
layout(binding = 3) uniform sampler2D factor_texture;
#endif
layout(binding = 4) uniform sampler2D filtered_texture;
layout(location = 1) uniform float confidence;
layout(location = 0) out vec4 change_out;

#define REACH 3

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy), size = textureSize(guide_texture, 0);
    light_guide g = light_guide_at(pixel);
    change_out = vec4(0.0);
    if (g.depth == 0.0)
        return;
    vec4 own = texelFetch(light_texture, pixel, 0);
    vec3 change = texelFetch(filtered_texture, pixel, 0).rgb - own.rgb;
    float noise = own.a, square = luminance(change) * luminance(change);
    for (int j = -REACH; j <= REACH; j++)
        for (int i = -REACH; i <= REACH; i++) {
            ivec2 at = pixel + ivec2(i, j);
            if (at == pixel || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size)))
                continue;
            float w = light_guide_weight(g, pixel, at);
            vec4 light = texelFetch(light_texture, at, 0);
            float d = luminance(texelFetch(filtered_texture, at, 0).rgb - light.rgb);
            noise += w * light.a;
            square += w * d * d;
        }
    noise *= confidence;
    float share = square > noise ? noise / square : 1.0;
    change_out.rgb = share * change * texelFetch(factor_texture, pixel, 0).rgb;
}
