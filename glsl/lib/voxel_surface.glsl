/* Surfaces of voxels as a ray sees them, with the BRDF of their material. Switches LSF_VOXEL_SPECULAR_PARAMS,
 * LSF_VOXEL_BENT, LSF_ANISOTROPY, LSF_TRANSMISSION, LSF_EMISSION (surfaces emit), LSF_EMITTERS (points on them are
 * sampled), LSF_VOXEL_MIRRORS (the environment alone lights metals). */
#ifndef LSF_LIB_VOXEL_SURFACE
#define LSF_LIB_VOXEL_SURFACE

#include "lib/gbuffer.glsl"
#include "lib/voxel_shading.glsl"
#include "lib/voxel_sight.glsl"
#include "lib/voxel_emission.glsl"
#if LSF_EMITTERS
#include "lib/voxel_emitter.glsl"
#endif

layout(binding = LSF_UNIT_VOXEL_ALBEDO) uniform usampler3D voxel_albedo;
#if LSF_VOXEL_SPECULAR_PARAMS
layout(binding = LSF_UNIT_VOXEL_SPECULAR_PARAMS) uniform usampler3D voxel_specular_params;
#endif
#if LSF_TRANSMISSION
layout(binding = LSF_UNIT_VOXEL_TRANSMISSION) uniform usampler3D voxel_transmission_bits;
#endif

/* The surface of a voxel on the side that faces a ray along `direction`; `side`: 0 on that of its normal, else 1. */
surface voxel_surface_at(ivec3 cell, vec3 direction, out int side)
{
    surface s;
    uint normal = texelFetch(voxel_normal, cell, 0).r, shading_bits = voxel_shading_bits(cell, normal);
    vec3 n = voxel_normal_unpack(normal), shading = voxel_normal_unpack(shading_bits);
    side = dot(n, direction) <= 0.0 ? 0 : 1;
    s.geometric_normal = side == 0 ? n : -n;
    s.normal = side == 0 ? shading : -shading;
    s.base_color = voxel_albedo_unpack(texelFetch(voxel_albedo, cell, 0).r);
    s.unlit = voxel_unlit(texelFetch(voxel_point, cell, 0).r);
    s.metallic = 0.0;
    s.roughness = 1.0;
    s.f0 = 0.04; /* ior 1.5 */
    lobes_none(s);
    s.anisotropy = 0.0;
    s.anisotropy_angle = 0.0;
#if LSF_VOXEL_SPECULAR_PARAMS
    vec4 specular_params = unpackUnorm4x8(texelFetch(voxel_specular_params, cell, 0).r);
    s.roughness = specular_params.y;
    s.f0 = specular_params.z * specular_params.z;
    s.metallic = specular_params.w;
#if LSF_ANISOTROPY
    /* The inverse of lsf_alpha_along_tangent, and the rotation from the frame of n to that of -n. */
    float alpha = lsf_alpha_from_roughness(specular_params.y);
    s.anisotropy = sqrt(clamp((specular_params.x * specular_params.x - alpha) / max(1.0 - alpha, 1e-4), 0.0, 1.0));
    vec3 t, b, own_t, own_b;
    orthonormal_basis(n, t, b);
    orthonormal_basis(s.normal, own_t, own_b);
    float angle = 2.0 * LSF_PI * voxel_rotation_unpack(shading_bits);
    vec3 along = cos(angle) * t + sin(angle) * b;
    s.anisotropy_angle = fract(atan(dot(along, own_b), dot(along, own_t)) / (2.0 * LSF_PI));
#endif
#endif
#if LSF_TRANSMISSION
    transmission_unpack(texelFetch(voxel_transmission_bits, cell, 0).r, s);
    transmission_set_side(s, side == 0);
#endif
    return s;
}

#if LSF_VOXEL_MIRRORS
/* The largest density of directions that are drawn by the cosine [1/sr]. */
#define COSINE_DENSITY (1.0 / LSF_PI)

/* Whether a metal shows the environment in its lobe: where the lobe, and the one from which the ray was drawn with
 * this density, are denser than diffuse ones. 0: the ray passes a surface. To others metals spread the light, which
 * is less noisy. The peak of a lobe, seen along the normal, is 1 / (4 pi alpha^2). */
bool voxel_mirrors(surface s, float density)
{
    float alpha = lsf_alpha_from_roughness(s.roughness);
    return !s.unlit && s.metallic >= 0.5 && 4.0 * LSF_PI * COSINE_DENSITY * alpha * alpha < 1.0 &&
           (density <= 0.0 || density > COSINE_DENSITY);
}
#endif

#endif
