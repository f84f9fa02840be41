/* Statistics of a frame's light over 3 x 3 neighbours on one surface: the first of two steps; temporal_blend takes
 * the second, 3 pixels apart. Switch LSF_LOBE: there is specular light. */
#include "lib/view.glsl"

#include "lib/light_guide.glsl"
#include "passes/temporal_none.glsl"

layout(binding = 2) uniform sampler2D compared_texture;
layout(location = 1) uniform float iterations;
layout(location = 0) out vec4 window_out[1 + LSF_LOBE]; /* mean and variance of the difference from the history;
                                                         * variance of the light, below 0: unknown; weight of the
                                                         * first two, 0: unknown */

/* Weight, mean and variance of the known values. */
struct tally {
    float sum, first, second;
};

void add(inout tally t, float value, float origin, float w)
{
    float d = value - origin; /* small numbers, because squares of large ones lose all digits */
    if (value == NONE)
        return;
    t.sum += w;
    t.first += w * d;
    t.second += w * d * d;
}

float variance_of(tally t)
{
    float mean = t.first / t.sum;
    return max(t.second / t.sum - mean * mean, 0.0);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy), size = textureSize(guide_texture, 0);
    light_guide g = light_guide_at(pixel);
    for (int part = 0; part <= LSF_LOBE; part++)
        window_out[part] = vec4(0.0, 0.0, -1.0, 0.0);
    if (g.depth == 0.0)
        return;
    vec4 own = texelFetch(compared_texture, pixel, 0);
    vec4 origin = mix(own, vec4(0.0), equal(own, vec4(NONE)));
    tally light[1 + LSF_LOBE], apart[1 + LSF_LOBE];
    for (int part = 0; part <= LSF_LOBE; part++)
        light[part] = apart[part] = tally(0.0, 0.0, 0.0);
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            ivec2 at = pixel + ivec2(i, j);
            bool inside = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, size));
            vec4 value = i == 0 && j == 0 ? own : texelFetch(compared_texture, at, 0);
            vec2 w = i == 0 && j == 0 ? vec2(1.0) : light_guide_weights(g, pixel, at);
            for (int part = 0; part <= LSF_LOBE; part++) {
                add(light[part], value[2 * part], origin[2 * part], inside ? w[part] : 0.0);
                add(apart[part], value[2 * part + 1], origin[2 * part + 1], inside ? w[part] : 0.0);
            }
        }
    for (int part = 0; part <= LSF_LOBE; part++) {
        tally a = apart[part];
        if (a.sum > 0.0)
            window_out[part].xyw = vec3(origin[2 * part + 1] + a.first / a.sum, variance_of(a), a.sum);
        if (light[part].sum > 0.0)
            window_out[part].z = iterations > 1.0 ? origin[2 * part] + light[part].first / light[part].sum
                                                  : variance_of(light[part]);
    }
}
