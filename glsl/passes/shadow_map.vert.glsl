#include "lib/instance.glsl"
#include "lib/light_projection.glsl"
#include "lib/mask_vertex.glsl"

layout(location = 0) uniform int face;
layout(location = LSF_ATTRIBUTE_POSITION) in vec3 position;

void main()
{
    gl_Position = light_projection_clip(face, instance_position(position));
    mask_vertex();
}
