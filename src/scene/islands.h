/* Parts of a scene that lie far from each other: boxes that hold all of its triangles. A map
 * over the whole scene need not spend texels on the space between them. */
#ifndef LSF_SCENE_ISLANDS_H
#define LSF_SCENE_ISLANDS_H

#include "scene/state.h"

#define LSF_ISLANDS_MAX 5 /* along an axis, four gaps at the most */

typedef struct lsf_islands {
    uint32_t count;                   /* 1: the scene is in one piece; 0: it is empty */
    float bounds[LSF_ISLANDS_MAX][6]; /* normalised space: least and greatest corner */
} lsf_islands;

/* Divides the scene at gaps along its axes that are a wide enough share of a part's length,
 * until there are LSF_ISLANDS_MAX parts. In a scene that moves, instances are kept whole, for it
 * is divided anew for each frame. */
void lsf_islands_find(lsf_islands *islands, const lsf_scene *scene, const lsf_state *state);

/* An island's bounds along an axis. */
void lsf_island_bounds_along(const float bounds[6], lsf_float3 axis, float *low, float *high);

#endif
