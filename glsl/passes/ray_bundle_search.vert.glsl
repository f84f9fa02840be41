/* The view's rays in the bundle's coordinates. They are affine over the picture, so that fragments
 * need no matrix: their place is start + view depth * along. Switches LSF_INTERLEAVE and those of
 * lib/ray_bundle.glsl. */
#define LSF_ORTHOGRAPHIC 0
#include "lib/ray_bundle.glsl"
#include "lib/region.glsl"
#include "lib/view.glsl"

layout(location = 1) uniform vec2 region_size;

out vec3 view_start, view_along;  /* texels, texels, steps of depth */
flat out vec3 bundle_forward;
flat out vec4 ray_scale; /* x, y: depth steps across a texel for a slope of 1; steps of a unit of length;
                          * square of the steps within which a ray is still on the surface it left */

/* A vector in normalised space as texels and depth steps. */
vec3 to_map(vec3 v)
{
    return bundle_coordinates(v) * vec3(0.5 * float(LSF_BUNDLE_SIDE) / bundle.window.zw,
                                        LSF_BUNDLE_DEPTH_STEPS / bundle.range.y);
}

void main()
{
    vec2 uv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
    vec2 ndc = sample_ndc(region_place(vec2(region.xy) + uv * region_size));
    vec3 corner = vec3(bundle.window.xy - bundle.window.zw, bundle.range.x);
    view_start = to_map(view_ray_origin(ndc)) -
                 corner * vec3(0.5 * float(LSF_BUNDLE_SIDE) / bundle.window.zw,
                               LSF_BUNDLE_DEPTH_STEPS / bundle.range.y);
    view_along = to_map(view_ray_direction(ndc));
    bundle_forward = bundle.forward.xyz;
    vec2 texel = bundle_texel_size();
    float steps = LSF_BUNDLE_DEPTH_STEPS / bundle.range.y;
    float self = LSF_BUNDLE_SELF_TEXELS * max(texel.x, texel.y) * steps + 0.5;
    ray_scale = vec4(texel * steps, steps, self * self);
}
