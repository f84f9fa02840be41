/* A virtual point light: x1 of the paper, lit by the light at x0; or a point of an emissive
 * surface. Normalised space. Written as storage buffer LSF_BINDING_VPL, read as a buffer texture.
 */
#ifndef LSF_SHARED_VPL_DATA_H
#define LSF_SHARED_VPL_DATA_H

#include "shared/shared.h"

#define LSF_VPL_DARK 0.0f     /* the ray from the light hit no reflecting surface */
#define LSF_VPL_REFLECTS 1.0f /* the light of a punctual light */
#define LSF_VPL_EMITS 2.0f    /* only position, geometric_normal and intensity are set */

/* For a directional light, whose x0 is at infinity, intensity is its irradiance [W/m^2], the
 * density is per area of a plane across it, and the distance is 1: one set of formulas then serves
 * all lights. */
struct lsf_vpl_data {
    vec4 position;         /* xyz; w: one of LSF_VPL_ */
    vec4 geometric_normal; /* xyz: unit, towards the light; w: density of its emission, p_e [1/sr],
                            * times the probability of having chosen the light. Emissive: on the
                            * emitting side; density by area times that probability */
    vec4 normal;           /* xyz: unit shading normal, the same side; w: metallic */
    vec4 base_color;       /* rgb; w: 1 when the light is directional: its rays are parallel */
    vec4 specular_params;  /* roughness, f0, anisotropy, its rotation (see lib/gbuffer.glsl) */
    vec4 to_light;         /* xyz: unit, towards x0; w: squared distance */
    vec4 intensity;        /* rgb: of the light, towards x1 [W/sr]; w: transmission. Emissive:
                            * radiance; density for weights, see scene/emitters.h */
};

#include "shared/shared_end.h"
#endif
