/* Blends the variance with the average over neighbours on the same surface, more so the fewer iterations there
 * are; after one iteration, it is the variance among them, or how far the pixel's light is from theirs. */
#include "lib/view.glsl"

layout(binding = 2) uniform sampler2D window_textures[1 + LSF_LOBE];
layout(binding = 4) uniform sampler2D light_textures[1 + LSF_LOBE]; /* A: variance, below 0: unknown */
layout(location = 2) uniform float uncertainty; /* relative variance of the pixel's own variance */
layout(location = 3) uniform bool halves;       /* the mean of the first part of the iterations is known */
layout(location = 0) out vec4 light_out[1 + LSF_LOBE];

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

/* The square of the difference between a pixel's light and the mean of the light beside it, whatever is seen there. */
float apart_squared(ivec2 pixel, int part)
{
    ivec2 size = textureSize(guide_texture, 0);
    float own = luminance(texelFetch(light_textures[part], pixel, 0).rgb), sum = 0.0, count = 0.0;
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            ivec2 at = pixel + ivec2(i, j);
            if ((i == 0 && j == 0) || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size)))
                continue;
            vec4 light = texelFetch(light_textures[part], at, 0);
            sum += light.a >= 0.0 ? luminance(light.rgb) - own : 0.0; /* 0 to the bit where all are equal */
            count += light.a >= 0.0 ? 1.0 : 0.0;
        }
    return count > 0.0 ? sum * sum / (count * count) : 0.0;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    light_guide g = light_guide_at(pixel);
    vec4 windows[1 + LSF_LOBE];
    for (int part = 0; part <= LSF_LOBE; part++)
        light_out[part] = texelFetch(light_textures[part], pixel, 0);
    if (g.depth == 0.0)
        return;
    window_gather(g, pixel, 3, windows);
    for (int part = 0; part <= LSF_LOBE; part++) {
        if (light_out[part].a < 0.0)
            continue;
        light_out[part].a = variance_of(light_out[part].a, windows[part]);
        /* Where one pixel alone shows a surface, there are no neighbours to vary. */
        if (window_moments)
            light_out[part].a = max(light_out[part].a, apart_squared(pixel, part));
    }
}
