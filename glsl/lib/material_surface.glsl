/* The surface of a material at a point, for fragments (lib/material.glsl) and for compute shaders that
 * rasterise by themselves. Switches LSF_TEXTURED, LSF_SECOND_UV, LSF_VERTEX_COLOR, LSF_TANGENT,
 * LSF_MASK, LSF_BLEND, LSF_SPECULAR_PARAMS, LSF_ANISOTROPY, LSF_TRANSMISSION, LSF_EMISSION and one for each kind of texture;
 * lsf_scene_gpu_material_switches adds them. */
#ifndef LSF_LIB_MATERIAL_SURFACE
#define LSF_LIB_MATERIAL_SURFACE

#include "lib/alpha.glsl"
#include "lib/gbuffer.glsl"
#include "lib/scene.glsl"

#ifndef LSF_LOBES_FOLDED
#define LSF_LOBES_FOLDED 0
#endif

layout(binding = LSF_UNIT_BASE_COLOR) uniform sampler2D base_color_texture;
layout(binding = LSF_UNIT_METALLIC_ROUGHNESS) uniform sampler2D metallic_roughness_texture;
layout(binding = LSF_UNIT_NORMAL) uniform sampler2D normal_texture;
layout(binding = LSF_UNIT_EMISSIVE) uniform sampler2D emissive_texture;
layout(binding = LSF_UNIT_ANISOTROPY) uniform sampler2D anisotropy_texture;
#if LSF_LOBES
layout(binding = LSF_UNIT_LOBES) uniform samplerBuffer lobe_table; /* lsf_lobe_data */
#endif
#if LSF_SPECULAR_TINT
layout(binding = LSF_UNIT_SPECULAR) uniform sampler2D specular_texture;
layout(binding = LSF_UNIT_SPECULAR_COLOR) uniform sampler2D specular_color_texture;
#endif
#if LSF_SHEEN_COLOR_TEXTURE || LSF_SHEEN_ROUGHNESS_TEXTURE
layout(binding = LSF_UNIT_SHEEN_COLOR) uniform sampler2D sheen_color_texture;
layout(binding = LSF_UNIT_SHEEN_ROUGHNESS) uniform sampler2D sheen_roughness_texture;
#endif
#if LSF_COAT_TEXTURE || LSF_COAT_ROUGHNESS_TEXTURE || LSF_COAT_NORMAL_TEXTURE
layout(binding = LSF_UNIT_COAT) uniform sampler2D coat_texture;
layout(binding = LSF_UNIT_COAT_ROUGHNESS) uniform sampler2D coat_roughness_texture;
layout(binding = LSF_UNIT_COAT_NORMAL) uniform sampler2D coat_normal_texture;
#endif
#if LSF_TRANSMISSION_TEXTURE
layout(binding = LSF_UNIT_TRANSMISSION) uniform sampler2D transmission_texture;
#endif

/* Vertex attributes interpolated at a point of a triangle. */
struct material_point {
    vec3 normal;  /* any length */
    vec4 tangent; /* w: the bitangent's sign */
    vec4 color;
    texture_coordinates uv;
    bool front;
    uvec3 key; /* for alpha_cuts_out; only with LSF_BLEND */
};

vec4 base_color(lsf_material_data material, material_point point)
{
    vec4 color = material.base_color;
#if LSF_BASE_COLOR_TEXTURE
    if (slot_used(material.base_color_slot)) {
        vec4 texel = slot_sample(base_color_texture, material.base_color_slot, point.uv);
#if LSF_MASK
        /* Where the mean of a mask falls below the cutoff, all of it would be absent. */
        if (material.emission.w >= 0.0)
            texel.a =
                slot_sample_finest(base_color_texture, material.base_color_slot, point.uv.uv0, point.uv.uv1).a;
#endif
        color *= texel;
    }
#endif
#if LSF_VERTEX_COLOR
    color *= point.color;
#endif
    return color;
}

/* A unit tangent perpendicular to n; the interpolated tangent where there is one. */
vec3 tangent_about(vec3 n, vec3 tangent)
{
    vec3 t, b;
    orthonormal_basis(n, t, b);
    vec3 along = tangent - dot(tangent, n) * n;
    float length2 = dot(along, along);
    if (length2 > 0.0)
        t = along * inversesqrt(length2);
    return t;
}

/* Whether the front, or the back, emits light. */
bool material_emits(lsf_material_data material, bool front)
{
    return front || material.flags.x != 0.0 || material.flags.y != 0.0;
}

