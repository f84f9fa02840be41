/* Draws triangles that cover many texels, in normalised space, into a map of the environment. */
#include "lib/sky_map.glsl"

layout(location = 0) uniform int map;
layout(location = 0) in vec3 position;

out float map_depth;

void main()
{
    vec3 projected = sky_map_project(map, position);
    gl_Position = sky_map_clip(map, projected);
    map_depth = projected.z;
}
