/* How the environment lights visible points: by directions with shadow maps, by what else finds it,
 * and by its light without shadows. */
#ifndef LSF_FRAME_SKY_USE_H
#define LSF_FRAME_SKY_USE_H

#include "plan/plan.h"

/* What else finds the environment from a visible point, by chance: its light is shared with that.
 */
typedef enum lsf_sky_chance {
    LSF_SKY_CHANCE_NONE,    /* nothing that the light's own share does not know of */
    LSF_SKY_CHANCE_PATHS,   /* paths drawn by the whole BRDF */
    LSF_SKY_CHANCE_LOBES,   /* diffuse rays by the cosine, and one by the specular lobe */
    LSF_SKY_CHANCE_DIFFUSE, /* diffuse rays; the specular lobe does without this pass */
} lsf_sky_chance;

/* What directions of the environment count on of its light without shadows. */
typedef enum lsf_sky_control {
    LSF_SKY_CONTROL_NONE,
    LSF_SKY_CONTROL_SHARE, /* the share of it that the directions before have found */
    LSF_SKY_CONTROL_WHOLE, /* all of it */
} lsf_sky_control;

typedef struct lsf_sky_use {
    lsf_sky_chance chance;
    float paths[2]; /* of chance: their number at roughness 0 and 1, rounded between */
    lsf_sky_control control;
    bool lobes;            /* rays through voxels tell how much of its light narrow lobes reflect */
    uint32_t open_samples; /* of light without shadows, of each kind in a pixel and iteration,
                            * a power of two */
} lsf_sky_use;

/* Of the reflection at visible points, for the pass in turn. */
void lsf_sky_use_switches(lsf_plan *plan);

#endif
