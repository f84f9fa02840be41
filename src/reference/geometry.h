/* The scene's triangles in normalised space, in an Embree acceleration structure. */
#ifndef LSF_REFERENCE_GEOMETRY_H
#define LSF_REFERENCE_GEOMETRY_H

#include <embree3/rtcore.h>

#include <lightsheaf/error.h>

#include "math/vector.h"
#include "scene/state.h"

/* One instance. Its number is Embree's geometry id. */
typedef struct lsf_reference_mesh {
    const struct lsf_reference_geometry *geometry;
    uint32_t instance;
    uint32_t triangle_count;
    float *positions;        /* 3 each, normalised space */
    const uint32_t *indices; /* 3 each, from the primitive's first vertex */
} lsf_reference_mesh;

typedef struct lsf_reference_geometry {
    const lsf_scene *scene;
    const lsf_state *state;
    RTCDevice device;
    RTCScene tree;
    lsf_reference_mesh *meshes; /* one for each instance; skipped ones have no triangles */
    uint32_t **indices;         /* one list for each primitive in use */
} lsf_reference_geometry;

typedef enum lsf_reference_use {
    LSF_REFERENCE_USE_PICTURE, /* watertight */
    LSF_REFERENCE_USE_SPEED,   /* the tree that is traced fastest; blended surfaces are opaque */
} lsf_reference_use;

/* Borrows scene and state. False leaves nothing to finish. */
bool lsf_reference_geometry_init(lsf_reference_geometry *geometry, const lsf_scene *scene,
                                 const lsf_state *state, lsf_reference_use use, lsf_error *error);
void lsf_reference_geometry_finish(lsf_reference_geometry *geometry);

typedef struct lsf_reference_hit {
    uint32_t instance, triangle;
    float b1, b2;   /* barycentrics of the second and third corner */
    float distance; /* in units of the direction's length */
} lsf_reference_hit;

/* Random choice whether a ray hits blended surfaces: each triangle on its way has a number of
 * its own, which is uniform over the samples and spread evenly over the samples of a seed. */
typedef struct lsf_reference_chance {
    uint32_t seed, sample;
} lsf_reference_chance;

/* Nearest hit with near < t < far. Triangles that an alpha mask cuts out are not hit, blended
 * ones with the probability of their alpha. A ray from the camera does not see hidden back
 * faces, and of coincident triangles it sees the one that techniques draw first. */
bool lsf_reference_see(const lsf_reference_geometry *geometry, lsf_float3 origin,
                       lsf_float3 direction, float near, lsf_reference_chance chance,
                       lsf_reference_hit *hit);
bool lsf_reference_trace(const lsf_reference_geometry *geometry, lsf_float3 origin,
                         lsf_float3 direction, float near, float far, lsf_reference_chance chance,
                         lsf_reference_hit *hit);
/* Whether anything is hit with 0 < t < far. */
bool lsf_reference_occluded(const lsf_reference_geometry *geometry, lsf_float3 origin,
                            lsf_float3 direction, float far, lsf_reference_chance chance);

/* Corners of a triangle in normalised space. */
void lsf_reference_corners(const lsf_reference_geometry *geometry, uint32_t instance,
                           uint32_t triangle, lsf_float3 corners[3]);

/* Numbers of the corners in the scene's vertex streams. */
void lsf_reference_vertices(const lsf_reference_geometry *geometry, uint32_t instance,
                            uint32_t triangle, uint64_t vertices[3]);

/* Distance from a triangle at which a ray must start so that it does not hit the triangle
 * itself: a bound of the rounding errors of the interpolated position and of the intersection
 * test, which are both relative to the largest coordinate. */
float lsf_reference_ray_offset(const lsf_float3 corners[3]);

#endif
