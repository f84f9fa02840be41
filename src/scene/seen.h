/* What the camera sees of the surfaces, in a coarse picture made on the CPU. */
#ifndef LSF_SCENE_SEEN_H
#define LSF_SCENE_SEEN_H

#include "scene/occupancy.h"

/* Pixels along each side of the picture: so few that the points of the occupancy's cells leave no
 * holes between them. */
#define LSF_SEEN_SIDE 32

typedef struct lsf_seen_point {
    float depth;                 /* view depth, normalised units */
    lsf_float3 position, normal; /* normalised space; unit, on the camera's side of the surface */
    uint32_t material;
} lsf_seen_point;

typedef struct lsf_seen {
    uint32_t count; /* of pixels that show a surface */
    lsf_seen_point points[LSF_SEEN_SIDE * LSF_SEEN_SIDE];
    lsf_occupancy occupancy; /* of the scene */
} lsf_seen;

/* The points that the camera of `state` sees, one for each pixel at most. The backs of single-sided
 * surfaces are left out unless `scene` shows them, and so is what lets light straight through
 * (lsf_occupancy_init); for scenes with more surface than the occupancy is made for, all. NULL
 * without memory; lsf_seen_free frees it. */
lsf_seen *lsf_seen_create(const lsf_scene *scene, const lsf_state *state);
void lsf_seen_free(lsf_seen *seen);

/* The median of what was found at `count` points, at least 1; sorts them. */
float lsf_seen_median(float *values, uint32_t count);

#endif
