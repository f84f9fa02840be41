/* Which lights an iteration's light paths begin at. */
#ifndef LSF_TECHNIQUES_LIGHT_PICKS_H
#define LSF_TECHNIQUES_LIGHT_PICKS_H

#include "math/distribution.h"
#include "plan/plan.h"
#include "scene/state.h"

typedef struct lsf_light_picks {
    lsf_distribution distribution; /* over the iteration's lights, those of the environment last */
    float *weights;                /* of which it was made */
    float power;                   /* of all, as lsf_light_power states it */
    float sky_probability;         /* that a light picked stands for the environment */
    bool sky;                      /* the environment's are among them */
} lsf_light_picks;

/* `sky`: whether light paths begin at lights that stand for the environment. */
bool lsf_light_picks_init(lsf_light_picks *picks, const lsf_plan *plan, const lsf_scene *scene,
                          const lsf_state *state, bool sky, lsf_error *error);
/* Follows lights that were edited; as many as before. */
void lsf_light_picks_update(lsf_light_picks *picks, const lsf_plan *plan, const lsf_scene *scene,
                            const lsf_state *state);
void lsf_light_picks_finish(lsf_light_picks *picks);

#endif
