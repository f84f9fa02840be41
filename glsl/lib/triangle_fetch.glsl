/* Triangles of the current instance, for compute shaders that rasterise them; the host side is
 * frame/triangle_fetch.h. Switches of lib/material_surface.glsl. */
#ifndef LSF_LIB_TRIANGLE_FETCH
#define LSF_LIB_TRIANGLE_FETCH

#include "lib/material_surface.glsl"

layout(location = 1) uniform uvec4 range;       /* first index, triangles, instance, mirrored */
layout(location = 2) uniform vec4 transform[3]; /* rows */
layout(location = 5) uniform vec4 normal_transform[3];
layout(location = 9) uniform vec4 material_rows[18]; /* lsf_material_data */

layout(binding = 6) uniform usamplerBuffer index_fetch;
layout(binding = 7) uniform samplerBuffer position_fetch;
layout(binding = 8) uniform samplerBuffer normal_fetch;
layout(binding = 9) uniform samplerBuffer tangent_fetch;
layout(binding = 10) uniform samplerBuffer uv0_fetch;
layout(binding = 11) uniform samplerBuffer uv1_fetch;
layout(binding = 12) uniform samplerBuffer color_fetch;

uvec3 triangle_corners(uint triangle)
{
    int first = int(range.x + 3u * triangle);
    return uvec3(texelFetch(index_fetch, first).x, texelFetch(index_fetch, first + 1).x,
                 texelFetch(index_fetch, first + 2).x);
}

/* Position of a vertex in normalised space. */
vec3 triangle_position(uint vertex)
{
    vec4 p = vec4(texelFetch(position_fetch, int(vertex)).xyz, 1.0);
    return vec3(dot(transform[0], p), dot(transform[1], p), dot(transform[2], p));
}

vec3 triangle_direction(vec4 rows[3], vec3 v)
{
    return vec3(dot(rows[0].xyz, v), dot(rows[1].xyz, v), dot(rows[2].xyz, v));
}

lsf_material_data triangle_material()
{
    lsf_material_data m;
    m.base_color = material_rows[0];
    m.emission = material_rows[1];
    m.surface = material_rows[2];
    m.anisotropy = material_rows[3];
    m.flags = material_rows[4];
    m.absorption = material_rows[5];
    m.base_color_slot = lsf_texture_slot_data(material_rows[6], material_rows[7]);
    m.metallic_roughness_slot = lsf_texture_slot_data(material_rows[8], material_rows[9]);
    m.normal_slot = lsf_texture_slot_data(material_rows[10], material_rows[11]);
    m.emissive_slot = lsf_texture_slot_data(material_rows[12], material_rows[13]);
    m.anisotropy_slot = lsf_texture_slot_data(material_rows[14], material_rows[15]);
    m.transmission_slot = lsf_texture_slot_data(material_rows[16], material_rows[17]);
    return m;
}

/* Vertex attributes interpolated by these barycentric coordinates, seen from the front. Textures are filtered over
 * a footprint whose area is that of `footprint` triangles. */
material_point triangle_point(uvec3 corners, vec3 weights, float footprint)
{
    material_point point;
    vec3 normal = mat3(texelFetch(normal_fetch, int(corners.x)).xyz,
                       texelFetch(normal_fetch, int(corners.y)).xyz,
                       texelFetch(normal_fetch, int(corners.z)).xyz) *
                  weights;
    point.normal = triangle_direction(normal_transform, normal);
    point.front = true;
#if LSF_TEXTURED
    vec2 uv = texelFetch(uv0_fetch, int(corners.x)).xy;
    vec2 to_1 = texelFetch(uv0_fetch, int(corners.y)).xy - uv;
    vec2 to_2 = texelFetch(uv0_fetch, int(corners.z)).xy - uv;
    float side = sqrt(0.5 * abs(to_1.x * to_2.y - to_1.y * to_2.x) * footprint);
    point.uv.uv0 = uv + weights.y * to_1 + weights.z * to_2;
    point.uv.uv1 = point.uv.uv0;
    point.uv.uv0_dx = point.uv.uv1_dx = vec2(side, 0.0);
    point.uv.uv0_dy = point.uv.uv1_dy = vec2(0.0, side);
#endif
#if LSF_SECOND_UV
    vec2 second = texelFetch(uv1_fetch, int(corners.x)).xy;
    to_1 = texelFetch(uv1_fetch, int(corners.y)).xy - second;
    to_2 = texelFetch(uv1_fetch, int(corners.z)).xy - second;
    side = sqrt(0.5 * abs(to_1.x * to_2.y - to_1.y * to_2.x) * footprint);
    point.uv.uv1 = second + weights.y * to_1 + weights.z * to_2;
    point.uv.uv1_dx = vec2(side, 0.0);
    point.uv.uv1_dy = vec2(0.0, side);
#endif
#if LSF_TANGENT
    vec4 t = texelFetch(tangent_fetch, int(corners.x));
    vec3 along = weights.x * t.xyz + weights.y * texelFetch(tangent_fetch, int(corners.y)).xyz +
                 weights.z * texelFetch(tangent_fetch, int(corners.z)).xyz;
    point.tangent = vec4(triangle_direction(transform, along), range.w != 0u ? -t.w : t.w);
#endif
#if LSF_VERTEX_COLOR
    point.color = weights.x * texelFetch(color_fetch, int(corners.x)) +
                  weights.y * texelFetch(color_fetch, int(corners.y)) +
                  weights.z * texelFetch(color_fetch, int(corners.z));
#endif
    return point;
}

#endif
