/* The path tracer's estimator: one path through a pixel. */
#ifndef LSF_REFERENCE_PATH_H
#define LSF_REFERENCE_PATH_H

#include "reference/geometry.h"
#include "reference/lights.h"
#include "scene/background.h"

/* Number of surface hits before Russian roulette may end a path. */
#define LSF_REFERENCE_ROULETTE_VERTEX 16u

/* Number of clear walls that light of punctual lights passes straight; beyond, it is absorbed. */
#define LSF_REFERENCE_WALLS 64

/* All inputs of a path. Borrows scene and state. */
typedef struct lsf_reference_world {
    lsf_reference_geometry geometry;
    lsf_reference_lights lights;
    uint32_t bounces;
    lsf_seen_background background; /* of paths that hit nothing; set by the caller */
    bool thin_walls;                /* some material transmits, and bounds no medium */
} lsf_reference_world;

/* False leaves nothing to finish. */
bool lsf_reference_world_init(lsf_reference_world *world, const lsf_scene *scene,
                              const lsf_state *state, uint32_t bounces, lsf_error *error);
void lsf_reference_world_finish(lsf_reference_world *world);

/* Source of a path's random numbers. */
typedef struct lsf_reference_sampler {
    uint64_t pixel_seed;
    uint32_t index; /* of the sample */
} lsf_reference_sampler;

/* The light that a path found, split as the layers of the picture are. */
typedef struct lsf_reference_path {
    lsf_float3 emission, direct, indirect_diffuse, indirect_specular;
    lsf_float3 albedo, normal;
    float depth;   /* along the view axis, normalised units; infinity: no hit */
    uint64_t rays; /* traced */
} lsf_reference_path;

/* `ndc`: position on the image plane, x right, y up, -1..1. */
void lsf_reference_trace_path(const lsf_reference_world *world, const float ndc[2],
                              const lsf_reference_sampler *sampler, lsf_reference_path *path);

/* The two numbers that position a sample in its pixel. */
void lsf_reference_pixel_sample(const lsf_reference_sampler *sampler, float point[2]);

#endif
