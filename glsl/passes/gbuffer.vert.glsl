#include "lib/instance.glsl"
#include "lib/scene.glsl"
#include "lib/view.glsl"

layout(location = LSF_ATTRIBUTE_POSITION) in vec3 position;
layout(location = LSF_ATTRIBUTE_NORMAL) in vec3 normal;

out vec3 vertex_position; /* normalised space, relative to the view's origin */
out vec3 vertex_normal;
/* The material, read here once a vertex and not once a fragment. */
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
#if LSF_MOTION
layout(location = LSF_ATTRIBUTE_PREVIOUS_TRANSFORM) in vec4 previous_rows[3];
out vec4 vertex_clip, vertex_previous_clip;
#endif

/* Every pass that draws the scene must reach the same bits. */
invariant gl_Position;

void main()
{
    vec3 p = instance_position(position);
    gl_Position = view.clip_from_position * vec4(p, 1.0);
    vertex_position = p - view.origin.xyz;
    vertex_normal = instance_normal(normal);
    uint material = instance_material();
    vertex_base_color = materials[material].base_color;
    vertex_emission = materials[material].emission;
    vertex_surface = materials[material].surface;
    vertex_flags = vec4(instance_mirrored(), materials[material].flags.xy, 0.0);
#if LSF_TANGENT
    /* A mirror turns the cross product of mirrored vectors the other way. */
    vertex_tangent = vec4(instance_direction(tangent.xyz),
                          instance_mirrored() ? -tangent.w : tangent.w);
#endif
#if LSF_TEXTURED
    vertex_uv0 = uv0;
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
#if LSF_MOTION
    vec4 object = vec4(position, 1.0);
    vec3 previous = vec3(dot(previous_rows[0], object), dot(previous_rows[1], object),
                         dot(previous_rows[2], object));
    vertex_clip = gl_Position;
    vertex_previous_clip = view.previous_clip_from_position * vec4(previous, 1.0);
#endif
}
