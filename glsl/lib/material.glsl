/* The surface under a fragment, from the scene's materials. Switches LSF_TEXTURED, LSF_SECOND_UV,
 * LSF_VERTEX_COLOR, LSF_TANGENT, LSF_MASK, LSF_GLOSS, LSF_ANISOTROPY, LSF_EMISSION and one for each
 * kind of texture; lsf_scene_gpu_material_switches adds them. */
#ifndef LSF_LIB_MATERIAL
#define LSF_LIB_MATERIAL

#include "lib/gbuffer.glsl"
#include "lib/scene.glsl"

in vec3 vertex_position;
in vec3 vertex_normal;
flat in vec4 vertex_base_color;
flat in vec4 vertex_emission; /* w: alpha cutoff */
flat in vec4 vertex_surface;  /* metallic, roughness, normal scale, f0 */
flat in vec4 vertex_flags;    /* mirrored, double-sided, unlit */
#if LSF_TANGENT
in vec4 vertex_tangent;
#endif
#if LSF_TEXTURED
in vec2 vertex_uv0;
flat in uint vertex_material;
#endif
#if LSF_SECOND_UV
in vec2 vertex_uv1;
#endif
#if LSF_VERTEX_COLOR
in vec4 vertex_color;
#endif
#if LSF_BASE_COLOR_TEXTURE
flat in vec4 vertex_base_color_row_0, vertex_base_color_row_1;
#endif
#if LSF_ANISOTROPY
flat in vec4 vertex_anisotropy;
#endif

layout(binding = LSF_UNIT_BASE_COLOR) uniform sampler2D base_color_texture;
layout(binding = LSF_UNIT_METALLIC_ROUGHNESS) uniform sampler2D metallic_roughness_texture;
layout(binding = LSF_UNIT_NORMAL) uniform sampler2D normal_texture;
layout(binding = LSF_UNIT_EMISSIVE) uniform sampler2D emissive_texture;
layout(binding = LSF_UNIT_ANISOTROPY) uniform sampler2D anisotropy_texture;

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

vec4 base_color(texture_place place)
{
    vec4 color = vertex_base_color;
#if LSF_BASE_COLOR_TEXTURE
    lsf_texture_slot_data slot =
        lsf_texture_slot_data(vertex_base_color_row_0, vertex_base_color_row_1);
    if (slot_used(slot))
        color *= slot_sample(base_color_texture, slot, place);
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

/* Whether the front, or the back, emits. */
bool material_emits(bool front)
{
    return front || vertex_flags.y != 0.0 || vertex_flags.z != 0.0;
}

/* False where an alpha mask cuts the fragment out. Normals are turned to the side that `to_viewer`
 * points to (any length); `front` says whether that is the front. Emission is that of the sides that
 * material_emits names; of an unlit surface it is the base colour. Call it first, while the whole
 * quad is alive. */
bool material_evaluate(vec3 to_viewer, out surface s, out vec3 emission, out bool front)
{
    front = gl_FrontFacing != (vertex_flags.x != 0.0);
    emission = vec3(0.0);
    texture_place place = place_on_textures();
    vec3 position_dx = dFdx(vertex_position), position_dy = dFdy(vertex_position);
    vec4 color = base_color(place);
#if LSF_MASK
    if (color.a < vertex_emission.w)
        return false;
#endif
    /* The triangle's own plane, for interpolation over it is affine. Each derivative is scaled
     * to unit length first, so that the smallest of triangles does not underflow. */
    vec3 face = cross(unit_or_zero(position_dx), unit_or_zero(position_dy));
    vec3 vertex_n = normalize(vertex_normal);
    s.geometric_normal = dot(face, face) > 0.0 ? normalize(face) : vertex_n;
    if (dot(s.geometric_normal, to_viewer) < 0.0)
        s.geometric_normal = -s.geometric_normal;

    vec3 n = vertex_n;
#if LSF_TANGENT
    vec3 t = tangent_about(n);
    vec3 b = cross(n, t) * vertex_tangent.w;
#endif
#if LSF_NORMAL_TEXTURE
    lsf_texture_slot_data normal_slot = materials[vertex_material].normal_slot;
    if (slot_used(normal_slot)) {
        vec3 mapped = slot_sample(normal_texture, normal_slot, place).xyz * 2.0 - 1.0;
        mapped.xy *= vertex_surface.z;
        n = normalize(mapped.x * t + mapped.y * b + mapped.z * n);
    }
#endif
    s.normal = front ? n : -n;
    s.base_color = clamp(color.rgb, 0.0, 1.0);
    s.metallic = 0.0;
    s.roughness = 1.0;
    s.f0 = vertex_surface.w;
    s.anisotropy = 0.0;
    s.anisotropy_turn = 0.0;
    s.unlit = vertex_flags.z != 0.0;
#if LSF_GLOSS
    s.metallic = vertex_surface.x;
    s.roughness = vertex_surface.y;
#if LSF_METALLIC_ROUGHNESS_TEXTURE
    lsf_texture_slot_data gloss_slot = materials[vertex_material].metallic_roughness_slot;
    if (slot_used(gloss_slot)) {
        vec4 texel =
            slot_sample(metallic_roughness_texture, gloss_slot, place);
        s.metallic *= texel.b;
        s.roughness *= texel.g;
    }
#endif
#if LSF_ANISOTROPY
    vec2 turn = vertex_anisotropy.yz;
    s.anisotropy = vertex_anisotropy.x;
#if LSF_ANISOTROPY_TEXTURE
    lsf_texture_slot_data anisotropy_slot = materials[vertex_material].anisotropy_slot;
    if (slot_used(anisotropy_slot)) {
        vec3 texel = slot_sample(anisotropy_texture, anisotropy_slot, place).xyz;
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
#endif
#if LSF_EMISSION
    emission = vertex_emission.rgb;
#if LSF_EMISSIVE_TEXTURE
    lsf_texture_slot_data emissive_slot = materials[vertex_material].emissive_slot;
    if (slot_used(emissive_slot))
        emission *= slot_sample(emissive_texture, emissive_slot, place).rgb;
#endif
    if (s.unlit)
        emission = color.rgb;
#endif
    return true;
}

#endif
