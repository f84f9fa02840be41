/* Draws the surfaces that may be cut out, or all surfaces where no triangles are listed, into a map of the
 * environment. */
#include "lib/instance.glsl"
#include "lib/mask_vertex.glsl"
#include "lib/sky_map.glsl"

layout(location = 0) uniform int map;
layout(location = LSF_ATTRIBUTE_POSITION) in vec3 position;

out float map_depth;

void main()
{
    vec3 projected = sky_map_project(map, instance_position(position));
    gl_Position = sky_map_clip(map, projected);
    map_depth = projected.z;
    mask_vertex();
}
