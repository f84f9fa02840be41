#include "lib/gbuffer.glsl"
#include "lib/scene.glsl"
#include "lib/view.glsl"

in vec3 vertex_position;
in vec3 vertex_normal;
flat in uint vertex_instance;
#if LSF_TANGENT
in vec4 vertex_tangent;
#endif
#if LSF_TEXTURED
in vec2 vertex_uv0;
#endif
#if LSF_SECOND_UV
in vec2 vertex_uv1;
#endif
#if LSF_VERTEX_COLOR
in vec4 vertex_color;
#endif
#if LSF_MOTION
in vec4 vertex_clip, vertex_previous_clip;
layout(location = LSF_MOTION_TARGET) out vec2 motion_out;
#endif

layout(binding = LSF_UNIT_BASE_COLOR) uniform sampler2D base_color_texture;
layout(binding = LSF_UNIT_METALLIC_ROUGHNESS) uniform sampler2D metallic_roughness_texture;
layout(binding = LSF_UNIT_NORMAL) uniform sampler2D normal_texture;
layout(binding = LSF_UNIT_EMISSIVE) uniform sampler2D emissive_texture;
layout(binding = LSF_UNIT_ANISOTROPY) uniform sampler2D anisotropy_texture;

layout(location = 0) out uvec4 surface_out;
#if LSF_GLOSS
layout(location = LSF_GLOSS_TARGET) out uvec2 gloss_out;
#endif
#if LSF_EMISSION
layout(location = LSF_EMISSION_TARGET) out vec4 emission_out;
#endif

texture_place place_on_textures()
{
    texture_place place;
#if LSF_TEXTURED
    place.uv0 = vertex_uv0;
    place.uv0_dx = dFdx(vertex_uv0);
    place.uv0_dy = dFdy(vertex_uv0);
#endif
#if LSF_SECOND_UV
    place.uv1 = vertex_uv1;
    place.uv1_dx = dFdx(vertex_uv1);
    place.uv1_dy = dFdy(vertex_uv1);
#elif LSF_TEXTURED
    place.uv1 = place.uv0;
    place.uv1_dx = place.uv0_dx;
    place.uv1_dy = place.uv0_dy;
#endif
    return place;
}

vec4 base_color(lsf_material_data material, texture_place place)
{
    vec4 color = material.base_color;
#if LSF_BASE_COLOR_TEXTURE
    if (slot_used(material.base_color_slot))
        color *= slot_sample(base_color_texture, material.base_color_slot, place);
#endif
#if LSF_VERTEX_COLOR
    color *= vertex_color;
#endif
    return color;
}

vec3 unit_or_zero(vec3 v)
{
    float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
    return largest > 0.0 ? normalize(v / largest) : vec3(0.0);
}

/* Unit, perpendicular to n; the interpolated tangent where there is one. */
vec3 tangent_about(vec3 n)
{
    vec3 t, b;
    orthonormal_basis(n, t, b);
#if LSF_TANGENT
    vec3 along = vertex_tangent.xyz - dot(vertex_tangent.xyz, n) * n;
    float length2 = dot(along, along);
    if (length2 > 0.0)
        t = along * inversesqrt(length2);
#endif
    return t;
}

void main()
{
    lsf_instance_data instance = instances[vertex_instance];
    lsf_material_data material = materials[uint(instance.normal_0.w)];
    texture_place place = place_on_textures();
    vec3 position_dx = dFdx(vertex_position), position_dy = dFdy(vertex_position);
    vec4 color = base_color(material, place);
#if LSF_MASK
    if (color.a < material.emission.w)
        discard;
#endif
    bool front = gl_FrontFacing != (instance.normal_1.w != 0.0);

    surface s;
    /* The triangle's own plane, for interpolation over it is affine. Each derivative is scaled
     * to unit length first, so that the smallest of triangles does not underflow. */
    vec3 face = cross(unit_or_zero(position_dx), unit_or_zero(position_dy));
    vec3 vertex_n = normalize(vertex_normal);
    s.geometric_normal = dot(face, face) > 0.0 ? normalize(face) : vertex_n;
#if LSF_ORTHOGRAPHIC
    vec3 to_viewer = -view.forward.xyz;
#else
    vec3 to_viewer = -vertex_position;
#endif
    if (dot(s.geometric_normal, to_viewer) < 0.0)
        s.geometric_normal = -s.geometric_normal;

    vec3 n = vertex_n;
#if LSF_TANGENT
    vec3 t = tangent_about(n);
    /* A mirror turns the cross product of mirrored vectors the other way. */
    bool mirrored = instance.normal_1.w != 0.0;
    vec3 b = cross(n, t) * (mirrored ? -vertex_tangent.w : vertex_tangent.w);
#endif
#if LSF_NORMAL_TEXTURE
    if (slot_used(material.normal_slot)) {
        vec3 mapped = slot_sample(normal_texture, material.normal_slot, place).xyz * 2.0 - 1.0;
        mapped.xy *= material.surface.z;
        n = normalize(mapped.x * t + mapped.y * b + mapped.z * n);
    }
#endif
    s.normal = front ? n : -n;
    s.base_color = clamp(color.rgb, 0.0, 1.0);
    s.metallic = 0.0;
    s.roughness = 1.0;
    s.f0 = material.surface.w;
    s.anisotropy = 0.0;
    s.anisotropy_turn = 0.0;
    s.unlit = material.flags.y != 0.0;
#if LSF_GLOSS
    s.metallic = material.surface.x;
    s.roughness = material.surface.y;
#if LSF_METALLIC_ROUGHNESS_TEXTURE
    if (slot_used(material.metallic_roughness_slot)) {
        vec4 texel =
            slot_sample(metallic_roughness_texture, material.metallic_roughness_slot, place);
        s.metallic *= texel.b;
        s.roughness *= texel.g;
    }
#endif
#if LSF_ANISOTROPY
    vec2 turn = material.anisotropy.yz;
    s.anisotropy = material.anisotropy.x;
#if LSF_ANISOTROPY_TEXTURE
    if (slot_used(material.anisotropy_slot)) {
        vec3 texel = slot_sample(anisotropy_texture, material.anisotropy_slot, place).xyz;
        vec2 d = texel.xy * 2.0 - 1.0;
        turn = vec2(d.x * turn.x - d.y * turn.y, d.x * turn.y + d.y * turn.x);
        s.anisotropy *= texel.z;
    }
#endif
    /* Stored as an angle in the basis that readers rebuild from the shading normal. */
    vec3 along = turn.x * t + turn.y * b;
    vec3 basis_t, basis_b;
    orthonormal_basis(s.normal, basis_t, basis_b);
    float angle = atan(dot(along, basis_b), dot(along, basis_t));
    s.anisotropy_turn = fract(angle / (2.0 * LSF_PI));
#endif
    gloss_out = gloss_pack(s);
#endif
#if LSF_EMISSION
    vec3 emission = front || material.flags.x != 0.0 ? material.emission.rgb : vec3(0.0);
#if LSF_EMISSIVE_TEXTURE
    if (slot_used(material.emissive_slot))
        emission *= slot_sample(emissive_texture, material.emissive_slot, place).rgb;
#endif
    if (s.unlit)
        emission = color.rgb;
    emission_out = vec4(emission, 1.0);
#endif
#if LSF_MOTION
    /* Without the jitter, which both have alike. In pixels, y up as on the image plane. */
    motion_out = 0.5 * view.size.xy * (vertex_clip.xy / vertex_clip.w -
                                       vertex_previous_clip.xy / vertex_previous_clip.w);
#endif
    surface_out = surface_pack(s);
}
