/* Draws the scene into one octant of a VPL's map. */
#include "lib/hemisphere_clip.glsl"
#include "lib/instance.glsl"
#include "lib/mask_vertex.glsl"

layout(location = 0) uniform uint octant;
layout(location = LSF_ATTRIBUTE_POSITION) in vec3 position;

void main()
{
    hemisphere_vertex(octant, instance_position(position));
    mask_vertex();
}
