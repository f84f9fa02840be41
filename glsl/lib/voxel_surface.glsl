/* Surfaces of voxels as a ray sees them, with the BRDF of their material. Switches LSF_VOXEL_SPECULAR_PARAMS,
 * LSF_VOXEL_BENT, LSF_ANISOTROPY, LSF_TRANSMISSION, LSF_EMISSION (surfaces emit), LSF_EMITTERS (points on them are
 * sampled), LSF_VOXEL_MIRRORS (rays of lobes go on from smooth metals), LSF_VOXEL_LAMPS. */
#ifndef LSF_LIB_VOXEL_SURFACE
#define LSF_LIB_VOXEL_SURFACE

#include "lib/gbuffer.glsl"
#include "lib/voxel_shading.glsl"
#include "lib/voxel_sight.glsl"
#include "lib/voxel_emission.glsl"
#include "lib/voxel_lamp.glsl"
#if LSF_VOXEL_LAMPS
#include "lib/brdf.glsl"
#endif
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
/* Whether a voxel shows what is around it in its lobe to a ray that was drawn with this density: where such rays are
 * denser than diffuse ones, too. 0: the ray passes a surface. To others metals spread light, which is less noisy. */
bool voxel_mirrors(surface s, float density)
{
    return !s.unlit && is_smooth_metal(s.metallic, s.roughness) && (density <= 0.0 || density > COSINE_DENSITY);
}
#endif

#if LSF_VOXEL_LAMPS
layout(binding = LSF_UNIT_VOXEL_LAMP) uniform usampler3D voxel_lamps;
/* x: m' of lobes that light other surfaces, over the iterations that the picture will have; below 0: the light of
 * voxels is without that of lamps; y: the least kernel of a lobe, because voxels show no finer detail. */
layout(location = LSF_LOCATION_VOXEL_LAMP) uniform vec2 lamp_kernel;

/* What the side of a voxel that faces a ray reflects of its lamp towards the ray's start `from`, in the grid's unit.
 * `density`: of all rays that find the direction [1/sr]; the lobe is spread over as many of them as `lamp_kernel`
 * says (brdf_evaluate). As the point moves over the surface, so does its direction to the lamp: both kernels add up
 * (Tokuyoshi and Ogaki 2012, equation 13). */
vec3 lamp_mirrored(surface s, voxel_lamp lamp, ivec3 cell, vec3 from, vec3 direction, float density)
{
    vec3 span = vec3(cell) + voxel_point_unpack(texelFetch(voxel_point, cell, 0).r) - from;
    float meets = max(abs(dot(s.geometric_normal, direction)), LSF_COSINE_MIN);
    float turn = abs(dot(s.geometric_normal, lamp.to_lamp)) / meets * dot(span, span) * max(lamp.nearness, 0.0);
    float kernel = density > 0.0 ? lamp_kernel.x / density * (1.0 + turn) : 0.0;
    return brdf_sum(s, brdf_evaluate(s, -direction, lamp.to_lamp, max(kernel, lamp_kernel.y))) * lamp.irradiance;
}

/* The lamp that a side of a voxel keeps. False: none. */
bool voxel_lamp_at(surface s, ivec3 cell, int side, out voxel_lamp lamp)
{
    lamp = voxel_lamp_unpack(texelFetch(voxel_lamps, cell + ivec3(0, 0, side * int(grid.size.z)), 0));
    return lamp_kernel.x >= 0.0 && !s.unlit && is_smooth_metal(s.metallic, s.roughness) && lamp.irradiance != vec3(0.0);
}

/* Radiance of a voxel's side towards the start of a ray, where it is `spread` if all light is reflected as by a diffuse
 * surface. */
vec3 voxel_reflects(vec3 spread, surface s, ivec3 cell, int side, vec3 from, vec3 direction, float density)
{
    voxel_lamp lamp;
    if (!voxel_lamp_at(s, cell, side, lamp))
        return spread;
    return max(spread - lamp.spread, 0.0) + lamp_mirrored(s, lamp, cell, from, direction, density);
}

/* What a voxel that mirrors shows of lamps. The ray finds the environment as it goes on. */
vec3 voxel_shows_lamp(surface s, ivec3 cell, int side, vec3 from, vec3 direction, float density)
{
    voxel_lamp lamp;
    if (!voxel_lamp_at(s, cell, side, lamp) || lamp.nearness == VOXEL_LAMP_SKY)
        return vec3(0.0);
    return lamp_mirrored(s, lamp, cell, from, direction, density);
}
#endif

#endif
