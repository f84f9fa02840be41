#include "lib/light_projection.glsl"
#include "lib/material_vertex.glsl"

layout(location = 0) uniform int face;

/* Surfaces that are drawn twice must get the same bits. */
invariant gl_Position;

void main()
{
    vec3 p = instance_position(position);
    gl_Position = light_projection_clip(face, p);
    material_vertex(p - light.map_origin.xyz);
}
