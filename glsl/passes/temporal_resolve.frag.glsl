/* Blends the picture with those of the previous frames, so that edges, textures and shadows have the samples of
 * all of them, as far as the frame's own noise explains its difference from the history. Where neighbours move apart
 * or lighting has changed, the history is clamped to the pixel's current neighbourhood. Switch LSF_PIXEL_SIDE. */
#include "lib/luminance.glsl"
#include "lib/pixel_side.glsl"
#include "passes/temporal_weight.glsl"

layout(binding = 0) uniform sampler2D picture_texture; /* A: variance of its luminance by light */
layout(binding = 1) uniform sampler2D carried_texture; /* A: samples; below 0: to be clamped */
layout(location = 1) uniform float iterations;
layout(location = 2) uniform float limit; /* samples of the history per sample of the frame */
layout(location = 0) out vec4 picture_out; /* A: samples */

bool finite(vec3 v)
{
    return !any(isnan(v)) && !any(isinf(v));
}

/* The 3 x 3 pixels around one. */
struct neighbourhood {
    vec3 mean, deviation; /* of the frame's picture */
    float off;            /* mean square difference of luminance between the picture and its history */
};

neighbourhood neighbourhood_of(ivec2 pixel, vec3 own)
{
    ivec2 size = textureSize(picture_texture, 0);
    vec3 first = vec3(0.0), second = vec3(0.0);
    vec2 off = vec2(0.0); /* sum of squares, number */
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            ivec2 at = clamp(pixel + ivec2(i, j), ivec2(0), size - 1);
            vec3 value = texelFetch(picture_texture, at, 0).rgb, d = value - own;
            vec4 past = texelFetch(carried_texture, at, 0);
            first += d / 9.0;
            second += d * d / 9.0;
            float change = luminance(past.rgb) - luminance(value);
            if (past.a != 0.0 && !isnan(change) && !isinf(change))
                off += vec2(change * change, 1.0);
        }
    return neighbourhood(own + first, sqrt(max(second - first * first, 0.0)), off.y > 0.0 ? off.x / off.y : 0.0);
}

/* Largest number of samples that the history may count for. `light`: variance by noisy light. What a pixel shows
 * varies at most like its neighbourhood, and an edge crosses about sqrt(m) of m strata of a pixel, so that the mean of
 * as many samples has m^-1.5 of the neighbourhood's variance (Mitchell 1996, "Consequences of Stratified Sampling in
 * Graphics"). What is beyond both is the history's own error: blur, and what has moved or reflects something else. */
float trusted(float samples, neighbourhood around, float light)
{
    float deviation = luminance(around.deviation), points = iterations * float(LSF_PIXEL_SIDE * LSF_PIXEL_SIDE);
    float noise = deviation * deviation * pow(points, -1.5) + max(light, 0.0);
    return history_weight(samples, iterations, around.off - noise * (1.0 + iterations / samples), noise);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 own_texel = texelFetch(picture_texture, pixel, 0);
    vec3 own = own_texel.rgb;
    vec4 carried = texelFetch(carried_texture, pixel, 0);
    float before = min(abs(carried.a), limit * iterations);
    picture_out = vec4(own, iterations);
    if (!finite(own))
        picture_out.a = 0.0;
    if (before == 0.0 || !finite(own))
        return;
    neighbourhood around = neighbourhood_of(pixel, own);
    vec3 past = carried.rgb;
    if (carried.a < 0.0) /* Salvi 2016, "An Excursion in Temporal Supersampling" */
        past = clamp(past, around.mean - around.deviation, around.mean + around.deviation);
    before = trusted(before, around, own_texel.a);
    if (finite(past))
        picture_out = vec4(own + (past - own) * (before / (before + iterations)), before + iterations);
}