#if LSF_LOBES
vec4 lobe_row(lsf_material_data material, int row)
{
    return texelFetch(lobe_table, int(material.flags.w) * LSF_LOBE_ROWS + row);
}

lsf_texture_slot_data lobe_slot(lsf_material_data material, int row)
{
    return lsf_texture_slot_data(lobe_row(material, row), lobe_row(material, row + 1));
}

/* KHR_materials_sheen. */
void sheen_surface(lsf_material_data material, material_point point, inout surface s)
{
    vec4 sheen = lobe_row(material, 2);
    if (sheen.rgb == vec3(0.0))
        return;
#if LSF_SHEEN_COLOR_TEXTURE
    lsf_texture_slot_data color_slot = lobe_slot(material, 13);
    if (slot_used(color_slot))
        sheen.rgb *= slot_sample(sheen_color_texture, color_slot, point.uv).rgb;
#endif
#if LSF_SHEEN_ROUGHNESS_TEXTURE
    lsf_texture_slot_data roughness_slot = lobe_slot(material, 15);
    if (slot_used(roughness_slot))
        sheen.a *= slot_sample(sheen_roughness_texture, roughness_slot, point.uv).a;
#endif
#if LSF_LOBES_FOLDED || !LSF_SHEEN
    /* The sheen is folded into the diffuse lobe. Its mean albedo over the hemisphere grows from 0.015 to 0.3 with
     * the roughness. */
    float mean = mix(0.015, 0.3, clamp((sheen.a - 0.07) / 0.93, 0.0, 1.0));
    s.base_color = s.base_color * (1.0 - largest(sheen.rgb) * mean) + sheen.rgb * mean;
#else
    s.sheen = clamp(sheen, 0.0, 1.0);
#endif
}

/* KHR_materials_clearcoat. `vertex_frame`: tangent, bitangent and normal of the front. */
void coat_surface(lsf_material_data material, material_point point, mat3 vertex_frame, inout surface s)
{
    vec4 coat = lobe_row(material, 1);
    if (coat.x == 0.0)
        return;
#if LSF_COAT_TEXTURE
    lsf_texture_slot_data factor_slot = lobe_slot(material, 7);
    if (slot_used(factor_slot))
        coat.x *= slot_sample(coat_texture, factor_slot, point.uv).r;
#endif
#if LSF_LOBES_FOLDED || !LSF_COAT
    /* The coat's reflection is folded into the diffuse lobe; the rest of the light passes the coat twice. */
    float reflected = coat.x * LSF_COAT_MEAN;
    s.base_color = mix(s.base_color * (1.0 - reflected), vec3(1.0), reflected);
#else
#if LSF_COAT_ROUGHNESS_TEXTURE
    lsf_texture_slot_data roughness_slot = lobe_slot(material, 9);
    if (slot_used(roughness_slot))
        coat.y *= slot_sample(coat_roughness_texture, roughness_slot, point.uv).g;
#endif
    vec3 n = vertex_frame[2];
#if LSF_COAT_NORMAL_TEXTURE
    lsf_texture_slot_data normal_slot = lobe_slot(material, 11);
    if (slot_used(normal_slot)) {
        vec3 mapped = slot_sample(coat_normal_texture, normal_slot, point.uv).xyz * 2.0 - 1.0;
        mapped.xy *= coat.z;
        n = normalize(vertex_frame * mapped);
    }
#endif
    s.coat = coat.x;
    s.coat_roughness = coat.y;
    s.coat_normal = point.front ? n : -n;
#endif
}
#endif
#if LSF_SPECULAR_TINT

/* KHR_materials_specular. The f0 of each channel is at most 1. The largest one goes to s.f0, except for a medium,
 * whose s.f0 encodes its refractive index. */
void tint_specular(lsf_material_data material, material_point point, inout surface s)
{
    vec4 factors = lobe_row(material, 0);
#if LSF_SPECULAR_TEXTURE
    lsf_texture_slot_data weight_slot = lobe_slot(material, 3);
    if (slot_used(weight_slot))
        factors.a *= slot_sample(specular_texture, weight_slot, point.uv).a;
#endif
#if LSF_SPECULAR_COLOR_TEXTURE
    lsf_texture_slot_data tint_slot = lobe_slot(material, 5);
    if (slot_used(tint_slot))
        factors.rgb *= slot_sample(specular_color_texture, tint_slot, point.uv).rgb;
#endif
    bool medium = material.flags.z != 0.0;
    vec3 f0 = min(s.f0 * factors.rgb, 1.0);
    s.f0_tint = medium ? min(factors.rgb, 1.0) : f0 / max(largest(f0), 1e-6);
    s.specular_weight = factors.a;
    if (!medium)
        s.f0 = largest(f0);
#if LSF_LOBES_FOLDED
    if (!medium)
        s.f0 = dot(surface_f0(s), vec3(0.2126, 0.7152, 0.0722));
    lobes_none(s);
#endif
}
#endif

