/* Adds the filter's change to the picture, and sets the variance that is left. Only the part that noise explains is
 * taken: where light and filtered light differ by more, the difference is the filter's bias. */
#include "lib/view.glsl"

#include "lib/light_lone.glsl"
#include "lib/luminance.glsl"

layout(binding = 2) uniform sampler2D window_textures[1 + LSF_LOBE];
layout(binding = 4) uniform sampler2D light_textures[1 + LSF_LOBE]; /* A: variance, below 0: unknown */
layout(binding = 6) uniform sampler2D filtered_textures[1 + LSF_LOBE];
layout(binding = 8) uniform sampler2D factor_textures[1 + LSF_LOBE];
layout(location = 2) uniform float uncertainty; /* relative variance of the variance; below 0: no limit */
layout(location = 3) uniform bool pattern;      /* neighbours take different samples */
layout(binding = 10) uniform sampler2D lone_texture;
layout(location = 0) out vec4 change_out; /* A: variance of the picture's luminance that is left */
layout(location = 1) out vec4 lost_out; /* light taken out of lone pixels; A: whether the pixel stands apart */

vec4 window_value(ivec2 at, int part)
{
    return texelFetch(window_textures[part], at, 0);
}

#include "lib/light_window.glsl"

/* The part of the change that noise explains, by the pixel's own values, by those of the 9 x 9 neighbours, and by
 * the variance that goes from the 3 x 3 `beside` it. */
float explained(vec3 change, float gone, vec4 window, float beside)
{
    /* Both the mean square of the change and the variance have a relative variance of 2 / sum of weights. */
    float noise = window.x * (1.0 + 2.0 * sqrt(4.0 / window.a + uncertainty));
    /* Samples that have missed a rare light tell too little noise, but the neighbours' know it: those of the other
     * samples of a pattern; or all, by 1 / (n - 1)^2 after n iterations, as the pixel's own variance is hardly known
     * (the uncertainty is 8 / (n - 1)); or those beside a pixel that is a little darker than the filtered light. If m
     * samples of a pixel find the light on average, its mean's square is m times its variance, and e^-m of the pixels
     * miss it. */
    float alone = luminance(change) * luminance(change);
    bool missed = luminance(change) > 0.0 && alone <= 1.5 * beside;
    float share = pattern ? 1.0 : min(uncertainty * uncertainty / 64.0, 1.0);
    float known = max(gone, max(share * window.x, missed ? beside : 0.0));
    float most = 9.0 * known * (1.0 + sqrt(uncertainty));
    return min(window.y > noise ? noise / window.y : 1.0, alone > most ? most / alone : 1.0);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    light_guide g = light_guide_at(pixel);
    vec4 windows[1 + LSF_LOBE];
    change_out = lost_out = vec4(0.0);
    if (g.depth == 0.0)
        return;
    if (uncertainty >= 0.0)
        window_gather(g, pixel, 3, windows);
    for (int part = 0; part <= LSF_LOBE; part++) {
        vec4 own = texelFetch(light_textures[part], pixel, 0), filtered = texelFetch(filtered_textures[part], pixel, 0);
        if (own.a < 0.0)
            continue;
        vec3 change = filtered.rgb - own.rgb, factor = texelFetch(factor_textures[part], pixel, 0).rgb;
        float taken = 1.0, tint = luminance(factor);
        if (uncertainty >= 0.0)
            taken = explained(change, max(own.a - filtered.a, 0.0), windows[part], window_value(pixel, part).x);
        change *= taken * factor;
        change_out.a += mix(own.a, max(filtered.a, 0.0), taken) * tint * tint;
        change_out.rgb += change;
        float mark = texelFetch(lone_texture, pixel, 0)[part];
        if (lone_marked(mark, LONE))
            lost_out.rgb += max(-change, 0.0);
        if (lone_marked(mark, APART))
            lost_out.a = 1.0;
    }
}
