/* Draws surfaces with their materials into a map of the environment. */
#include "lib/material_vertex.glsl"
#include "lib/sky_map.glsl"

layout(location = 0) uniform int map;

out float map_depth;

/* Surfaces that are drawn twice must get the same bits. */
invariant gl_Position;
invariant map_depth;

void main()
{
    vec3 p = instance_position(position);
    vec3 projected = sky_map_project(map, p);
    gl_Position = sky_map_clip(map, projected);
    map_depth = projected.z;
    material_vertex(p);
}
