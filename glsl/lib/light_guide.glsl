/* Weights that say how far two pixels show one surface, from means of normal and depth; src/passes/light_filter.md
 * derives them. Needs lib/view.glsl. Switch LSF_LOBE: there is light of a specular lobe. */
#ifndef LSF_LIB_LIGHT_GUIDE
#define LSF_LIB_LIGHT_GUIDE

#include "lib/luminance.glsl"
#include "lib/octahedral.glsl"

/* Outputs of the pass light_guide. */
layout(binding = 0) uniform sampler2D guide_texture; /* octahedral normal, mean reverse-Z depth, alpha of the lobe */
layout(binding = 1) uniform sampler2D slope_texture; /* slope of that depth per pixel along x and y; `spread`;
                                                      * `alike` */
layout(binding = 15) uniform sampler2D curvature_texture; /* rotation of the normal per pixel along x and y [radians] */
layout(location = 0) uniform vec2 guide_weights;     /* light_filter.depth_weight, .normal_weight */

struct light_guide {
    vec3 normal; /* unit */
    float depth; /* 0: nothing is seen */
    vec2 slope, curvature;
    float spread; /* deviation of depth within the pixel, beyond that of its plane */
    float alike;  /* 1 where all normals within the pixel are equal, less the more they differ */
    float scale;  /* factor from differences of depth to distances from the surface's plane [pixels] */
#if LSF_LOBE
    vec3 position, view;
    float alpha;
#endif
};

#if LSF_LOBE
/* Squares of roughness and of angles below this count as 0. */
#define LSF_TINY 1e-20

vec2 center_ndc(ivec2 pixel)
{
    return (vec2(pixel) + 0.5) * (2.0 * view.jitter.z * view.size.zw) - 1.0;
}

/* The pixel's lobe at the peak of the neighbour's lobe, relative to its own peak, times the similarity of both
 * lobes. */
float lobe_weight(light_guide g, ivec2 neighbour, vec3 normal, float depth, float alpha)
{
    vec2 ndc = center_ndc(neighbour);
    vec3 ray = normalize(view_ray_direction(ndc));
    vec3 mirrored = reflect(ray, normal);
    vec3 apart = position_from_depth(ndc, depth) - g.position;
    /* The normal of the microfacets that would mirror the neighbour's peak direction to the pixel. */
    vec3 h = g.view + mirrored + apart;
    float nh = dot(g.normal, h);
    vec3 across = h - nh * g.normal;
    float a2 = g.alpha * g.alpha, b2 = alpha * alpha;
    float peak = a2 * nh * nh / max(a2 * nh * nh + dot(across, across), LSF_TINY);
    return nh > 0.0 ? peak * peak * 2.0 * g.alpha * alpha / max(a2 + b2, LSF_TINY) : 0.0;
}
#endif

/* Reverse-Z depth is affine in the inverse distance, so that a plane's depth is affine over the picture. */
light_guide light_guide_at(ivec2 pixel)
{
    light_guide g;
    vec4 texel = texelFetch(guide_texture, pixel, 0), slope = texelFetch(slope_texture, pixel, 0);
    g.normal = octahedral_normal(texel.xy);
    g.depth = texel.z;
    g.slope = slope.xy;
    g.curvature = texelFetch(curvature_texture, pixel, 0).xy;
    g.spread = slope.z;
    g.alike = slope.w;
    /* Widths of a pixel by which a surface recedes from the viewer for each unit of depth. */
#if LSF_ORTHOGRAPHIC
    float widths = 1.0 / (abs(view.depth.x) * 2.0 * length(view.start_dx.xyz) * view.jitter.z * view.size.z);
#else
    float widths = 1.0 / (max(abs(g.depth - view.depth.x), 1e-20) * 2.0 * length(view.forward_dx.xyz) * view.jitter.z * view.size.z);
#endif
    /* The same for the distance from the surface's own plane, which is smaller by the plane's slope. */
    g.scale = widths * inversesqrt(1.0 + dot(g.slope, g.slope) * widths * widths);
#if LSF_LOBE
    vec2 ndc = center_ndc(pixel);
    g.view = -normalize(view_ray_direction(ndc));
    g.position = position_from_depth(ndc, g.depth);
    g.alpha = texel.w;
#endif
    return g;
}

/* Distance [pixels] over which a curved surface counts as one; the sampling patterns are no wider. */
#define LSF_CURVED_REACH 4.0

/* 1 where the neighbour, whose guide is given, lies on the pixel's surface and has the normal that this surface
 * would have there, continued with its curvature at the pixel. */
float plane_weight(light_guide g, ivec2 pixel, ivec2 neighbour, vec4 texel, vec3 normal)
{
    float cosine = dot(g.normal, normal);
    vec2 apart = vec2(neighbour - pixel);
    float distance = length(apart);
    float curvature = dot(abs(apart), g.curvature) * min(LSF_CURVED_REACH / distance, 1.0);
    float off = max(abs(texel.z - g.depth - dot(g.slope, apart)) - 2.0 * g.spread, 0.0) * g.scale / distance;
    /* A chord deviates from the tangent plane by half the angle between the normals at its ends. */
    off = max(off - 0.5 * curvature, 0.0) / guide_weights.x;
    float angle = max(sqrt(max(2.0 - 2.0 * cosine, 0.0)) - curvature, 0.0);
    /* Powers of cosines of small angles: cos^p = e^(-p angle^2 / 2). */
    float weight = exp2(-off * off - guide_weights.y * g.alike * 0.7213475 * angle * angle);
    return texel.z == 0.0 || cosine <= 0.0 ? 0.0 : weight;
}

/* Weights for irradiance and for specular light. */
vec2 light_guide_weights(light_guide g, ivec2 pixel, ivec2 neighbour)
{
    vec4 texel = texelFetch(guide_texture, neighbour, 0);
    vec3 normal = octahedral_normal(texel.xy);
    float weight = plane_weight(g, pixel, neighbour, texel, normal);
#if LSF_LOBE
    return weight * vec2(1.0, lobe_weight(g, neighbour, normal, texel.z, texel.w));
#else
    return vec2(weight, 0.0);
#endif
}

#endif
