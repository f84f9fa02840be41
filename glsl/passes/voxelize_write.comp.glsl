/* Writes the surface of the winning triangle of each voxel that the current instance has won. */
/* A triangle that has won is present. */
#undef LSF_MASK
#undef LSF_BLEND
#define LSF_MASK 0
#define LSF_BLEND 0
#define VOXEL_WON
#include "passes/voxelize.glsl"
#include "passes/voxelize_list.glsl"

layout(local_size_x = LSF_VOXELIZE_GROUP) in;

layout(location = 28) uniform uint draw; /* number of the instance in draw order */

layout(binding = 1, r32ui) writeonly uniform uimage3D albedo_image;
layout(binding = 2, r32ui) writeonly uniform uimage3D normal_image;
layout(binding = 3, r32ui) writeonly uniform uimage3D point_image;
#if LSF_EMISSION
layout(binding = 4, r32ui) writeonly uniform uimage3D emission_image;
#endif
#if LSF_SPECULAR_PARAMS
layout(binding = 5, r32ui) writeonly uniform uimage3D specular_params_image;
#endif
#if LSF_TRANSMISSION
layout(binding = 6, r32ui) writeonly uniform uimage3D transmission_image;
#endif
#if LSF_VOXEL_BENT
layout(binding = 7, r32ui) writeonly uniform uimage3D shading_image;
#endif

void write_surface(voxel_triangle t, ivec3 cell)
{
    vec3 low = turned(vec3(cell), t.axis);
    vec3 weights = closest_weights(t, low + 0.5);
    surface s;
    vec3 emission;
    if (!surface_in(t, cell, weights, s, emission))
        return;
#if LSF_VOXEL_CHANCE
    /* Its reflection is weighted for the iterations in which it is absent. */
    s.transmission = 1.0 - (1.0 - s.transmission) / (1.0 - voxel_passes(s));
#endif
    lsf_material_data material = triangle_material();
    vec3 face = t.axis == 0 ? t.normal.zxy : t.axis == 1 ? t.normal.yzx : t.normal;
    if (range.w != 0u)
        face = -face;
    vec3 n = normalize(face);
    vec3 inside = t.a * weights.x + t.b * weights.y + t.c * weights.z - low;
    inside = t.axis == 0 ? inside.zxy : t.axis == 1 ? inside.yzx : inside;
    imageStore(albedo_image, cell,
               uvec4(voxel_albedo_pack(s.unlit ? vec3(0.0) : s.base_color)));
    imageStore(normal_image, cell, uvec4(voxel_normal_pack(n)));
#if LSF_VOXEL_BENT
    uint shading = voxel_normal_pack(s.normal);
#if LSF_ANISOTROPY
    vec3 basis_t, basis_b, along_t, along_b;
    orthonormal_basis(s.normal, basis_t, basis_b);
    float angle = 2.0 * LSF_PI * s.anisotropy_angle;
    vec3 along = cos(angle) * basis_t + sin(angle) * basis_b;
    orthonormal_basis(n, along_t, along_b);
    shading |= voxel_rotation_pack(atan(dot(along, along_b), dot(along, along_t)) / (2.0 * LSF_PI));
#endif
    imageStore(shading_image, cell, uvec4(shading));
#endif
    imageStore(point_image, cell,
               uvec4(voxel_point_pack(inside, material_emits(material, false), s.unlit)));
#if LSF_EMISSION
    imageStore(emission_image, cell, uvec4(voxel_emission_pack(emission * grid.unit.y)));
#endif
#if LSF_SPECULAR_PARAMS
    float alpha = lsf_alpha_from_roughness(s.roughness);
    float root = sqrt(s.f0); /* f0 = ((n - 1) / (n + 1))^2 */
    imageStore(specular_params_image, cell,
               uvec4(packUnorm4x8(vec4(sqrt(lsf_alpha_along_tangent(alpha, s.anisotropy)),
                                       s.roughness, root, s.metallic))));
#endif
#if LSF_TRANSMISSION
    imageStore(transmission_image, cell, uvec4(transmission_pack(s)));
#endif
}

void main()
{
    uint group = gl_WorkGroupID.x + gl_WorkGroupID.y * LSF_VOXEL_LIST_ROW;
    uint at = group * LSF_VOXELIZE_GROUP + gl_LocalInvocationID.x;
    if (at >= draws[draw].count)
        return;
    ivec3 cell = voxel_brick_unpack(won[draws[draw].first + at]);
    voxel_triangle t;
    if (triangle_load(winner(cell) - first_triangle, -1, t))
        write_surface(t, cell);
}
