/* Blends the light of a frame with the history reprojected to it, weighted by how well either knows the current
 * light; src/passes/temporal.md derives the weights. Switch LSF_LOBE: there is specular light. */
#include "lib/view.glsl"

#include "lib/light_clear.glsl"
#include "lib/light_guide.glsl"
#include "passes/temporal_weight.glsl"

layout(binding = 2) uniform sampler2D light_textures[1 + LSF_LOBE]; /* of lsf_light_mean_part */
layout(binding = 4) uniform sampler2D factor_textures[1 + LSF_LOBE];
layout(binding = 6) uniform sampler2D carried_textures[1 + LSF_LOBE]; /* A: sum of squared deviations */
layout(binding = 8) uniform sampler2D reach_texture;
layout(binding = 9) uniform sampler2D window_textures[1 + LSF_LOBE]; /* of temporal_window */
layout(location = 1) uniform float iterations;
layout(location = 2) uniform float limit;       /* samples of the history per sample of the frame */
layout(location = 4) uniform float independent; /* number of neighbours with independent noise, at most */
layout(location = 5) uniform bool changed;      /* lighting may have changed */
layout(location = 0) out vec4 history_out[1 + LSF_LOBE];
layout(location = 1 + LSF_LOBE) out vec4 light_out[1 + LSF_LOBE];
layout(location = 2 + 2 * LSF_LOBE) out float count_out[1 + LSF_LOBE];

/* Number of samples from which their own deviations estimate their variance; with fewer, neighbours do. */
#define ENOUGH 4.0

/* Samples of the history that saw the current light: a lobe that drifts by a fraction of its width each frame saw
 * other light in earlier frames. */
float within_lobe(vec4 reach, int part)
{
    if (part == 0)
        return reach.x;
    return reach.z > 0.0 ? iterations / reach.z : reach.y;
}

/* Statistics of a window of neighbours on the same surface. */
struct window {
    float noise;                /* variance of the frame's light: mean of that among iterations, or that of a single
                                 * one among 3 x 3 of them */
    float difference, variance; /* mean of the frame's light less the history, and the variance of that mean */
    float apart, count;         /* mean square of that difference; number of neighbours */
};

/* Sums of weights: of differences, and of noise. */
struct tally {
    float sum, first, second, noise, known;
};

void add(inout tally t, vec4 texel, float origin, float w)
{
    float d = texel.x - origin, known = texel.z >= 0.0 ? w : 0.0;
    w *= texel.w;
    t.sum += w;
    t.first += w * d;
    t.second += w * (texel.y + d * d);
    t.noise += known * texel.z;
    t.known += known;
}

window window_of(tally t, float origin)
{
    window around = window(t.known > 0.0 ? t.noise / t.known : 0.0, 0.0, 0.0, 0.0, t.sum);
    if (t.sum > 0.0) {
        float mean = t.first / t.sum;
        around.difference = origin + mean;
        around.apart = t.second / t.sum + origin * (origin + 2.0 * mean);
        around.variance = max(t.second / t.sum - mean * mean, 0.0) / clamp(t.sum, 1.0, independent);
    }
    return around;
}

void look_around(light_guide g, ivec2 pixel, out window windows[1 + LSF_LOBE])
{
    ivec2 size = textureSize(guide_texture, 0);
    vec4 own[1 + LSF_LOBE];
    tally tallies[1 + LSF_LOBE];
    for (int part = 0; part <= LSF_LOBE; part++) {
        own[part] = texelFetch(window_textures[part], pixel, 0);
        tallies[part] = tally(0.0, 0.0, 0.0, 0.0, 0.0);
        add(tallies[part], own[part], own[part].x, 1.0);
    }
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            if (i == 0 && j == 0)
                continue;
            ivec2 at = pixel + 3 * ivec2(i, j);
            bool inside = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, size));
            vec2 w = inside ? light_guide_weights(g, pixel, at) : vec2(0.0);
            for (int part = 0; part <= LSF_LOBE; part++)
                add(tallies[part], texelFetch(window_textures[part], at, 0), own[part].x, w[part]);
        }
    for (int part = 0; part <= LSF_LOBE; part++)
        windows[part] = window_of(tallies[part], own[part].x);
}

/* Largest number of samples that the history may count for: its mean square error is its variance plus the square
 * of its bias, which is that of blur in each pixel, and of changes among neighbours. A single iteration cannot tell
 * blur from noise. */
float trusted(float samples, window around)
{
    float trust = samples;
    if (iterations > 1.0) {
        float chance = 1.0 + 2.0 * sqrt((2.0 + 8.0 / (iterations - 1.0)) / clamp(around.count, 1.0, independent));
        float blur2 = around.apart - chance * around.noise * (1.0 + iterations / samples);
        trust = history_weight(samples, iterations, blur2, around.noise);
    }
    if (changed) {
        float change2 = around.difference * around.difference - around.variance;
        float noise = around.variance * samples / (samples + iterations); /* of the frame alone */
        trust = min(trust, history_weight(samples, iterations, change2, noise));
    }
    return trust;
}

void blend(ivec2 pixel, int part, window around)
{
    vec4 carried = texelFetch(carried_textures[part], pixel, 0), own;
    vec4 reach = texelFetch(reach_texture, pixel, 0);
    vec3 factor = texelFetch(factor_textures[part], pixel, 0).rgb;
    float samples = reach[part];
    float before = min(samples, min(within_lobe(reach, part), limit * iterations));
    if (!light_clear(light_out[part], factor, own)) {
        history_out[part] = vec4(carried.rgb, samples > 0.0 ? carried.a * before / samples : 0.0);
        count_out[part] = before;
        return;
    }
    if (before > 0.0)
        before = trusted(before, around);
    float total = before + iterations, share = before / total;
    vec3 change = share * (carried.rgb - own.rgb);
    float d = luminance(carried.rgb) - luminance(own.rgb);
    float deviations = own.a;
    if (before > 0.0)
        deviations += carried.a * before / samples + d * d * before * iterations / total;
    history_out[part] = vec4(own.rgb + mix(carried.rgb - own.rgb, change, greaterThan(factor, vec3(0.0))), deviations);
    count_out[part] = total;
    float variance = total > 1.0 ? deviations / (total * (total - 1.0)) : 0.0;
    if (iterations == 1.0 && total < ENOUGH)
        variance = max(variance, around.noise / total);
    /* The sum of squared deviations that a mean of as many iterations would have, at least 2. */
    float n = max(iterations, 2.0), tint = luminance(factor);
    light_out[part] = vec4(light_out[part].rgb + factor * change, variance * n * (n - 1.0) * tint * tint);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    light_guide g = light_guide_at(pixel);
    window windows[1 + LSF_LOBE];
    for (int part = 0; part <= LSF_LOBE; part++) {
        history_out[part] = vec4(0.0);
        count_out[part] = 0.0;
        light_out[part] = texelFetch(light_textures[part], pixel, 0);
    }
    if (g.depth == 0.0)
        return;
    look_around(g, pixel, windows);
    for (int part = 0; part <= LSF_LOBE; part++)
        blend(pixel, part, windows[part]);
}
