/* The camera's uniform buffer and positions from depth. Needs LSF_ORTHOGRAPHIC. */
#ifndef LSF_LIB_VIEW
#define LSF_LIB_VIEW

#include "shared/scene_data.h"
#include "shared/view.h"

layout(std140, binding = LSF_BINDING_VIEW) uniform lsf_view_block
{
    lsf_view_data view;
};

/* ndc of the point in the pixel with centre `fragment` [pixels] that the iteration samples. */
vec2 sample_ndc(vec2 fragment)
{
    return fragment * (2.0 * view.size.zw) - 1.0 + view.jitter.xy;
}

vec3 view_ray_start(vec2 ndc)
{
    return view.start.xyz + ndc.x * view.start_dx.xyz + ndc.y * view.start_dy.xyz;
}

/* The ray's direction for which view depth grows by 1; not normalised. */
vec3 view_ray_direction(vec2 ndc)
{
    return view.forward.xyz + ndc.x * view.forward_dx.xyz + ndc.y * view.forward_dy.xyz;
}

/* View depth from the start [normalised units] of a reverse-Z depth; 0 is the background. */
float view_depth_from_start(float depth)
{
#if LSF_ORTHOGRAPHIC
    return (depth - view.depth.y) / view.depth.x;
#else
    return (view.depth.y - depth * view.depth.w) / (depth - view.depth.x);
#endif
}

/* View depth from the camera. */
float view_depth(float depth)
{
    return view.depth.w + view_depth_from_start(depth);
}

vec3 position_from_depth(vec2 ndc, float depth)
{
    return view_ray_start(ndc) + view_depth_from_start(depth) * view_ray_direction(ndc);
}

/* Largest distance of a position that position_from_depth has found from the plane of its surface, because vertices are
 * moved by LSF_RASTER_STEP. */
float view_raster_error(vec3 position, vec3 normal)
{
    float along = dot(position - view.start.xyz, view.forward.xyz);
    vec3 dx = view.start_dx.xyz + along * view.forward_dx.xyz, dy = view.start_dy.xyz + along * view.forward_dy.xyz;
    vec2 per_pixel = 2.0 * view.size.zw * abs(vec2(dot(normal, dx), dot(normal, dy)));
    return LSF_RASTER_STEP * (per_pixel.x + per_pixel.y);
}

#endif
