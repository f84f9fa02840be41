/* A frame's light blended with the history that was carried to it, by what either knows of the light as it is now;
 * src/passes/temporal.md has the weights. Switch LSF_LOBE: the light is that of a specular lobe. */
#include "lib/view.glsl"

#include "lib/light_guide.glsl"

layout(binding = 2) uniform sampler2D light_texture; /* of lsf_light_mean_part */
layout(binding = 3) uniform sampler2D factor_texture;
layout(binding = 4) uniform sampler2D carried_texture; /* light without tint; A: sum of squared deviations */
layout(binding = 5) uniform sampler2D reach_texture;
layout(location = 1) uniform float iterations;
layout(location = 2) uniform float limit;       /* samples of the history, for each of the frame's */
layout(location = 4) uniform float independent; /* neighbours whose noise differs, at most */
layout(location = 5) uniform bool changed;      /* light may be otherwise */
layout(location = 0) out vec4 history_out;
layout(location = 1) out float count_out;
layout(location = 2) out vec4 light_out;

#define REACH 3
/* From so many samples on their own deviations tell their variance; before, that among neighbours does. */
#define ENOUGH 4.0

bool finite(vec4 v)
{
    return !any(isnan(v)) && !any(isinf(v));
}

/* Light without tint, and in alpha the sum of squared deviations. False where there is none to divide by. */
bool clear_light(ivec2 at, out vec4 light)
{
    vec4 tinted = texelFetch(light_texture, at, 0);
    vec3 factor = texelFetch(factor_texture, at, 0).rgb;
    float tint = luminance(factor);
    light = vec4(0.0);
    if (!(tint > 0.0) || !finite(tinted))
        return false;
    /* A colour that is not reflected is as bright as the others. */
    float grey = luminance(tinted.rgb) / tint;
    light = vec4(factor.r > 0.0 ? tinted.r / factor.r : grey, factor.g > 0.0 ? tinted.g / factor.g : grey,
                 factor.b > 0.0 ? tinted.b / factor.b : grey, tinted.a / (tint * tint));
    return true;
}

float carried_samples(vec4 reach)
{
#if LSF_LOBE
    return reach.y;
#else
    return reach.x;
#endif
}

/* Of a lobe that drifts by a part of its width each frame, frames that are farther back saw other light. */
float within_lobe(vec4 reach)
{
#if LSF_LOBE
    return reach.z > 0.0 ? iterations / reach.z : reach.y;
#else
    return reach.x;
#endif
}

/* What a window of neighbours on the same surface tells. */
struct window {
    float scatter;              /* variance of the frame's light among them */
    float difference, variance; /* of the frame's light from the history, and of that mean */
};

window look_around(light_guide g, ivec2 pixel, float y)
{
    ivec2 size = textureSize(guide_texture, 0);
    float sum = 0.0, first = 0.0, second = 0.0;
    float pairs = 0.0, squares = 0.0, apart = 0.0, spread = 0.0;
    for (int j = -REACH; j <= REACH; j++)
        for (int i = -REACH; i <= REACH; i++) {
            ivec2 at = pixel + ivec2(i, j);
            vec4 light;
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size)) || !clear_light(at, light))
                continue;
            float w = at == pixel ? 1.0 : light_guide_weights(g, pixel, at)[LSF_LOBE];
            float d = luminance(light.rgb) - y;
            first += w * d;
            second += w * d * d;
            sum += w;
            if (w == 0.0 || carried_samples(texelFetch(reach_texture, at, 0)) <= 0.0)
                continue;
            d = luminance(light.rgb) - luminance(texelFetch(carried_texture, at, 0).rgb);
            apart += w * d;
            spread += w * d * d;
            pairs += w;
            squares += w * w;
        }
    window around = window(0.0, 0.0, 0.0);
    if (sum > 0.0)
        around.scatter = max(second / sum - first * first / (sum * sum), 0.0);
    if (pairs > 0.0) {
        around.difference = apart / pairs;
        float others = min(pairs * pairs / squares, independent);
        around.variance = max(spread / pairs - around.difference * around.difference, 0.0) / others;
    }
    return around;
}

/* Samples that the history may count for: its mean square error is its variance and the square of what it is off. */
float trusted(float samples, window around)
{
    float off = max(around.difference * around.difference - around.variance, 0.0);
    if (!changed || off == 0.0)
        return samples;
    float noise = around.variance * samples / (samples + iterations); /* of the frame alone */
    return noise > 0.0 ? 1.0 / (1.0 / samples + off / (iterations * noise)) : 0.0;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    history_out = vec4(0.0);
    count_out = 0.0;
    light_out = texelFetch(light_texture, pixel, 0);
    light_guide g = light_guide_at(pixel);
    if (g.depth == 0.0)
        return;
    vec4 own, carried = texelFetch(carried_texture, pixel, 0);
    vec4 reach = texelFetch(reach_texture, pixel, 0);
    float samples = carried_samples(reach);
    float before = min(samples, min(within_lobe(reach), limit * iterations));
    if (!clear_light(pixel, own)) {
        history_out = vec4(carried.rgb, samples > 0.0 ? carried.a * before / samples : 0.0);
        count_out = before;
        return;
    }
    window around = look_around(g, pixel, luminance(own.rgb));
    if (before > 0.0)
        before = trusted(before, around);
    float total = before + iterations, share = before / total;
    vec3 factor = texelFetch(factor_texture, pixel, 0).rgb;
    vec3 change = share * (carried.rgb - own.rgb);
    float d = luminance(carried.rgb) - luminance(own.rgb);
    float deviations = own.a;
    if (before > 0.0)
        deviations += carried.a * before / samples + d * d * before * iterations / total;
    history_out = vec4(own.rgb + mix(carried.rgb - own.rgb, change, greaterThan(factor, vec3(0.0))), deviations);
    count_out = total;
    float variance = total > 1.0 ? deviations / (total * (total - 1.0)) : 0.0;
    if (iterations == 1.0 && total < ENOUGH)
        variance = max(variance, around.scatter / total);
    /* As the mean of as many iterations, at least 2, would have it. */
    float n = max(iterations, 2.0), tint = luminance(factor);
    light_out = vec4(light_out.rgb + factor * change, variance * n * (n - 1.0) * tint * tint);
}
