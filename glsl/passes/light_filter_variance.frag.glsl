/* Blends the variance with the average over neighbours on the same surface, more so the fewer iterations there
 * are; after one iteration, it is the variance among them. */
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
    /* Variances of light differ by factors, so that their logarithms are mixed; but where one pixel has found a
     * rare light, most of the mean is its own, and what chance does not explain is all its own. */
    float mixed = own > variance ? max(mix(variance, own, share), own - sqrt(uncertainty) * variance)
                                 : variance * pow(max(own / max(variance, 1e-37), 1e-3), share);
    return pow(even, share) * mixed;
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
    for (int part = 0; part <= LSF_LOBE; part++)
        if (light_out[part].a >= 0.0)
            light_out[part].a = variance_of(light_out[part].a, windows[part]);
}
