/* Blends the variance with the average over neighbours on the same surface, more so the fewer iterations there
 * are; after one iteration, it is the variance among them, or how far the pixel's light is from that of the 8 pixels
 * around it. Marks lone pixels: few such neighbours, and light that a single sample brings. */
#include "lib/light_lone.glsl"
#include "lib/view.glsl"

layout(binding = 2) uniform sampler2D window_textures[1 + LSF_LOBE];
layout(binding = 4) uniform sampler2D light_textures[1 + LSF_LOBE]; /* A: variance, below 0: unknown */
layout(location = 2) uniform float uncertainty; /* relative variance of the pixel's own variance */
layout(location = 3) uniform bool halves;       /* the mean of the first part of the iterations is known */
layout(location = 0) out vec4 light_out[1 + LSF_LOBE];
layout(location = 1 + LSF_LOBE) out vec4 lone_out; /* of both parts: LONE, APART or 0 */

vec4 window_value(ivec2 at, int part)
{
    return texelFetch(window_textures[part], at, 0);
}

#include "lib/light_window.glsl"

float variance_of(float own, vec4 window)
{
    if (window_moments)
        return window.y;
    float variance = window.x, even = halves && variance > 0.0 ? min(window.y / variance, 1.0) : 1.0;
    float share = 1.0 / (1.0 + uncertainty);
    float others = max(window.a * variance - own, 0.0) / max(window.a - 1.0, 1.0);
    /* Variances of light differ by factors, so that their logarithms are mixed; but where one pixel has found a
     * rare light, most of the mean is its own, and what chance does not explain is all its own. */
    float mixed = own > variance ? max(mix(variance, own, share), own - sqrt(uncertainty) * others)
                                 : variance * pow(max(own / max(variance, 1e-37), 1e-3), share);
    return pow(even, share) * mixed;
}

/* What the 8 neighbours of a pixel say of a part of its light. */
struct neighbours {
    float alike;   /* sum of weights of the first step, 3 where all are on the pixel's surface and in its lobe */
    float surface; /* the same without the lobe */
    float count, difference; /* whatever they show: number; difference of luminance, summed */
    float similar; /* number of those that have half of the pixel's luminance or more */
};

void look_around(light_guide g, ivec2 pixel, out neighbours around[1 + LSF_LOBE])
{
    ivec2 size = textureSize(guide_texture, 0);
    for (int part = 0; part <= LSF_LOBE; part++)
        around[part] = neighbours(0.0, 0.0, 0.0, 0.0, 0.0);
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            ivec2 at = pixel + ivec2(i, j);
            if ((i == 0 && j == 0) || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size)))
                continue;
            vec2 w = light_guide_weights(g, pixel, at) * (i == 0 ? 1.0 : 0.5) * (j == 0 ? 1.0 : 0.5);
            for (int part = 0; part <= LSF_LOBE; part++) {
                vec4 light = texelFetch(light_textures[part], at, 0);
                if (light.a < 0.0)
                    continue;
                float theirs = luminance(light.rgb), own = luminance(light_out[part].rgb);
                around[part].alike += w[part];
                around[part].surface += w.x;
                around[part].count += 1.0;
                around[part].difference += theirs - own;
                around[part].similar += float(theirs > 0.5 * own);
            }
        }
}

/* Whether few neighbours are on the pixel's surface and in its lobe, and whether it is lone: these are darker, and less
 * than two samples bring its light. If m of n samples bring equal parts, the mean's square is m times its variance. A
 * mirror does not share its light. Where only the lobe is narrow, two neighbours that have found as much show that it
 * is the reflection of something bright. */
float lone_of(light_guide g, int part, vec4 light, neighbours around)
{
#if LSF_LOBE
    if (part == 1 && g.alpha == 0.0)
        return 0.0;
#endif
    float own = luminance(light.rgb);
    if (around.alike >= 1.5)
        return 0.0;
    bool reflection = around.surface >= 1.5 && around.similar >= 2.0;
    return !reflection && around.difference < 0.0 && own * own < 2.0 * light.a ? LONE : APART;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    light_guide g = light_guide_at(pixel);
    vec4 windows[1 + LSF_LOBE];
    neighbours around[1 + LSF_LOBE];
    lone_out = vec4(0.0);
    for (int part = 0; part <= LSF_LOBE; part++)
        light_out[part] = texelFetch(light_textures[part], pixel, 0);
    if (g.depth == 0.0)
        return;
    window_gather(g, pixel, 3, windows);
    look_around(g, pixel, around);
    for (int part = 0; part <= LSF_LOBE; part++) {
        if (light_out[part].a < 0.0)
            continue;
        float variance = variance_of(light_out[part].a, windows[part]);
        /* A pixel that alone shows a surface has no neighbours that could vary. */
        float apart = around[part].difference / max(around[part].count, 1.0);
        if (window_moments)
            variance = max(variance, apart * apart);
        light_out[part].a = variance;
        lone_out[part] = lone_of(g, part, light_out[part], around[part]);
    }
}
