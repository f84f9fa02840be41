/* Brings the variance closer to what neighbours on the same surface have on the average, the fewer iterations tell
 * it; after one iteration, which tells none, it is the variance among them. */
#include "lib/view.glsl"

#include "lib/light_guide.glsl"

layout(binding = 2) uniform sampler2D light_texture; /* A: variance, below 0 where it tells nothing */
layout(location = 1) uniform float uncertainty; /* relative variance of the pixel's own; below 0: it has none */
layout(binding = 4) uniform sampler2D mean_texture; /* of lsf_light_mean_part */
layout(binding = 5) uniform sampler2D tint_texture; /* its factor */
layout(binding = 6) uniform sampler2D half_texture; /* luminance of the mean of the first m */
layout(location = 2) uniform float half_weight;     /* m / (n - m); below 0: there is no such mean */
layout(location = 0) out vec4 light_out;

#define REACH 3

/* The variance by how far the first half of the iterations is from all of them. */
float halves_of(ivec2 pixel)
{
    vec4 factor = texelFetch(tint_texture, pixel, 0);
    float tint = luminance(factor.rgb);
    float d = (texelFetch(half_texture, pixel, 0)[LSF_LOBE] - luminance(texelFetch(mean_texture, pixel, 0).rgb)) /
              max(tint, 1e-20);
    return d * d * half_weight;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy), size = textureSize(guide_texture, 0);
    vec4 own = texelFetch(light_texture, pixel, 0);
    light_guide g = light_guide_at(pixel);
    float y = luminance(own.rgb), sum = 1.0, first = 0.0, second = 0.0;
    float variance = own.a, halves = halves_of(pixel);
    light_out = own;
    if (g.depth == 0.0 || own.a < 0.0)
        return;
    for (int j = -REACH; j <= REACH; j++)
        for (int i = -REACH; i <= REACH; i++) {
            ivec2 at = pixel + ivec2(i, j);
            if (at == pixel || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size)))
                continue;
            vec4 light = texelFetch(light_texture, at, 0);
            if (light.a < 0.0)
                continue;
            float w = light_guide_weight(g, pixel, at);
            float d = luminance(light.rgb) - y; /* small numbers, or their squares lose all digits */
            first += w * d;
            second += w * d * d;
            sum += w;
            variance += w * light.a;
            halves += w * halves_of(at);
        }
    if (uncertainty < 0.0) {
        light_out.a = max(second / sum - first * first / (sum * sum), 0.0);
        return;
    }
    float even = half_weight >= 0.0 && variance > 0.0 ? min(halves / variance, 1.0) : 1.0;
    variance /= sum;
    /* Variances of light differ by factors: their logarithms are mixed. */
    float part = uncertainty / (1.0 + uncertainty);
    light_out.a = pow(even, 1.0 - part) * variance * pow(max(own.a / max(variance, 1e-37), 1e-3), 1.0 - part);
}
