/* Light that goes straight through surfaces that transmit: thin walls, and the interfaces of media as if these had
 * the index of air. Along a line, a surface lets T = (1 - metallic) (1 - F) t base of the light through. In each
 * iteration it is there by chance, with probability 1 - max T: where it is, what it reflects counts for
 * 1 / (1 - max T); where it is not, light passes with the tint T / max T, which is at most 1. Switch
 * LSF_STRAIGHT: the pass lets light through so. */
#ifndef LSF_LIB_STRAIGHT
#define LSF_LIB_STRAIGHT

#include "lib/gbuffer.glsl"

/* A surface that reflects nothing is still there in one iteration of 64: it may emit. */
#define STRAIGHT_MOST (63.0 / 64.0)

#if LSF_TRANSMISSION
/* `to_viewer`: of any length. */
vec3 straight_transmittance(surface s, vec3 to_viewer)
{
    if (s.unlit)
        return vec3(0.0);
    float cosine = clamp(abs(dot(s.normal, normalize(to_viewer))), LSF_COSINE_MIN, 1.0);
    return s.base_color *
           (s.transmission * (1.0 - s.metallic) *
            (1.0 - lsf_fresnel_schlick_to(largest(surface_f0(s)), surface_f90(s), cosine)));
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

/* What the light that a surface reflects, where it is there, counts for. */
float straight_weight(surface s, vec3 to_viewer)
{
    return 1.0 / (1.0 - straight_chance(straight_transmittance(s, to_viewer)));
}
#endif

#endif
