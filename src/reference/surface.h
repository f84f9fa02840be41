/* The surface at a hit point. */
#ifndef LSF_REFERENCE_SURFACE_H
#define LSF_REFERENCE_SURFACE_H

#include "math/vector.h"
#include "reference/geometry.h"

/* A shading point, seen from one side. Directions are unit and in normalised space. */
typedef struct lsf_reference_surface {
    lsf_float3 position;
    lsf_float3 geometric_normal; /* towards the viewer */
    lsf_basis frame;             /* shading normal in n, on the viewer's side; t along the
                                  * anisotropy's direction */
    float ray_offset;            /* along geometric_normal, for rays that leave the surface */
    lsf_float3 view;             /* towards the viewer */
    lsf_float3 emission;         /* radiance towards the viewer */
    bool reflects;               /* false: unlit, it only emits */
    bool specular;               /* has the GGX lobe */
    lsf_float3 base_color;
    float metallic;
    float alpha_t, alpha_b;   /* GGX, along and across frame.t */
    lsf_float3 f0_dielectric; /* reflectance of the dielectric at normal incidence */
    float f90_dielectric;     /* its reflectance at grazing angles */
    lsf_float3 sheen_color;
    float sheen_roughness;
    float coat, coat_alpha; /* weight and GGX of the clear coat */
    lsf_float3 coat_normal; /* unit, on the viewer's side */
    float transmission;     /* share of the light that enters the dielectric */
    float eta;             /* refractive index behind the surface over that on the viewer's side; 1:
                            * not refracted */
    bool volume, front;    /* bounds a medium; seen from the front, which is outside of it */
    lsf_float3 absorption; /* of that medium */
} lsf_reference_surface;

/* `direction` is the ray's, unit. */
void lsf_reference_surface_init(lsf_reference_surface *surface,
                                const lsf_reference_geometry *geometry,
                                const lsf_reference_hit *hit, lsf_float3 direction);

lsf_float3 lsf_reference_hit_position(const lsf_reference_geometry *geometry,
                                      const lsf_reference_hit *hit);

/* Probability that a ray hits the point: its alpha where it is blended; 0 where a mask cuts it
 * out, else 1. */
float lsf_reference_coverage(const lsf_reference_geometry *geometry, const lsf_reference_hit *hit);

/* Radiance that the hit point emits on the front, or on the back. An unlit material emits its
 * base colour on both sides. */
lsf_float3 lsf_reference_emission(const lsf_reference_geometry *geometry,
                                  const lsf_reference_hit *hit, bool front);

/* Whether the material can emit at all. */
bool lsf_reference_material_emits(const lsf_material *material);

/* Unit normal of a triangle's front, or 0 when it has no area; `area` receives its area. */
lsf_float3 lsf_reference_triangle_normal(const lsf_reference_geometry *geometry, uint32_t instance,
                                         const lsf_float3 corners[3], float *area);

#endif
