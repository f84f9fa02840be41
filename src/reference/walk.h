/* The state of a path in progress: position, throughput, and queries of the scene. */
#ifndef LSF_REFERENCE_WALK_H
#define LSF_REFERENCE_WALK_H

#include "reference/bsdf.h"
#include "reference/path.h"

/* Sets of random numbers: one for the pixel, then these for every vertex. */
typedef enum lsf_walk_dimension {
    LSF_WALK_LIGHT,
    LSF_WALK_EMITTER,
    LSF_WALK_EMITTER_POINT,
    LSF_WALK_SKY,
    LSF_WALK_LOBE,
    LSF_WALK_DIRECTION,
    LSF_WALK_ROULETTE,
    LSF_WALK_DIMENSIONS,
} lsf_walk_dimension;

/* How a walk reached its vertex. */
typedef struct lsf_walk_arrival {
    bool joined;          /* a path from a light could have been joined to the previous vertex */
    lsf_float3 from;      /* that vertex */
    lsf_float3 direction; /* from there, unit */
    float pdf;            /* density of drawing it, per steradian */
} lsf_walk_arrival;

/* Throughput is kept apart for the two lobes of the first hit, into which indirect light is
 * split; light is weighted with their sum. */
typedef struct lsf_walk {
    const lsf_reference_world *world;
    const lsf_reference_sampler *sampler;
    lsf_reference_path *path;
    uint32_t vertex; /* 0: the first hit */
    uint32_t walls;  /* number of clear ones among the vertices so far, which count as no bounces */
    lsf_float3 diffuse, specular;
    lsf_float3 absorption; /* of the medium around the last segment; 0: air */
    lsf_walk_arrival arrival;
    lsf_reference_surface surface;
    lsf_reference_bsdf bsdf;
} lsf_walk;

/* Seed of a set of random numbers at the walk's vertex. */
uint32_t lsf_walk_seed(const lsf_walk *walk, lsf_walk_dimension dimension);
/* Random choices of the next ray. */
lsf_reference_chance lsf_walk_chance(lsf_walk *walk);

/* Power heuristic, exponent 2: E. Veach, "Robust Monte Carlo Methods for Light Transport
 * Simulation", 1997, section 9.2.2. It is computed from the ratio, whose square stays in range. */
static inline float lsf_mis_weight(float pdf, float other_pdf)
{
    float ratio = other_pdf / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

/* The vertex as a receiver of light. */
lsf_light_receiver lsf_walk_receiver(const lsf_walk *walk);
/* Number of point and spot lights that the vertex samples, and of lights at infinity. */
uint32_t lsf_walk_most(const lsf_walk *walk);

/* Whether the path ends with a direction drawn at the vertex. Clear walls count as no bounce: a
 * path that crosses them continues. */
bool lsf_walk_is_last(const lsf_walk *walk);

/* Adds light that reaches the current vertex and is reflected along the path; `reflection` is
 * multiplied by `radiance`, which includes the reciprocal of the density. */
void lsf_walk_add_reflected(lsf_walk *walk, const lsf_reference_reflection *reflection,
                            lsf_float3 radiance);
/* Adds light found by a direction drawn at the current vertex; `crosses`: through a clear wall.
 * Light sources behind clear walls are seen directly. */
void lsf_walk_add_met(lsf_walk *walk, const lsf_reference_reflection *reflection, bool crosses,
                      lsf_float3 radiance);

/* Moves on to `next`, along a direction drawn with the density reflection->pdf. */
void lsf_walk_move(lsf_walk *walk, const lsf_reference_reflection *reflection, bool crosses,
                   lsf_float3 absorption, const lsf_reference_surface *next);

/* Origin of a ray in this direction, on the side of the surface to which it leaves. */
lsf_float3 lsf_ray_origin(const lsf_reference_surface *surface, lsf_float3 direction);

/* Absorption of the medium around a ray from the current vertex. */
lsf_float3 lsf_walk_absorption(const lsf_walk *walk, lsf_float3 direction);
/* Beer-Lambert law: transmittance over a distance. */
lsf_float3 lsf_left_after(lsf_float3 absorption, float distance);

/* Whether the segment between the current vertex and `target`, or the sky, is free. */
bool lsf_walk_reaches(lsf_walk *walk, lsf_float3 target);
bool lsf_walk_reaches_sky(lsf_walk *walk, lsf_float3 direction);

/* Transmittance of clear walls between a punctual light and the current vertex; 0 where anything
 * else occludes it. `target` NULL: the light comes from infinity along `direction`. `walls`
 * receives the number of walls. */
lsf_float3 lsf_walk_passes(lsf_walk *walk, lsf_float3 direction, const lsf_float3 *target,
                           uint32_t *walls);

#endif
