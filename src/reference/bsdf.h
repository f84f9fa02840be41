/* The BSDF of glTF's materials at one surface point, as in glsl/shared/brdf.h: value, sampling
 * and density. Transmitted light leaves on the side away from the viewer. */
#ifndef LSF_REFERENCE_BSDF_H
#define LSF_REFERENCE_BSDF_H

#include "reference/surface.h"

typedef struct lsf_reference_bsdf {
    const lsf_reference_surface *surface;
    lsf_float3 view; /* local to surface->frame, lifted above the shading horizon */
    lsf_basis coat_frame;
    lsf_float3 coat_view;       /* local to coat_frame, lifted likewise */
    float coat_probability;     /* of choosing the clear coat's lobe, before all others */
    float specular_probability; /* of choosing a microfacet, which reflects or transmits, rather
                                 * than the diffuse lobe; negative: the surface is black */
} lsf_reference_bsdf;

void lsf_reference_bsdf_init(lsf_reference_bsdf *bsdf, const lsf_reference_surface *surface);

typedef struct lsf_reference_reflection {
    lsf_float3 diffuse, specular; /* f times the cosine of the light's direction; transmitted light
                                   * is specular */
    float pdf;                    /* of lsf_reference_bsdf_sample, per steradian */
} lsf_reference_reflection;

/* `light` is unit, in normalised space. Zero where it is above the horizon of one of the two
 * normals and below that of the other. */
lsf_reference_reflection lsf_reference_bsdf_evaluate(const lsf_reference_bsdf *bsdf,
                                                     lsf_float3 light);

/* A smooth thin wall: light that goes through keeps its direction. */
bool lsf_reference_is_clear(const lsf_reference_surface *surface);
/* Transmittance for light that goes straight through along the view; 0 where the surface is not
 * clear. */
lsf_float3 lsf_reference_straight(const lsf_reference_surface *surface);

/* Draws a direction from (1 - p) cos / pi + p D_v(h) (r(h) / (4 v.h) + (1 - r(h)) J), with J the
 * Jacobian of refraction at h, or of mirroring, and r the share of both that is reflected;
 * numbers uniform in [0, 1). A zero vector where the microfacet drawn sends light to the wrong
 * side. */
lsf_float3 lsf_reference_bsdf_sample(const lsf_reference_bsdf *bsdf, float lobe, const float u[2]);

#endif
