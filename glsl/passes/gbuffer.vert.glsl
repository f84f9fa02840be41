#include "lib/material_vertex.glsl"
#include "lib/view.glsl"

#if LSF_MOTION
layout(location = LSF_ATTRIBUTE_PREVIOUS_TRANSFORM) in vec4 previous_rows[3];
#ifdef LSF_DEFORMED_MOTION
layout(location = LSF_ATTRIBUTE_PREVIOUS_POSITION) in vec3 previous_position;
#else
#define previous_position position
#endif
out vec4 vertex_clip, vertex_previous_clip;
#ifdef LSF_HISTORY
flat out float vertex_instance;
#endif
#endif

/* Every pass that draws the scene must compute the same bits. */
invariant gl_Position;

void main()
{
    vec3 p = instance_position(position) - view.start.xyz;
    gl_Position = view.clip * vec4(p, 1.0);
    material_vertex(p);
#if LSF_MOTION
    vec4 object = vec4(previous_position, 1.0);
    vec3 previous = vec3(dot(previous_rows[0], object), dot(previous_rows[1], object),
                         dot(previous_rows[2], object));
    vertex_clip = gl_Position;
    vertex_previous_clip = view.previous_clip * vec4(previous - view.previous_start.xyz, 1.0);
#ifdef LSF_HISTORY
    vertex_instance = float(instance_number()) + 1.0;
#endif
#endif
}
