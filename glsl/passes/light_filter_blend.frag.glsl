/* What the filter changes of the picture: added to it. Of the filtered light no more is taken than the noise
 * explains: where light and filtered light differ by more than that, the difference is the filter's bias. */
#include "lib/view.glsl"

#include "lib/light_guide.glsl"

layout(binding = 2) uniform sampler2D light_texture; /* A: variance, below 0 where it tells nothing */
#if !LSF_LOBE
layout(binding = 3) uniform sampler2D factor_texture;
#endif
layout(binding = 4) uniform sampler2D filtered_texture;
layout(location = 1) uniform float uncertainty; /* relative variance of the variance; below 0: no limit */
layout(location = 0) out vec4 change_out;

#define REACH 3

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy), size = textureSize(guide_texture, 0);
    light_guide g = light_guide_at(pixel);
    change_out = vec4(0.0);
    vec4 own = texelFetch(light_texture, pixel, 0);
    if (g.depth == 0.0 || own.a < 0.0)
        return;
    vec4 filtered = texelFetch(filtered_texture, pixel, 0);
    vec3 change = filtered.rgb - own.rgb;
    float gone = max(own.a - filtered.a, 0.0), sum = 1.0, noise = gone, square = luminance(change) * luminance(change);
    for (int j = -REACH; j <= REACH; j++)
        for (int i = -REACH; i <= REACH; i++) {
            ivec2 at = pixel + ivec2(i, j);
            if (at == pixel || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size)))
                continue;
            vec4 light = texelFetch(light_texture, at, 0);
            if (light.a < 0.0)
                continue;
            float w = light_guide_weight(g, pixel, at);
            filtered = texelFetch(filtered_texture, at, 0);
            float d = luminance(filtered.rgb - light.rgb);
            sum += w;
            noise += w * max(light.a - filtered.a, 0.0);
            square += w * d * d;
        }
    float share = 1.0;
    if (uncertainty >= 0.0) {
        /* Of both, the mean square of the change and the variance, the relative variance is 2 / sum. */
        noise *= 1.0 + 2.0 * sqrt(4.0 / sum + uncertainty);
        float alone = luminance(change) * luminance(change), most = 9.0 * gone * (1.0 + sqrt(uncertainty));
        share = min(square > noise ? noise / square : 1.0, alone > most ? most / alone : 1.0);
    }
    change_out.rgb = share * change * texelFetch(factor_texture, pixel, 0).rgb;
}
