/* Covers the region and passes on the bundle_frame of its corners, so that fragments need no matrix. */
#include "passes/ray_bundle_frame.glsl"

layout(location = 1) uniform vec2 region_size;

noperspective out vec3 frame_start, frame_along;
flat out vec3 frame_forward;
flat out vec4 frame_scale;

void main()
{
    vec2 uv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
    bundle_frame frame = frame_at(vec2(region.xy) + uv * region_size);
    frame_start = frame.start;
    frame_along = frame.along;
    frame_forward = frame.forward;
    frame_scale = frame.scale;
}
