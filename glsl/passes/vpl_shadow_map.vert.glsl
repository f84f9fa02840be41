/* One octant of a VPL's hemisphere; see lib/hemisphere.glsl. */
#include "lib/hemisphere.glsl"
#include "lib/instance.glsl"
#include "lib/mask_vertex.glsl"

layout(location = 0) uniform int octant_index;
layout(location = LSF_ATTRIBUTE_POSITION) in vec3 position;

out float gl_ClipDistance[2];

void main()
{
    vec2 octant = vec2((octant_index & 1) == 0 ? 1.0 : -1.0, (octant_index & 2) == 0 ? 1.0 : -1.0);
    vec3 local = hemisphere_local(instance_position(position) - light.map_origin.xyz);
    vec3 q = hemisphere_project(octant, local);
    gl_Position = vec4(q.xy, light.map_shape.x, q.z);
    float shift = 2.0 * HEMISPHERE_SHIFT * light.map_shape.w * q.z;
    gl_ClipDistance[0] = octant.x * (local.x + shift);
    gl_ClipDistance[1] = octant.y * (local.y + shift);
    mask_vertex();
}
