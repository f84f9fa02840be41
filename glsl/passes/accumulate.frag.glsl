/* The running mean of one layer: mean += (x - mean) / n, which does not drift however large n grows. Switch
 * LSF_PIXEL_SIDE: of the sample points of a pixel x is the mean. */
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

/* What is seen at one of the pixel's sample points. */
vec4 source_at(ivec2 point)
{
#if LSF_SOURCE == SOURCE_COLOR
    return texelFetch(source, point, 0);
#elif LSF_SOURCE == SOURCE_DEPTH
    float depth = texelFetch(source, point, 0).r;
    return vec4(depth == 0.0 ? uintBitsToFloat(0x7f800000u) : view_depth(depth) * view.depth.z);
#else
    if (texelFetch(depth_texture, point, 0).r == 0.0)
        return vec4(0.0);
    surface s = surface_unpack(texelFetch(source, point, 0));
    vec3 x = LSF_SOURCE == SOURCE_ALBEDO ? s.base_color : s.normal;
#if LSF_SCATTER && LSF_SOURCE == SOURCE_NORMAL
    /* The normal of a wall that is looked through faces the other side. */
    if (dot(s.geometric_normal, view_ray_direction(sample_ndc(vec2(point) + 0.5))) > 0.0)
        x = -x;
#endif
    return vec4(x, 0.0);
#endif
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#if LSF_SOURCE == SOURCE_DEPTH
    /* A mean of distances across an edge is the distance to no surface; the first iteration's value is kept. */
    if (weight == 1.0)
        imageStore(mean_image, pixel, source_at(pixel * LSF_PIXEL_SIDE + LSF_PIXEL_SIDE / 2));
#else
    vec4 x = source_at(pixel * LSF_PIXEL_SIDE);
    for (int i = 1; i < LSF_PIXEL_SIDE * LSF_PIXEL_SIDE; i++)
        x += source_at(pixel * LSF_PIXEL_SIDE + ivec2(i % LSF_PIXEL_SIDE, i / LSF_PIXEL_SIDE));
    x /= float(LSF_PIXEL_SIDE * LSF_PIXEL_SIDE);
    vec4 mean = weight == 1.0 ? vec4(0.0) : imageLoad(mean_image, pixel);
    imageStore(mean_image, pixel, mean + (x - mean) * weight);
#endif
}
