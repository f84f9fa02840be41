/* The running mean of one layer: mean += (x - mean) / n, which does not drift however large n grows. */
#include "lib/gbuffer.glsl"
#include "lib/view.glsl"

#define SOURCE_COLOR 0
#define SOURCE_ALBEDO 1
#define SOURCE_NORMAL 2
#define SOURCE_DEPTH 3

#if LSF_SOURCE == SOURCE_ALBEDO || LSF_SOURCE == SOURCE_NORMAL
layout(binding = 0) uniform usampler2D source;
layout(binding = 1) uniform sampler2D depth_texture;
#else
layout(binding = 0) uniform sampler2D source;
#endif
layout(binding = 0, rgba32f) uniform image2D mean_image;
layout(location = 0) uniform float weight; /* 1 / n */

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 x;
#if LSF_SOURCE == SOURCE_COLOR
    x = texelFetch(source, pixel, 0);
#elif LSF_SOURCE == SOURCE_DEPTH
    /* A mean of distances across an edge is the distance to no surface; the first iteration's value is kept. */
    if (weight != 1.0)
        return;
    float depth = texelFetch(source, pixel, 0).r;
    x = vec4(depth == 0.0 ? uintBitsToFloat(0x7f800000u) : view_depth(depth) * view.depth.z);
    imageStore(mean_image, pixel, x);
    return;
#else
    x = vec4(0.0);
    if (texelFetch(depth_texture, pixel, 0).r != 0.0) {
        surface s = surface_unpack(texelFetch(source, pixel, 0));
        x.rgb = LSF_SOURCE == SOURCE_ALBEDO ? s.base_color : s.normal;
#if LSF_SCATTER && LSF_SOURCE == SOURCE_NORMAL
        /* The normal of a wall that is looked through faces the other side. */
        if (dot(s.geometric_normal, view_ray_direction(sample_ndc(gl_FragCoord.xy))) > 0.0)
            x.rgb = -x.rgb;
#endif
    }
#endif
    vec4 mean = weight == 1.0 ? vec4(0.0) : imageLoad(mean_image, pixel);
    imageStore(mean_image, pixel, mean + (x - mean) * weight);
}
