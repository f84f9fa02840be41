/* What the filter changes of the picture: added to it. Of the filtered light no more is taken than the noise
 * explains: where light and filtered light differ by more than that, the difference is the filter's bias. */
#include "lib/view.glsl"

#include "lib/light_window.glsl"

layout(binding = 3) uniform sampler2D light_texture; /* A: variance, below 0 where it tells nothing */
layout(binding = 4) uniform sampler2D filtered_texture;
layout(binding = 5) uniform sampler2D factor_texture;
layout(location = 2) uniform float uncertainty; /* relative variance of the variance; below 0: no limit */
layout(location = 0) out vec4 change_out;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    light_guide g = light_guide_at(pixel);
    change_out = vec4(0.0);
    vec4 own = texelFetch(light_texture, pixel, 0);
    if (g.depth == 0.0 || own.a < 0.0)
        return;
    vec4 filtered = texelFetch(filtered_texture, pixel, 0);
    vec3 change = filtered.rgb - own.rgb;
    float share = 1.0;
    if (uncertainty >= 0.0) {
        vec4 window = window_gather(g, pixel, 3);
        /* Of both, the mean square of the change and the variance, the relative variance is 2 / sum of weights. */
        float noise = window.x * (1.0 + 2.0 * sqrt(4.0 / window.a + uncertainty));
        float alone = luminance(change) * luminance(change);
        float most = 9.0 * max(own.a - filtered.a, 0.0) * (1.0 + sqrt(uncertainty));
        share = min(window.y > noise ? noise / window.y : 1.0, alone > most ? most / alone : 1.0);
    }
    change_out.rgb = share * change * texelFetch(factor_texture, pixel, 0).rgb;
}
