/* How far two pixels see one surface, by means of normal and depth; src/passes/light_filter.md has the weights.
 * Needs lib/view.glsl. Switch LSF_LOBE: the light is that of a specular lobe. */
#ifndef LSF_LIB_LIGHT_GUIDE
#define LSF_LIB_LIGHT_GUIDE

#include "lib/luminance.glsl"
#include "lib/pooling.glsl"
#include "shared/brdf.h"

layout(binding = 0) uniform sampler2D guide_texture; /* mean normal, mean reverse-Z depth */
layout(binding = 1) uniform sampler2D slope_texture; /* of that depth, for each pixel along x and y */
#if LSF_LOBE
layout(binding = 3) uniform sampler2D factor_texture; /* A: mean roughness */
#endif
#if LSF_LOBE
layout(location = 3) uniform float lobe_kernel; /* [sr] */
#endif
layout(location = 0) uniform vec2 guide_weights; /* light_filter.depth_weight, .normal_weight */

struct light_guide {
    vec3 normal; /* unit */
    float depth; /* 0: nothing is seen */
    vec2 slope;
    float spread; /* of depth within the pixel, beyond that of its plane */
    float alike;  /* 1 where all normals within the pixel are the same, less the more they differ */
    float scale;  /* from differences of depth to distances from the surface's plane [pixels] */
#if LSF_LOBE
    vec3 position, view;
    float alpha;
#endif
};

/* A length of 0 stays one. */
vec3 unit_or_zero(vec3 v)
{
    return v * inversesqrt(max(dot(v, v), 1e-20));
}

#if LSF_LOBE
/* Below it squares of roughness and of angles are as good as 0. */
#define LSF_TINY 1e-20

vec2 center_ndc(ivec2 pixel)
{
    return (vec2(pixel) + 0.5) * (2.0 * view.size.zw) - 1.0;
}

/* Of the lobe as it was sampled: glossy ones are spread over `lobe_kernel` (lib/brdf.glsl, kernel_alpha). */
float alpha_at(ivec2 pixel)
{
    vec4 factor = texelFetch(factor_texture, pixel, 0);
    float reflects = max(factor.r, max(factor.g, factor.b)), kernel = lobe_kernel;
#if LSF_PATTERN > 1
    float turn = float(LSF_PATTERN) * texelFetch(slope_texture, pixel, 0).a;
    kernel *= pooling_spread(kernel, reflects, pow(factor.a, 4.0), turn, float(LSF_PATTERN));
#endif
    return max(factor.a * factor.a, min(sqrt(kernel * reflects / (4.0 * LSF_PI)), 1.0));
}

/* The pixel's lobe where the neighbour's has its peak, as a part of its own peak, and how alike both are. */
float lobe_weight(light_guide g, ivec2 neighbour, vec4 texel)
{
    vec2 ndc = center_ndc(neighbour);
    vec3 ray = normalize(view_ray_direction(ndc));
    vec3 mirrored = reflect(ray, unit_or_zero(texel.xyz));
    vec3 apart = position_from_depth(ndc, texel.w) - g.position;
    /* Along the normal of the facets that would mirror it to the pixel. */
    vec3 h = g.view + mirrored + apart;
    float nh = dot(g.normal, h), alpha = alpha_at(neighbour);
    vec3 across = h - nh * g.normal;
    float a2 = g.alpha * g.alpha, b2 = alpha * alpha;
    float peak = a2 * nh * nh / max(a2 * nh * nh + dot(across, across), LSF_TINY);
    return nh > 0.0 ? peak * peak * 2.0 * g.alpha * alpha / max(a2 + b2, LSF_TINY) : 0.0;
}
#endif

/* Reverse-Z depth is affine in the inverse of the distance, so that planes are affine over the picture. */
light_guide light_guide_at(ivec2 pixel)
{
    light_guide g;
    vec4 texel = texelFetch(guide_texture, pixel, 0);
    g.normal = unit_or_zero(texel.xyz);
    g.depth = texel.w;
    vec3 slope = texelFetch(slope_texture, pixel, 0).xyz;
    g.slope = slope.xy;
    g.alike = min(dot(texel.xyz, texel.xyz), 1.0);
    g.alike *= g.alike * g.alike * g.alike;
    /* By how many pixels' widths a surface moves away from the viewer for each unit of depth. */
#if LSF_ORTHOGRAPHIC
    float widths = 1.0 / (abs(view.depth.x) * 2.0 * length(view.start_dx.xyz) * view.size.z);
#else
    float widths = 1.0 / (max(abs(g.depth - view.depth.x), 1e-20) * 2.0 * length(view.forward_dx.xyz) * view.size.z);
#endif
    /* ... and from its own plane, which is that much less steep. */
    g.scale = widths * inversesqrt(1.0 + dot(g.slope, g.slope) * widths * widths);
    /* Over a plane depth is uniform along each axis: its variance is that of a box. */
    g.spread = sqrt(max(slope.z * slope.z - dot(g.slope, g.slope) / 12.0, 0.0));
#if LSF_LOBE
    vec2 ndc = center_ndc(pixel);
    g.view = -normalize(view_ray_direction(ndc));
    g.position = position_from_depth(ndc, g.depth);
    g.alpha = alpha_at(pixel);
#endif
    return g;
}

/* 1 where the neighbour lies on the pixel's plane and looks the same way. */
float light_guide_weight(light_guide g, ivec2 pixel, ivec2 neighbour)
{
    vec4 texel = texelFetch(guide_texture, neighbour, 0);
    float cosine = dot(g.normal, unit_or_zero(texel.xyz));
    if (texel.w == 0.0 || cosine <= 0.0)
        return 0.0;
    vec2 apart = vec2(neighbour - pixel);
    float off = max(abs(texel.w - g.depth - dot(g.slope, apart)) - 2.0 * g.spread, 0.0) * g.scale /
                (guide_weights.x * length(apart));
    float weight = exp2(-off * off) * pow(cosine, guide_weights.y * g.alike);
#if LSF_LOBE
    weight *= lobe_weight(g, neighbour, texel);
#endif
    return weight;
}

#endif
