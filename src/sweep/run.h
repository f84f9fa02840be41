/* Making and measuring the pictures of a point. */
#ifndef LSF_SWEEP_RUN_H
#define LSF_SWEEP_RUN_H

#include <lightsheaf/lightsheaf.h>

#include "sweep/measurement.h"

/* What all points of a measurement have in common; borrowed. */
typedef struct lsf_sweep_stage {
    lsf_context *context;
    const lsf_scene *scene;
    lsf_render_params params;   /* technique, samples, seed and options are each point's */
    const lsf_image *halves[2]; /* of the reference: R, G, B */
    float exposure;             /* EV, of SSIM and of previews */
    lsf_clock clock;
    const char *folder;          /* where pictures go; NULL: nowhere */
    void (*advance)(void *user); /* called after each iteration; NULL: nobody wants to know */
    bool (*go_on)(void *user);   /* whether to; asked often. NULL: always */
    void *user;
} lsf_sweep_stage;

/* Renders a configuration's frames of so many samples from `seeds` seeds, from the stage's on, and
 * measures them. Each frame comes after another one of the same renderer, so that nothing is
 * allocated or compiled in it. Adds a point to the measurement unless it was told to stop, which
 * leaves *stopped true. */
bool lsf_sweep_run_point(const lsf_sweep_stage *stage, lsf_measurement *measurement,
                         uint32_t configuration, uint32_t samples, uint32_t seeds, bool *stopped,
                         lsf_error *error);

#endif
