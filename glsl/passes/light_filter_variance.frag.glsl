/* Replaces the variance by what neighbours on the same surface have on the average; after one iteration, which
 * has none, by the variance among them. */
#include "lib/view.glsl"

#include "lib/light_guide.glsl"

layout(binding = 2) uniform sampler2D light_texture; /* A: variance */
layout(location = 1) uniform float iterations;
layout(location = 0) out vec4 light_out;

#define REACH 3

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy), size = textureSize(guide_texture, 0);
    vec4 own = texelFetch(light_texture, pixel, 0);
    light_guide g = light_guide_at(pixel);
    float y = luminance(own.rgb), sum = 1.0, variance = own.a, first = 0.0, second = 0.0;
    light_out = own;
    if (g.depth == 0.0)
        return;
    for (int j = -REACH; j <= REACH; j++)
        for (int i = -REACH; i <= REACH; i++) {
            ivec2 at = pixel + ivec2(i, j);
            if (at == pixel || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size)))
                continue;
            float w = light_guide_weight(g, pixel, at);
            vec4 light = texelFetch(light_texture, at, 0);
            float d = luminance(light.rgb) - y; /* small numbers, or their squares lose all digits */
            first += w * d;
            second += w * d * d;
            variance += w * light.a;
            sum += w;
        }
    light_out.a = iterations > 1.0 ? variance / sum : max(second / sum - first * first / (sum * sum), 0.0);
}
