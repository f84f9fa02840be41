/* The surface under a fragment, from the scene's materials. Switches as in
 * lib/material_surface.glsl. */
#ifndef LSF_LIB_MATERIAL
#define LSF_LIB_MATERIAL

#include "lib/material_surface.glsl"

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
#endif
#if LSF_TEXTURED || LSF_TRANSMISSION || LSF_LOBES
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
#if LSF_LAYERS
flat in uvec2 vertex_layer; /* instance, vertex */
#endif

texture_coordinates vertex_texture_coordinates()
{
    texture_coordinates coordinates;
#if LSF_TEXTURED
    coordinates.uv0 = vertex_uv0;
    coordinates.uv0_dx = dFdx(vertex_uv0);
    coordinates.uv0_dy = dFdy(vertex_uv0);
#endif
#if LSF_SECOND_UV
    coordinates.uv1 = vertex_uv1;
    coordinates.uv1_dx = dFdx(vertex_uv1);
    coordinates.uv1_dy = dFdy(vertex_uv1);
#elif LSF_TEXTURED
    coordinates.uv1 = coordinates.uv0;
    coordinates.uv1_dx = coordinates.uv0_dx;
    coordinates.uv1_dy = coordinates.uv0_dy;
#endif
    return coordinates;
}

vec3 unit_or_zero(vec3 v)
{
    float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
    return largest > 0.0 ? normalize(v / largest) : vec3(0.0);
}

/* The material as its vertex passed it on; members that few materials need are read here. */
lsf_material_data fragment_material()
{
    lsf_material_data material;
#if LSF_METALLIC_ROUGHNESS_TEXTURE
    material.metallic_roughness_slot = materials[vertex_material].metallic_roughness_slot;
#endif
#if LSF_NORMAL_TEXTURE
    material.normal_slot = materials[vertex_material].normal_slot;
#endif
#if LSF_EMISSIVE_TEXTURE
    material.emissive_slot = materials[vertex_material].emissive_slot;
#endif
#if LSF_ANISOTROPY_TEXTURE
    material.anisotropy_slot = materials[vertex_material].anisotropy_slot;
#endif
    material.base_color = vertex_base_color;
    material.emission = vertex_emission;
    material.surface = vertex_surface;
    material.flags = vec4(vertex_flags.yz, 0.0, 0.0);
#if LSF_BASE_COLOR_TEXTURE
    material.base_color_slot =
        lsf_texture_slot_data(vertex_base_color_row_0, vertex_base_color_row_1);
#endif
#if LSF_ANISOTROPY
    material.anisotropy = vertex_anisotropy;
#endif
#if LSF_TRANSMISSION
    material.anisotropy.w = materials[vertex_material].anisotropy.w;
    material.flags.zw = materials[vertex_material].flags.zw;
#elif LSF_LOBES
    material.flags.w = float(vertex_material);
#endif
#if LSF_TRANSMISSION_TEXTURE
    material.transmission_slot = materials[vertex_material].transmission_slot;
#endif
    return material;
}

/* Whether the front, or the back, emits light. */
bool material_emits(bool front)
{
    return material_emits(fragment_material(), front);
}

/* False where an alpha mask, or the draw for a blended surface, removes the fragment. Normals are flipped to the
 * side that `to_viewer` points to (any length); `front` says whether that is the front. Emission as in
 * material_surface. Call this first, while the whole quad is alive. */
bool material_evaluate(vec3 to_viewer, out surface s, out vec3 emission, out bool front)
{
    front = gl_FrontFacing != (vertex_flags.x != 0.0);
    material_point point;
    point.normal = vertex_normal;
    point.front = front;
    point.uv = vertex_texture_coordinates();
#if LSF_TANGENT
    point.tangent = vertex_tangent;
#endif
#if LSF_VERTEX_COLOR
    point.color = vertex_color;
#endif
#if LSF_BLEND
    point.key = uvec3(layer_key(vertex_layer.x, vertex_layer.y, front), uvec2(gl_FragCoord.xy));
#endif
    vec3 position_dx = dFdx(vertex_position), position_dy = dFdy(vertex_position);
    if (!material_surface(fragment_material(), point, s, emission))
        return false;
    /* The triangle's own plane, for interpolation over it is affine. Each derivative is scaled
     * to unit length first, so that the smallest of triangles does not underflow. */
    vec3 face = cross(unit_or_zero(position_dx), unit_or_zero(position_dy));
    if (dot(face, face) > 0.0)
        s.geometric_normal = normalize(face);
    if (dot(s.geometric_normal, to_viewer) < 0.0)
        s.geometric_normal = -s.geometric_normal;
    return true;
}

#endif
