/* The glTF metallic-roughness BRDF of glsl/shared/brdf.h at one surface point: value, sampling
 * and density. */
#ifndef LSF_REFERENCE_BSDF_H
#define LSF_REFERENCE_BSDF_H

#include "reference/surface.h"

typedef struct lsf_reference_bsdf {
    const lsf_reference_surface *surface;
    lsf_float3 view;            /* local to surface->frame, lifted above the shading horizon */
    float specular_probability; /* of choosing the GGX lobe; negative: the surface is black */
} lsf_reference_bsdf;

void lsf_reference_bsdf_init(lsf_reference_bsdf *bsdf, const lsf_reference_surface *surface);

typedef struct lsf_reference_reflection {
    lsf_float3 diffuse, specular; /* f times the cosine of the light's direction */
    float pdf;                    /* of lsf_reference_bsdf_sample, per steradian */
} lsf_reference_reflection;

/* `light` is unit, in normalised space. Zero below the horizon of either normal. */
lsf_reference_reflection lsf_reference_bsdf_evaluate(const lsf_reference_bsdf *bsdf,
                                                     lsf_float3 light);

/* Draws a direction from (1 - p) cos / pi + p D_v(h) / (4 v.h); numbers uniform in [0, 1). */
lsf_float3 lsf_reference_bsdf_sample(const lsf_reference_bsdf *bsdf, float lobe, const float u[2]);

#endif
