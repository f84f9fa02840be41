/* Weighted means of two quantities over a window of 9 x 9 pixels that see one surface, gathered in two steps of 3 x 3
 * neighbours, 1 and 3 pixels apart: all pixels of the window once. */
#ifndef LSF_LIB_LIGHT_WINDOW
#define LSF_LIB_LIGHT_WINDOW

#include "lib/light_guide.glsl"

layout(binding = 2) uniform sampler2D window_texture; /* X, Y: quantities; A: weight, 0: there are none */
layout(location = 1) uniform bool window_moments;     /* X is a mean and Y a variance: both are of the whole, then */

/* As window_texture, over the 3 x 3 neighbours `stride` pixels apart. */
vec4 window_gather(light_guide g, ivec2 pixel, int stride)
{
    ivec2 size = textureSize(guide_texture, 0);
    vec4 own = texelFetch(window_texture, pixel, 0);
    vec3 sums = vec3(0.0);
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            ivec2 at = pixel + stride * ivec2(i, j);
            bool inside = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, size));
            vec4 texel = texelFetch(window_texture, at, 0);
            float w = texel.a * (i == 0 && j == 0 ? 1.0 : light_guide_weight(g, pixel, at));
            w = inside ? w : 0.0;
            /* Squares of differences, for squares of what is large lose all digits. */
            float x = window_moments ? texel.x - own.x : texel.x;
            sums += w * vec3(1.0, x, window_moments ? texel.y + x * x : texel.y);
        }
    if (sums.x == 0.0)
        return vec4(0.0);
    vec2 mean = sums.yz / sums.x;
    if (window_moments)
        mean = vec2(own.x + mean.x, max(mean.y - mean.x * mean.x, 0.0));
    return vec4(mean, 0.0, sums.x);
}

#endif
