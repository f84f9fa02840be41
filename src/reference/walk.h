/* A path on its way: where it is, what it carries, and what it can ask of the world. */
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

/* How a walk came to its vertex. */
typedef struct lsf_walk_arrival {
    bool joined;          /* a light's path could have been joined to the vertex before */
    lsf_float3 from;      /* that vertex */
    lsf_float3 direction; /* from there, unit */
    float pdf;            /* of drawing it, per steradian */
} lsf_walk_arrival;

/* Throughput is kept apart for the two lobes of the first hit, by which indirect light is split;
 * what the path meets is weighed with their sum. */
typedef struct lsf_walk {
    const lsf_reference_world *world;
    const lsf_reference_sampler *sampler;
    lsf_reference_path *path;
    uint32_t vertex; /* 0: the first hit */
    uint32_t walls;  /* clear ones among the vertices before, which are no bounces */
    lsf_float3 diffuse, specular;
    lsf_float3 absorption; /* of the medium that the path last came through; 0: air */
    lsf_walk_arrival arrival;
    lsf_reference_surface surface;
    lsf_reference_bsdf bsdf;
} lsf_walk;

/* Seed of a set of random numbers at the walk's vertex. */
uint32_t lsf_walk_seed(const lsf_walk *walk, lsf_walk_dimension dimension);
/* Of the ray that is to be traced next. */
lsf_reference_chance lsf_walk_chance(lsf_walk *walk);

/* Power heuristic, exponent 2: E. Veach, "Robust Monte Carlo Methods for Light Transport
 * Simulation", 1997, section 9.2.2. By the ratio, whose square stays in range. */
static inline float lsf_mis_weight(float pdf, float other_pdf)
{
    float ratio = other_pdf / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

/* The vertex, as light tells it. */
lsf_light_receiver lsf_walk_receiver(const lsf_walk *walk);
/* How many point and spot lights the vertex asks, and as many far ones. */
uint32_t lsf_walk_most(const lsf_walk *walk);

/* Whether a direction that is drawn at the vertex leads to no further one. Clear walls are no
 * bounce: one that crosses them goes on. */
bool lsf_walk_is_last(const lsf_walk *walk);

/* Adds light that reaches the current vertex and is reflected along the path; `reflection` is
 * weighed by `radiance`, which includes one over the density. */
void lsf_walk_add_reflected(lsf_walk *walk, const lsf_reference_reflection *reflection,
                            lsf_float3 radiance);
/* Adds light that a direction drawn at the current vertex met, which `crosses` a clear wall or not.
 * What shines behind clear walls is seen. */
void lsf_walk_add_met(lsf_walk *walk, const lsf_reference_reflection *reflection, bool crosses,
                      lsf_float3 radiance);

/* Moves on to `next`, along a direction drawn with the density reflection->pdf. */
void lsf_walk_move(lsf_walk *walk, const lsf_reference_reflection *reflection, bool crosses,
                   lsf_float3 absorption, const lsf_reference_surface *next);

/* Where a ray in this direction begins: on the side of the surface that it leaves to. */
lsf_float3 lsf_ray_origin(const lsf_reference_surface *surface, lsf_float3 direction);

/* Absorption of the medium that a ray from the current vertex goes through. */
lsf_float3 lsf_walk_absorption(const lsf_walk *walk, lsf_float3 direction);
/* Beer and Lambert's law: what is left of light after a distance. */
lsf_float3 lsf_left_after(lsf_float3 absorption, float distance);

/* Whether nothing is between the current vertex and `target`, or the sky. */
bool lsf_walk_reaches(lsf_walk *walk, lsf_float3 target);
bool lsf_walk_reaches_sky(lsf_walk *walk, lsf_float3 direction);

/* What clear walls of glass leave of a punctual light's way to the current vertex, which is free of
 * all else; 0 where it is not. `target` NULL: the light comes from far away along `direction`.
 * `walls` receives how many there are. */
lsf_float3 lsf_walk_passes(lsf_walk *walk, lsf_float3 direction, const lsf_float3 *target,
                           uint32_t *walls);

#endif
