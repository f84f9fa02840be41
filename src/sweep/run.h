/* Renders and measures the pictures of a point. */
#ifndef LSF_SWEEP_RUN_H
#define LSF_SWEEP_RUN_H

#include <lightsheaf/lightsheaf.h>

#include "sweep/measurement.h"

/* The common inputs of all points of a measurement; borrowed. */
typedef struct lsf_sweep_stage {
    lsf_context *context;
    const lsf_scene *scene;
    lsf_render_params params;   /* technique, samples, seed and options are each point's */
    const lsf_image *halves[2]; /* of the reference: R, G, B */
    float exposure;             /* EV, of SSIM and of previews */
    lsf_clock clock;
    const char *folder;          /* for the pictures; NULL: they are not written */
    void (*advance)(void *user); /* called after each iteration; NULL allowed */
    bool (*go_on)(void *user);   /* whether to continue; called often. NULL: always */
    void *user;
} lsf_sweep_stage;

/* Renders frames of a configuration with so many samples from `seeds` seeds, starting with the
 * stage's, and measures them. Each frame follows another one of the same renderer, so that
 * nothing is allocated or compiled in it. Adds a point to the measurement unless it was told to
 * stop, which leaves *stopped true. */
bool lsf_sweep_run_point(const lsf_sweep_stage *stage, lsf_measurement *measurement,
                         uint32_t configuration, uint32_t samples, uint32_t seeds, bool *stopped,
                         lsf_error *error);

#endif
