/* The view's rays in a bundle's coordinates. They are affine over the picture: a visible point lies at start +
 * along * (view depth from the view's start). With LSF_BUNDLE_GAPS that holds before gaps are removed. */
#ifndef LSF_PASSES_RAY_BUNDLE_FRAME
#define LSF_PASSES_RAY_BUNDLE_FRAME

#include "lib/ray_bundle.glsl"
#include "lib/region.glsl"
#include "lib/view.glsl"

struct bundle_frame {
    vec3 start, along; /* texels, texels, steps of depth; with LSF_BUNDLE_GAPS in normalised space */
    vec3 forward;      /* the bundle's direction */
    vec4 scale;        /* x, y: depth steps across a texel for a slope of 1; z: steps per unit of length; w:
                        * squared steps within which a ray is still on the surface that it left */
};

#if LSF_BUNDLE_GAPS
vec3 along_axes(vec3 v)
{
    return vec3(dot(bundle.right.xyz, v), dot(bundle.up.xyz, v), dot(bundle.forward.xyz, v));
}

/* Texel coordinates and depth step of coordinates along the axes. */
vec3 map_position(vec3 q, float steps)
{
    q = bundle_close(bundle, q);
    return vec3(bundle_map_position(q), (q.z - bundle.range.x) * steps);
}
#else
/* A vector in normalised space in texels and depth steps. */
vec3 to_map(vec3 v)
{
    return bundle_coordinates(v) * vec3(0.5 * float(bundle.side) / bundle.window.zw,
                                        LSF_BUNDLE_DEPTH_STEPS / bundle.range.y);
}
#endif

/* The frame at a position in the region [fragment coordinates]. */
bundle_frame frame_at(vec2 fragment)
{
    vec2 ndc = sample_ndc(region_position(fragment));
    vec2 texel = bundle_texel_size();
    float steps = LSF_BUNDLE_DEPTH_STEPS / bundle.range.y;
    float self = LSF_BUNDLE_SELF_TEXELS * max(texel.x, texel.y) * steps + 0.5;
    bundle_frame frame;
#if LSF_BUNDLE_GAPS
    frame.start = along_axes(view_ray_start(ndc));
    frame.along = along_axes(view_ray_direction(ndc));
#else
    frame.start = to_map(view_ray_start(ndc)) -
                  vec3(bundle.window.xy - bundle.window.zw, bundle.range.x) *
                      vec3(0.5 * float(bundle.side) / bundle.window.zw, steps);
    frame.along = to_map(view_ray_direction(ndc));
#endif
    frame.forward = bundle.forward.xyz;
    frame.scale = vec4(texel * steps, steps, self * self);
    return frame;
}

#endif
