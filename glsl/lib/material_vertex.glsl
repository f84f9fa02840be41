/* Vertex outputs for lib/material.glsl. Switches as there. */
#ifndef LSF_LIB_MATERIAL_VERTEX
#define LSF_LIB_MATERIAL_VERTEX

#include "lib/alpha.glsl"
#include "lib/instance.glsl"
#include "lib/scene.glsl"

layout(location = LSF_ATTRIBUTE_POSITION) in vec3 position;
layout(location = LSF_ATTRIBUTE_NORMAL) in vec3 normal;

out vec3 vertex_position; /* normalised space, relative to the viewer's or the map's origin */
out vec3 vertex_normal;
/* The material, read once per vertex instead of once per fragment. */
flat out vec4 vertex_base_color;
flat out vec4 vertex_emission; /* w: alpha cutoff */
flat out vec4 vertex_surface;  /* metallic, roughness, normal scale, f0 */
flat out vec4 vertex_flags;    /* mirrored, double-sided, unlit */
#if LSF_TANGENT
layout(location = LSF_ATTRIBUTE_TANGENT) in vec4 tangent;
out vec4 vertex_tangent; /* w: the bitangent's sign */
#endif
#if LSF_TEXTURED
layout(location = LSF_ATTRIBUTE_UV0) in vec2 uv0;
out vec2 vertex_uv0;
#endif
#if LSF_TEXTURED || LSF_TRANSMISSION || LSF_LOBES
flat out uint vertex_material;
#endif
#if LSF_SECOND_UV
layout(location = LSF_ATTRIBUTE_UV1) in vec2 uv1;
out vec2 vertex_uv1;
#endif
#if LSF_VERTEX_COLOR
layout(location = LSF_ATTRIBUTE_COLOR) in vec4 color;
out vec4 vertex_color;
#endif
#if LSF_BASE_COLOR_TEXTURE
flat out vec4 vertex_base_color_row_0, vertex_base_color_row_1;
#endif
#if LSF_ANISOTROPY
flat out vec4 vertex_anisotropy;
#endif
#if LSF_LAYERS
flat out uvec2 vertex_layer; /* instance, vertex */
#endif

/* `p`: the vertex relative to the origin. */
void material_vertex(vec3 p)
{
    vertex_position = p;
    vertex_normal = instance_normal(normal);
    uint material = instance_material();
    vertex_base_color = materials[material].base_color;
    vertex_emission = materials[material].emission;
    vertex_surface = materials[material].surface;
    vertex_flags = vec4(instance_mirrored(), materials[material].flags.xy, 0.0);
#if LSF_TANGENT
    /* Mirroring reverses the cross product of mirrored vectors. */
    vertex_tangent = vec4(instance_direction(tangent.xyz),
                          instance_mirrored() ? -tangent.w : tangent.w);
#endif
#if LSF_TEXTURED
    vertex_uv0 = uv0;
#endif
#if LSF_TEXTURED || LSF_TRANSMISSION || LSF_LOBES
    vertex_material = material;
#endif
#if LSF_SECOND_UV
    vertex_uv1 = uv1;
#endif
#if LSF_VERTEX_COLOR
    vertex_color = color;
#endif
#if LSF_BASE_COLOR_TEXTURE
    vertex_base_color_row_0 = materials[material].base_color_slot.row_0;
    vertex_base_color_row_1 = materials[material].base_color_slot.row_1;
#endif
#if LSF_ANISOTROPY
    vertex_anisotropy = materials[material].anisotropy;
#endif
#if LSF_LAYERS
    vertex_layer = uvec2(instance_number(), gl_VertexID);
#endif
}

#endif
