/* The guides that lib/light_guide.glsl reads, from the means of normal and depth. */
#include "lib/luminance.glsl"
#include "lib/octahedral.glsl"
#include "lib/pooling.glsl"
#include "shared/brdf.h"

layout(binding = 0) uniform sampler2D mean_texture;   /* normal, reverse-Z depth */
layout(binding = 1) uniform sampler2D factor_texture; /* A: sum of squared deviations of depth */
#if LSF_LOBE
layout(binding = 2) uniform sampler2D specular_factor_texture; /* A: mean roughness */
layout(location = 1) uniform float lobe_kernel;                /* [sr] */
#endif
layout(location = 0) uniform float iterations;
layout(location = 0) out vec4 guide_out;
layout(location = 1) out vec4 slope_out;
layout(location = 2) out vec2 curvature_out;

/* Slope of depth: the smaller of the two one-sided differences, which is the surface's own slope next to an edge. */
float slope_along(ivec2 pixel, ivec2 along, float depth)
{
    ivec2 size = textureSize(mean_texture, 0);
    ivec2 after = min(pixel + along, size - 1), before = max(pixel - along, ivec2(0));
    float up = texelFetch(mean_texture, after, 0).w, down = texelFetch(mean_texture, before, 0).w;
    float forward = up - depth, backward = depth - down;
    if (after == pixel || up == 0.0)
        forward = before == pixel || down == 0.0 ? 0.0 : backward;
    if (before == pixel || down == 0.0)
        backward = forward;
    return abs(forward) < abs(backward) ? forward : backward;
}

/* A vector of length 0 stays 0. */
vec3 unit_or_zero(vec3 v)
{
    return v * inversesqrt(max(dot(v, v), 1e-20));
}

/* Angle between the normals of neighbouring pixels, the smaller of both sides [radians]. */
float curvature_along(ivec2 pixel, ivec2 along, vec3 normal)
{
    ivec2 last = textureSize(mean_texture, 0) - 1;
    vec3 after = unit_or_zero(texelFetch(mean_texture, min(pixel + along, last), 0).xyz);
    vec3 before = unit_or_zero(texelFetch(mean_texture, max(pixel - along, ivec2(0)), 0).xyz);
    return min(length(after - normal), length(before - normal));
}

#if LSF_LOBE
/* Alpha of the lobe as it was sampled: glossy lobes are spread over `lobe_kernel` (lib/brdf.glsl, kernel_alpha). */
float alpha_at(ivec2 pixel, float curvature)
{
    vec4 factor = texelFetch(specular_factor_texture, pixel, 0);
    float reflects = max(factor.r, max(factor.g, factor.b)), kernel = lobe_kernel;
#if LSF_PATTERN > 1
    float side = float(LSF_PATTERN);
    kernel *= pooling_spread(kernel, reflects, pow(factor.a, 4.0), side * curvature, side);
#endif
    return max(factor.a * factor.a, min(sqrt(kernel * reflects / (4.0 * LSF_PI)), 1.0));
}
#endif

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 mean = texelFetch(mean_texture, pixel, 0);
    guide_out = slope_out = vec4(0.0);
    curvature_out = vec2(0.0);
    if (mean.w == 0.0)
        return;
    vec3 normal = unit_or_zero(mean.xyz);
    /* Where the iterations' normals cancel in the mean, there is no direction. */
    guide_out.xy = dot(normal, normal) > 0.5 ? octahedral_position(normal) : vec2(0.0);
    guide_out.z = mean.w;
    curvature_out = vec2(curvature_along(pixel, ivec2(1, 0), normal), curvature_along(pixel, ivec2(0, 1), normal));
#if LSF_LOBE
    guide_out.w = alpha_at(pixel, 0.5 * (curvature_out.x + curvature_out.y));
#endif
    vec2 slope = vec2(slope_along(pixel, ivec2(1, 0), mean.w), slope_along(pixel, ivec2(0, 1), mean.w));
    float variance = max(texelFetch(factor_texture, pixel, 0).a, 0.0) / iterations;
    /* Over a plane, depth is uniform along each axis; its variance is that of a box. */
    float spread = sqrt(max(variance - dot(slope, slope) / 12.0, 0.0));
    float alike = min(dot(mean.xyz, mean.xyz), 1.0);
    alike *= alike;
    slope_out = vec4(slope, spread, alike * alike);
    /* Beside an edge within the pixel normals differ as much, but not because the surface is curved. */
    curvature_out *= slope_out.w;
}
