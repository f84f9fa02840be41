/* Lights that stand for the environment in an iteration: directions drawn by its radiance, each
 * with the irradiance of a directional light, so that the environment takes part in all that
 * directional lights do (maps, VPLs, light on voxels). Other ways of finding the sky share its
 * light with them by multiple importance sampling. Where there are none, the estimate is L f cos
 * / (N p) alone. */
#ifndef LSF_PLAN_SKY_LIGHT_H
#define LSF_PLAN_SKY_LIGHT_H

#include "plan/option.h"
#include "plan/plan.h"
#include "scene/sky.h"
#include "scene/state.h"

typedef enum lsf_sky_light_control {
    LSF_SKY_LIGHT_SHARE,
    LSF_SKY_LIGHT_WHOLE,
} lsf_sky_light_control;

typedef struct lsf_sky_light_params {
    int32_t directions; /* drawn an iteration; 0: the environment is found by chance alone; below
                         * 0: 16 in the open, else 8 */
    int32_t open;       /* samples of its light without shadows, of each of two kinds in a pixel
                         * and iteration; 0: none; below 0: 64 in the open, unless light is kept from
                         * frame to frame, else 32 */
    int32_t control;    /* lsf_sky_light_control: how much of that light directions count on */
} lsf_sky_light_params;

#define LSF_SKY_LIGHT_PARAMS_DEFAULTS .directions = -1, .open = -1, .control = LSF_SKY_LIGHT_SHARE

#define LSF_SKY_LIGHT_OPTION_COUNT 3
extern const lsf_option_row lsf_sky_light_options[LSF_SKY_LIGHT_OPTION_COUNT];

/* What a light is used for: light that visible points receive from it directly, or light that
 * other surfaces reflect first. */
typedef enum lsf_light_use { LSF_LIGHT_STRAIGHT, LSF_LIGHT_BOUNCED, LSF_LIGHT_USES } lsf_light_use;

/* How a light of an iteration shares the environment's radiance from its direction with the ways
 * that find it by chance. */
typedef struct lsf_sky_share {
    float density;                /* of all directions of an iteration, lsf_sky_density [1/sr]; 0:
                                   * this light is no part of the environment */
    float shares[LSF_LIGHT_USES]; /* share that is left to this light; 1: all, as for any other
                                   * light */
    float kernel;                 /* m'/d of suppression [sr], see brdf_evaluate; 0: exact light */
} lsf_sky_share;

/* How many lights stand for the environment: none without an environment, or where nothing can
 * be lit. `open`: it is the only light, and surrounds the scene. */
uint32_t lsf_sky_light_count(const lsf_requirements *requirements,
                             const lsf_sky_light_params *params, bool open);

/* Whether `directions` of an iteration count on the environment's light without shadows. */
bool lsf_sky_light_is_controlled(uint32_t directions, const lsf_sky_light_params *params);

/* One of the `count` lights of an iteration, its direction drawn by `u`, two numbers in [0, 1). */
void lsf_sky_light_draw(lsf_light_state *light, lsf_sky_share *share, const lsf_sky *sky,
                        const double u[2], uint32_t count);

#endif
