/* The choice of lights at which an iteration's light paths begin. */
#ifndef LSF_TECHNIQUES_LIGHT_PICKS_H
#define LSF_TECHNIQUES_LIGHT_PICKS_H

#include "math/distribution.h"
#include "plan/plan.h"
#include "scene/state.h"

typedef struct lsf_light_picks {
    lsf_distribution distribution; /* over the iteration's lights, those of the environment last */
    float *weights;                /* by power and evenly */
    float *followed;               /* half of them by importance: of lsf_light_picks_follow */
    float power;                   /* sum over all lights, as lsf_light_power gives it */
    float sky_probability;         /* probability that a picked light stands for the environment */
    bool sky;                      /* lights of the environment are among them */
} lsf_light_picks;

/* `sky`: whether light paths begin at lights that stand for the environment. */
bool lsf_light_picks_init(lsf_light_picks *picks, const lsf_plan *plan, const lsf_scene *scene,
                          const lsf_state *state, bool sky, lsf_error *error);
/* Follows lights that were edited; as many as before. */
void lsf_light_picks_update(lsf_light_picks *picks, const lsf_plan *plan, const lsf_scene *scene,
                            const lsf_state *state);
/* Goes half by `importance`, of the first `count` lights: the state's (passes/light_importance.h).
 * NULL, or all 0: by power and evenly. No light that shines has less than half of what it had. */
void lsf_light_picks_follow(lsf_light_picks *picks, uint32_t count, const float *importance);
void lsf_light_picks_finish(lsf_light_picks *picks);

#endif
