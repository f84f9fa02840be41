/* Weighted means of two quantities over a window of 9 x 9 pixels that show one surface, gathered in two steps of 3
 * x 3 neighbours, 1 and 3 pixels apart, so that each pixel of the window counts once. Both for diffuse light and,
 * with switch LSF_LOBE, for specular light.
 *
 * The including shader defines vec4 window_value(ivec2 at, int part): X, Y the quantities of the pixel or their
 * means after the first step, A the weight, 0 where they are unknown. Part 1 is specular. */
#ifndef LSF_LIB_LIGHT_WINDOW
#define LSF_LIB_LIGHT_WINDOW

#include "lib/light_guide.glsl"

layout(location = 1) uniform bool window_moments; /* X is a mean and Y a variance, which are combined to those of
                                                   * the whole */

/* Adds a value to the weight and the weighted sums. */
void window_add(inout vec3 sums, vec4 own, vec4 value, float w)
{
    /* Squares are of differences, because squares of large values lose all digits. */
    float x = window_moments ? value.x - own.x : value.x;
    sums += w * value.a * vec3(1.0, x, window_moments ? value.y + x * x : value.y);
}

vec4 window_mean(vec3 sums, vec4 own)
{
    if (sums.x == 0.0)
        return vec4(0.0);
    vec2 mean = sums.yz / sums.x;
    if (window_moments)
        mean = vec2(own.x + mean.x, max(mean.y - mean.x * mean.x, 0.0));
    return vec4(mean, 0.0, sums.x);
}

/* As window_value, over the 3 x 3 neighbours `stride` pixels apart. */
void window_gather(light_guide g, ivec2 pixel, int stride, out vec4 means[1 + LSF_LOBE])
{
    ivec2 size = textureSize(guide_texture, 0);
    vec4 own[1 + LSF_LOBE];
    vec3 sums[1 + LSF_LOBE];
    for (int part = 0; part <= LSF_LOBE; part++) {
        own[part] = window_value(pixel, part);
        sums[part] = vec3(0.0);
        window_add(sums[part], own[part], own[part], 1.0);
    }
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            if (i == 0 && j == 0)
                continue;
            ivec2 at = pixel + stride * ivec2(i, j);
            bool inside = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, size));
            vec2 w = inside ? light_guide_weights(g, pixel, at) : vec2(0.0);
            for (int part = 0; part <= LSF_LOBE; part++)
                window_add(sums[part], own[part], window_value(at, part), w[part]);
        }
    for (int part = 0; part <= LSF_LOBE; part++)
        means[part] = window_mean(sums[part], own[part]);
}

/* The first of the two steps. */
void window_begin(ivec2 pixel, out vec4 means[1 + LSF_LOBE])
{
    light_guide g = light_guide_at(pixel);
    for (int part = 0; part <= LSF_LOBE; part++)
        means[part] = vec4(0.0);
    if (g.depth != 0.0)
        window_gather(g, pixel, 1, means);
}

#endif
