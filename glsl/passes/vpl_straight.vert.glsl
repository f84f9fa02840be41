/* Draws surfaces with their materials into one octant of a VPL's map. */
#include "lib/hemisphere_clip.glsl"
#include "lib/material_vertex.glsl"

layout(location = 0) uniform uint octant;

void main()
{
    vec3 p = instance_position(position);
    hemisphere_vertex(octant, p);
    material_vertex(p - light.map_origin.xyz);
}
