#include "lib/scene.glsl"
#include "lib/view.glsl"

layout(location = LSF_ATTRIBUTE_POSITION) in vec3 position;
layout(location = LSF_ATTRIBUTE_NORMAL) in vec3 normal;
layout(location = LSF_ATTRIBUTE_INSTANCE) in uint instance_id;

out vec3 vertex_position; /* normalised space, relative to the view's origin */
out vec3 vertex_normal;
flat out uint vertex_instance;
#if LSF_TANGENT
layout(location = LSF_ATTRIBUTE_TANGENT) in vec4 tangent;
out vec4 vertex_tangent;
#endif
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
out vec4 vertex_color;
#endif
#if LSF_MOTION
layout(std430, binding = LSF_BINDING_PREVIOUS_TRANSFORMS) readonly buffer lsf_previous_block
{
    vec4 previous_transforms[];
};
out vec4 vertex_clip, vertex_previous_clip;
#endif

/* Every pass that draws the scene must reach the same bits. */
invariant gl_Position;

void main()
{
    lsf_instance_data instance = instances[instance_id];
    vec3 p = instance_position(instance, position);
    gl_Position = view.clip_from_position * vec4(p, 1.0);
    vertex_position = p - view.origin.xyz;
    vertex_normal = instance_normal(instance, normal);
    vertex_instance = instance_id;
#if LSF_TANGENT
    vertex_tangent = vec4(instance_direction(instance, tangent.xyz), tangent.w);
#endif
#if LSF_TEXTURED
    vertex_uv0 = uv0;
#endif
#if LSF_SECOND_UV
    vertex_uv1 = uv1;
#endif
#if LSF_VERTEX_COLOR
    vertex_color = color;
#endif
#if LSF_MOTION
    vec4 object = vec4(position, 1.0);
    vec3 previous = vec3(dot(previous_transforms[3u * instance_id], object),
                         dot(previous_transforms[3u * instance_id + 1u], object),
                         dot(previous_transforms[3u * instance_id + 2u], object));
    vertex_clip = gl_Position;
    vertex_previous_clip = view.previous_clip_from_position * vec4(previous, 1.0);
#endif
}
