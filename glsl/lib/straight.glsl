/* Light that goes straight through surfaces that transmit: thin walls, and the interfaces of media as if these had
 * the index of air. Along a line, a surface lets T = (1 - metallic) (1 - F) t base of the light through. In each
 * iteration it is there by chance, with probability 1 - max T: where it is, what it reflects counts for
 * 1 / (1 - max T); where it is not, light passes with the tint T / max T, which is at most 1. Switch
 * LSF_STRAIGHT: the pass lets light through so. With LSF_SCATTER what rough walls let through to the eye is scattered,
 * but for a part where lobes are narrow. */
#ifndef LSF_LIB_STRAIGHT
#define LSF_LIB_STRAIGHT

#include "lib/gbuffer.glsl"
#if LSF_SCATTER
#include "shared/albedo.h"
#endif

#if LSF_SCATTER
/* Solid angle of as many samples as a lobe is spread over [sr]; 0: lobes are sampled as they are. */
layout(location = LSF_LOCATION_LOBE_ANGLE) uniform float lobe_angle;
#endif

/* A surface that reflects nothing is still there in one iteration of 64: it may emit. */
#define STRAIGHT_MOST (63.0 / 64.0)

#if LSF_TRANSMISSION
#if LSF_SCATTER
/* Product of both alphas. */
float wall_alpha2(surface s)
{
    float alpha = lsf_alpha_from_roughness(s.roughness);
#if LSF_ANISOTROPY
    return alpha * lsf_alpha_along_tangent(alpha, s.anisotropy);
#else
    return alpha * alpha;
#endif
}

bool is_rough_wall(surface s)
{
    return !s.volume && !s.unlit && wall_alpha2(s) > LSF_ALPHA_MIN * LSF_ALPHA_MIN;
}
#endif

/* Of light from the direction `to_viewer`, of any length: what passes a rough wall in all directions together. */
vec3 straight_transmittance(surface s, vec3 to_viewer)
{
    if (s.unlit)
        return vec3(0.0);
    float cosine = clamp(abs(dot(s.normal, normalize(to_viewer))), LSF_COSINE_MIN, 1.0);
    float f0 = largest(surface_f0(s)), f90 = surface_f90(s);
    float passes = 1.0 - lsf_fresnel_schlick_to(f0, f90, cosine);
#if LSF_SCATTER
    if (is_rough_wall(s))
        passes = lsf_specular_albedo(1.0 - f0, 1.0 - f90, cosine, sqrt(sqrt(wall_alpha2(s))));
#endif
    return s.base_color * (s.transmission * (1.0 - s.metallic) * passes);
}

/* With which probability light passes. */
float straight_chance(vec3 transmittance)
{
    return min(max(transmittance.r, max(transmittance.g, transmittance.b)), STRAIGHT_MOST);
}

/* Of light that passes. */
vec3 straight_tint(surface s, vec3 to_viewer)
{
    vec3 transmittance = straight_transmittance(s, to_viewer);
    return transmittance / max(straight_chance(transmittance), 1e-6);
}

/* The same, and 1 of a surface that lets none through. */
vec3 straight_tint_or_one(surface s, vec3 to_viewer)
{
    return s.transmission > 0.0 ? straight_tint(s, to_viewer) : vec3(1.0);
}

/* What the light that a surface reflects, where it is there, counts for. */
float straight_weight(surface s, vec3 to_viewer)
{
    return 1.0 / (1.0 - straight_chance(straight_transmittance(s, to_viewer)));
}

#if LSF_SCATTER
/* Of light that passes the surface to the eye, what it scatters; the rest goes straight on. A wall turns light by
 * twice the angle of its microfacets' normals, so that its lobe has a solid angle of about 4 pi alpha^2. One narrower
 * than `lobe_angle` would be seen as wide as that: scattered in part, it has in the mean the width that it should. */
float scattered_share(surface s)
{
    if (!is_rough_wall(s))
        return 0.0;
    return lobe_angle > 0.0 ? min(4.0 * LSF_PI * wall_alpha2(s) / lobe_angle, 1.0) : 1.0;
}

/* With which probability light that passes is scattered: often enough for lamps, which nothing else shows. */
float scattered_chance(float share)
{
    return share > 0.0 ? max(share, 0.125) : 0.0;
}

/* With which probability the eye looks through, straight or not, where `passes` is straight_chance: as often as not
 * where a fair part passes, for light behind a shade may be much the brighter. */
float look_through_chance(float passes, float share)
{
    return share > 0.0 ? max(passes, min(4.0 * passes, 0.5)) : passes;
}

/* Makes it a surface that is seen by what it scatters of light from its other side. */
void surface_look_through(inout surface s)
{
#if LSF_ANISOTROPY
    vec3 basis_t, basis_b, other_t, other_b;
    orthonormal_basis(s.normal, basis_t, basis_b);
    orthonormal_basis(-s.normal, other_t, other_b);
    float angle = 2.0 * LSF_PI * s.anisotropy_angle;
    vec3 along = cos(angle) * basis_t + sin(angle) * basis_b;
    s.anisotropy_angle = fract(atan(dot(along, other_b), dot(along, other_t)) / (2.0 * LSF_PI));
#endif
    s.geometric_normal = -s.geometric_normal;
    s.normal = -s.normal;
#if LSF_COAT
    s.coat_normal = -s.coat_normal;
#endif
    s.through = true;
}
#endif
#endif

#endif
