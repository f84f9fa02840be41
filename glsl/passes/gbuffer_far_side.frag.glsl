/* Depth, base colour and transmission of the nearest back of a medium that is parallel to the visible surface and
 * behind it, on the straight line of sight. */
#include "passes/gbuffer_fragment.glsl"

layout(binding = LSF_UNIT_SEEN_DEPTH) uniform sampler2D depth_texture;
layout(binding = LSF_UNIT_SEEN_SURFACE) uniform usampler2D surface_texture;

layout(location = 0) out vec4 color_out; /* alpha: transmission */

/* Least cosine between both sides of a wall. */
#define PARALLEL_LEAST 0.9

void main()
{
    vec3 to_viewer = fragment_to_viewer();
    surface s;
    vec3 emission;
    bool front;
    bool present = material_evaluate(to_viewer, s, emission, front);
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool behind = gl_FragCoord.z < texelFetch(depth_texture, pixel, 0).r;
    vec3 seen = surface_unpack(texelFetch(surface_texture, pixel, 0)).geometric_normal;
    if (!present || front || !s.volume || !behind || dot(s.geometric_normal, seen) < PARALLEL_LEAST)
        discard;
    color_out = vec4(s.base_color, s.transmission);
}
