/* The slope of the mean depth along x and y: of two one-sided differences the smaller, so that it is the
 * surface's own beside an edge. */
layout(binding = 0) uniform sampler2D guide_texture;
layout(binding = 3) uniform sampler2D factor_texture; /* A: sum of squared deviations of depth */
layout(location = 1) uniform float iterations;
layout(location = 0) out vec4 slope_out; /* B: standard deviation of depth within the pixel; A: turn of the
                                         * normal to the next pixel [radians] */

float slope_along(ivec2 pixel, ivec2 along, float depth)
{
    ivec2 size = textureSize(guide_texture, 0);
    ivec2 after = min(pixel + along, size - 1), before = max(pixel - along, ivec2(0));
    float up = texelFetch(guide_texture, after, 0).w, down = texelFetch(guide_texture, before, 0).w;
    float forward = up - depth, backward = depth - down;
    if (after == pixel || up == 0.0)
        forward = before == pixel || down == 0.0 ? 0.0 : backward;
    if (before == pixel || down == 0.0)
        backward = forward;
    return abs(forward) < abs(backward) ? forward : backward;
}

vec3 unit(vec3 v)
{
    return v * inversesqrt(max(dot(v, v), 1e-20));
}

/* From a pixel to the next, of both sides the smaller. */
float normal_step(vec3 normal, ivec2 pixel, ivec2 along)
{
    ivec2 last = textureSize(guide_texture, 0) - 1;
    vec3 after = unit(texelFetch(guide_texture, min(pixel + along, last), 0).xyz);
    vec3 before = unit(texelFetch(guide_texture, max(pixel - along, ivec2(0)), 0).xyz);
    return min(length(after - normal), length(before - normal));
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(guide_texture, pixel, 0).w;
    slope_out = vec4(0.0);
    if (depth == 0.0)
        return;
    slope_out.xy = vec2(slope_along(pixel, ivec2(1, 0), depth), slope_along(pixel, ivec2(0, 1), depth));
    vec3 normal = unit(texelFetch(guide_texture, pixel, 0).xyz);
    slope_out.w = 0.5 * (normal_step(normal, pixel, ivec2(1, 0)) + normal_step(normal, pixel, ivec2(0, 1)));
    slope_out.z = sqrt(max(texelFetch(factor_texture, pixel, 0).a, 0.0) / iterations);
}
