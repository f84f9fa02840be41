/* What a hit point is made of. */
#ifndef LSF_REFERENCE_SURFACE_H
#define LSF_REFERENCE_SURFACE_H

#include "math/vector.h"
#include "reference/geometry.h"

/* A shading point, seen from one side. Directions are unit and in normalised space. */
typedef struct lsf_reference_surface {
    lsf_float3 position;
    lsf_float3 geometric_normal; /* towards the viewer */
    lsf_basis frame;             /* shading normal in n, turned to the same side; t along the
                                  * anisotropy's direction */
    float ray_offset;            /* along geometric_normal, for rays that leave the surface */
    lsf_float3 view;             /* towards the viewer */
    lsf_float3 emission;         /* radiance towards the viewer */
    bool reflects;               /* false: unlit, it only emits */
    bool specular;               /* has the GGX lobe */
    lsf_float3 base_color;
    float metallic;
    float alpha_t, alpha_b;   /* GGX, along and across frame.t */
    lsf_float3 f0_dielectric; /* what the dielectric reflects of light from the front ... */
    float f90_dielectric;     /* ... and from the side */
    lsf_float3 sheen_color;
    float sheen_roughness;
    float coat, coat_alpha; /* weight and GGX of the clear coat */
    lsf_float3 coat_normal; /* unit, turned to the same side */
    float transmission;     /* of what the dielectric does not reflect */
    float eta;          /* index of refraction beyond the surface to the viewer's; 1: straight on */
    bool volume, front; /* bounds a medium; seen from the front, which is outside of it */
    lsf_float3 absorption; /* of that medium */
} lsf_reference_surface;

/* `direction` is the ray's, unit. */
void lsf_reference_surface_init(lsf_reference_surface *surface,
                                const lsf_reference_geometry *geometry,
                                const lsf_reference_hit *hit, lsf_float3 direction);

lsf_float3 lsf_reference_hit_position(const lsf_reference_geometry *geometry,
                                      const lsf_reference_hit *hit);

/* With which probability a ray is to meet the hit point: its alpha where it is blended; 0 where a
 * mask cuts it out, else 1. */
float lsf_reference_coverage(const lsf_reference_geometry *geometry, const lsf_reference_hit *hit);

/* Radiance that leaves the hit point on the front side, or on the back, if it is there.
 * An unlit material emits its base colour on both. */
lsf_float3 lsf_reference_emission(const lsf_reference_geometry *geometry,
                                  const lsf_reference_hit *hit, bool front);

/* Whether the material can emit at all. */
bool lsf_reference_material_emits(const lsf_material *material);

/* Unit normal of a triangle's front, or 0 when it has no area; `area` receives its area. */
lsf_float3 lsf_reference_triangle_normal(const lsf_reference_geometry *geometry, uint32_t instance,
                                         const lsf_float3 corners[3], float *area);

#endif
