/* Vertex outputs for lib/mask.glsl. Switches as there. */
#ifndef LSF_LIB_MASK_VERTEX
#define LSF_LIB_MASK_VERTEX

#include "lib/instance.glsl"

#if LSF_MASK
flat out uint vertex_material;
#if LSF_TEXTURED
layout(location = LSF_ATTRIBUTE_UV0) in vec2 uv0;
out vec2 vertex_uv0;
#endif
#if LSF_SECOND_UV
layout(location = LSF_ATTRIBUTE_UV1) in vec2 uv1;
out vec2 vertex_uv1;
#endif
#if LSF_VERTEX_COLOR
layout(location = LSF_ATTRIBUTE_COLOR) in vec4 color;
out float vertex_alpha;
#endif
#if LSF_BLEND
flat out uvec2 vertex_layer; /* instance, vertex */
#endif
#endif

void mask_vertex()
{
#if LSF_MASK
    vertex_material = instance_material();
#if LSF_TEXTURED
    vertex_uv0 = uv0;
#endif
#if LSF_SECOND_UV
    vertex_uv1 = uv1;
#endif
#if LSF_VERTEX_COLOR
    vertex_alpha = color.a;
#endif
#if LSF_BLEND
    vertex_layer = uvec2(instance_number(), gl_VertexID);
#endif
#endif
}

#endif
