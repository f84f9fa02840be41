/* A coarse grid of the cells that opaque surfaces pass through: where light can and cannot go, well
 * enough to tell an open place from a closed one. */
#ifndef LSF_SCENE_OCCUPANCY_H
#define LSF_SCENE_OCCUPANCY_H

#include "scene/state.h"

/* Cells along each axis. */
#define LSF_OCCUPANCY_CELLS 64

/* A point of a surface in normalised space. */
typedef struct lsf_surface_point {
    lsf_float3 position, normal; /* unit, on its front */
    uint32_t material;
} lsf_surface_point;

typedef struct lsf_occupancy {
    lsf_float3 origin; /* normalised space */
    float cell;        /* edge length of a cell, normalised units */
    uint8_t *taken;    /* of each cell, x fastest: 1 where an opaque surface passes */
} lsf_occupancy;

typedef void (*lsf_surface_visit)(void *user, const lsf_surface_point *point);

/* The bounds of the state, which must not be empty, divided into cells. `visit` is called for the
 * points that the cells are found by, at most half a cell apart, of all surfaces but those that
 * let light straight through (transmitting and blended ones). When there are more than 2^25 such
 * points, or 2^24 triangles, there is no grid and no visit: `taken` is NULL. False without memory.
 */
bool lsf_occupancy_init(lsf_occupancy *occupancy, const lsf_scene *scene, const lsf_state *state,
                        lsf_surface_visit visit, void *user);
void lsf_occupancy_finish(lsf_occupancy *occupancy);

/* Whether a taken cell lies between `from` and the point at `distance` (which may be infinite)
 * along `direction` (unit), the first and last one and a half cells not counted: those hold the
 * surfaces that the two points lie on. */
bool lsf_occupancy_blocks(const lsf_occupancy *occupancy, lsf_float3 from, lsf_float3 direction,
                          float distance);

#endif
