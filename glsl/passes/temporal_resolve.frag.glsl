/* Blends the picture with those of the previous frames, so that edges, textures and shadows have the samples of
 * all of them. Where neighbours move apart or lighting has changed, the history is clamped to the pixel's current
 * neighbourhood. */
layout(binding = 0) uniform sampler2D picture_texture;
layout(binding = 1) uniform sampler2D carried_texture; /* A: samples; below 0: to be clamped */
layout(location = 1) uniform float iterations;
layout(location = 2) uniform float limit; /* samples of the history per sample of the frame */
layout(location = 0) out vec4 picture_out; /* A: samples */

bool finite(vec3 v)
{
    return !any(isnan(v)) && !any(isinf(v));
}

/* Clamps to within a standard deviation of the neighbours' mean (Salvi 2016, "An Excursion in Temporal
 * Supersampling"). */
vec3 held(ivec2 pixel, vec3 before)
{
    ivec2 size = textureSize(picture_texture, 0);
    vec3 own = texelFetch(picture_texture, pixel, 0).rgb, first = vec3(0.0), second = vec3(0.0);
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            vec3 d = texelFetch(picture_texture, clamp(pixel + ivec2(i, j), ivec2(0), size - 1), 0).rgb - own;
            first += d / 9.0;
            second += d * d / 9.0;
        }
    vec3 deviation = sqrt(max(second - first * first, 0.0));
    return clamp(before, own + first - deviation, own + first + deviation);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 own = texelFetch(picture_texture, pixel, 0).rgb;
    vec4 carried = texelFetch(carried_texture, pixel, 0);
    float before = min(abs(carried.a), limit * iterations);
    picture_out = vec4(own, iterations);
    if (!finite(own))
        picture_out.a = 0.0;
    if (before == 0.0 || !finite(own))
        return;
    vec3 past = carried.a < 0.0 ? held(pixel, carried.rgb) : carried.rgb;
    if (finite(past))
        picture_out = vec4(own + (past - own) * (before / (before + iterations)), before + iterations);
}
