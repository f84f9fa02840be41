/* Light that passes straight through transmitting surfaces: thin walls, and the interfaces of media as if their
 * index were that of air. A surface transmits T = (1 - metallic) (1 - F) t base of the light along a line. It is
 * present in an iteration with probability 1 - max T. Where it is present, its reflection is weighted by 1 / (1 -
 * max T); where it is absent, light passes with the tint T / max T, which is at most 1. (To the eye the probability is
 * another: seen_through_chance.) Switch LSF_STRAIGHT: the pass transmits light in this way. With LSF_SCATTER light that
 * rough walls transmit to the eye is scattered, except for a share of narrow lobes. */
#ifndef LSF_LIB_STRAIGHT
#define LSF_LIB_STRAIGHT

#include "lib/gbuffer.glsl"
#if LSF_SCATTER
#include "shared/albedo.h"
#endif

#if LSF_SCATTER
/* Solid angle over which suppression spreads a lobe [sr]; 0: lobes are sampled unchanged. */
layout(location = LSF_LOCATION_LOBE_ANGLE) uniform float lobe_angle;
#endif

/* A surface that transmits all light is still present in one iteration of 64, because it may emit. */
#define STRAIGHT_MOST (63.0 / 64.0)

#if LSF_TRANSMISSION
#if LSF_SCATTER
/* Product of the alphas along tangent and bitangent. */
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

/* Transmittance for light from the direction `to_viewer`, of any length; for a rough wall, to all directions
 * together. */
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

/* Probability that the surface is absent and light passes. */
float straight_chance(vec3 transmittance)
{
    return min(largest(transmittance), STRAIGHT_MOST);
}

/* The same where the eye sees through the surface. A pane that absorbs most light is absent more often: with the share of
 * the light that passes in all that comes from the pane, if the world is equally bright everywhere; but at most half the
 * time, because it may be dark behind the pane. */
float seen_through_chance(surface s, vec3 to_viewer, vec3 transmittance)
{
    float cosine = clamp(abs(dot(s.normal, normalize(to_viewer))), LSF_COSINE_MIN, 1.0);
    float f0 = largest(mix(surface_f0(s), s.base_color, s.metallic)), f90 = mix(surface_f90(s), 1.0, s.metallic);
    float reflects = lsf_fresnel_schlick_to(f0, f90, cosine) +
                     (1.0 - s.transmission) * (1.0 - s.metallic) * largest(s.base_color);
    float passes = straight_chance(transmittance);
    return max(passes, min(passes / max(passes + reflects, 1e-6), 0.5));
}

/* Tint of light that passes an absent surface. */
vec3 straight_tint(surface s, vec3 to_viewer)
{
    vec3 transmittance = straight_transmittance(s, to_viewer);
    return transmittance / max(straight_chance(transmittance), 1e-6);
}

/* The same, and 1 for a surface that transmits nothing. */
vec3 straight_tint_or_one(surface s, vec3 to_viewer)
{
    return s.transmission > 0.0 ? straight_tint(s, to_viewer) : vec3(1.0);
}

/* Weight of the light that a surface reflects where it is present. */
float straight_weight(surface s, vec3 to_viewer)
{
    return 1.0 / (1.0 - straight_chance(straight_transmittance(s, to_viewer)));
}

#if LSF_SCATTER
/* Share of the light passing to the eye that the surface scatters; the rest goes straight on. A wall deflects
 * light by twice the angle of its microfacet normals, so that its lobe has a solid angle of about 4 pi alpha^2. A
 * lobe narrower than `lobe_angle` would be widened to that; with only a share of the light scattered, its mean
 * width is right. */
float scattered_share(surface s)
{
    if (!is_rough_wall(s))
        return 0.0;
    return lobe_angle > 0.0 ? min(4.0 * LSF_PI * wall_alpha2(s) / lobe_angle, 1.0) : 1.0;
}

/* Probability that passing light is scattered: at least 1/8, because lamps are visible through the wall by
 * scattering alone. */
float scattered_chance(float share)
{
    return share > 0.0 ? max(share, 0.125) : 0.0;
}

/* Probability that the eye looks through, straight or scattered, where `passes` is seen_through_chance. It is raised
 * up to one half, because light behind a shade may be much brighter than the shade. */
float look_through_chance(float passes, float share)
{
    return share > 0.0 ? max(passes, min(4.0 * passes, 0.5)) : passes;
}

/* Turns the surface into one that scatters light from its other side to the eye. */
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