/* Sets all members but the geometric normal, which becomes the vertices'. False where an alpha mask, or the draw
 * for a blended surface, removes the point. The shading normal is flipped to the side that is seen. Emission is
 * that of the sides that material_emits names; for an unlit surface it is the base colour. */
bool material_surface(lsf_material_data material, material_point point, out surface s,
                      out vec3 emission)
{
    emission = vec3(0.0);
    vec4 color = base_color(material, point);
#if LSF_MASK
    if (alpha_cuts_out(material.emission.w, color.a, point.key))
        return false;
#endif
    vec3 vertex_n = normalize(point.normal);
    s.geometric_normal = vertex_n;
    vec3 n = vertex_n;
#if LSF_TANGENT
    vec3 t = tangent_about(n, point.tangent.xyz);
    vec3 b = cross(n, t) * point.tangent.w;
#endif
#if LSF_NORMAL_TEXTURE
    if (slot_used(material.normal_slot)) {
        vec3 mapped = slot_sample(normal_texture, material.normal_slot, point.uv).xyz * 2.0 - 1.0;
        mapped.xy *= material.surface.z;
        n = normalize(mapped.x * t + mapped.y * b + mapped.z * n);
    }
#endif
    s.normal = point.front ? n : -n;
    s.base_color = clamp(color.rgb, 0.0, 1.0);
    s.metallic = 0.0;
    s.roughness = 1.0;
    s.f0 = material.surface.w;
    lobes_none(s);
    s.anisotropy = 0.0;
    s.anisotropy_angle = 0.0;
    s.unlit = material.flags.y != 0.0;
#if LSF_SPECULAR_PARAMS
    s.metallic = material.surface.x;
    s.roughness = material.surface.y;
#if LSF_METALLIC_ROUGHNESS_TEXTURE
    if (slot_used(material.metallic_roughness_slot)) {
        vec4 texel =
            slot_sample(metallic_roughness_texture, material.metallic_roughness_slot, point.uv);
        s.metallic *= texel.b;
        s.roughness *= texel.g;
    }
#endif
#if LSF_SPECULAR_TINT
    tint_specular(material, point, s);
#endif
#if LSF_LOBES
    sheen_surface(material, point, s);
#if LSF_TANGENT
    coat_surface(material, point, mat3(t, b, vertex_n), s);
#else
    coat_surface(material, point, mat3(vertex_n, vertex_n, vertex_n), s);
#endif
#endif
#if LSF_ANISOTROPY
    vec2 rotation = material.anisotropy.yz;
    s.anisotropy = material.anisotropy.x;
#if LSF_ANISOTROPY_TEXTURE
    if (slot_used(material.anisotropy_slot)) {
        vec3 texel = slot_sample(anisotropy_texture, material.anisotropy_slot, point.uv).xyz;
        vec2 d = texel.xy * 2.0 - 1.0;
        rotation = vec2(d.x * rotation.x - d.y * rotation.y, d.x * rotation.y + d.y * rotation.x);
        s.anisotropy *= texel.z;
    }
#endif
    /* The tangent is stored as an angle in the basis that readers rebuild from the shading normal. */
    vec3 along = rotation.x * t + rotation.y * b;
    vec3 basis_t, basis_b;
    orthonormal_basis(s.normal, basis_t, basis_b);
    float angle = atan(dot(along, basis_b), dot(along, basis_t));
    s.anisotropy_angle = fract(angle / (2.0 * LSF_PI));
#endif
#endif
#if LSF_TRANSMISSION
    s.transmission = material.anisotropy.w;
#if LSF_TRANSMISSION_TEXTURE
    if (slot_used(material.transmission_slot))
        s.transmission *= slot_sample(transmission_texture, material.transmission_slot, point.uv).r;
#endif
    s.front = point.front;
    s.volume = material.flags.z != 0.0;
    s.material = uint(material.flags.w);
    s.eta = 1.0;
#if LSF_SCATTER
    s.through = false;
#endif
#endif
#if LSF_EMISSION
    emission = material.emission.rgb;
#if LSF_EMISSIVE_TEXTURE
    if (slot_used(material.emissive_slot))
        emission *= slot_sample(emissive_texture, material.emissive_slot, point.uv).rgb;
#endif
    if (s.unlit)
        emission = color.rgb;
#endif
    return true;
}

#endif
