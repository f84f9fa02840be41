/* How much of the direct light in view is each punctual light's, by which techniques choose the
 * lights whose light bounces. See light_importance.md. */
#ifndef LSF_PASSES_LIGHT_IMPORTANCE_H
#define LSF_PASSES_LIGHT_IMPORTANCE_H

#include "frame/iteration.h"

/* Frames whose measurements the host may read. */
#define LSF_LIGHT_IMPORTANCE_SLOTS 3

/* The measurement of a frame. */
typedef struct lsf_light_importance_slot {
    GLsync sent;     /* is signalled once its copy has arrived; NULL: nobody needs to wait */
    uint32_t serial; /* of the iteration that measured it, counted from 1; 0: there is none */
} lsf_light_importance_slot;

typedef struct lsf_light_importance {
    lsf_context *context;
    GLuint before; /* the sampled pixels' luminance before the light in turn */
    GLuint sums;   /* a float for each light */
    GLuint readback;
    const float *read; /* mapped: the sums of each slot */
    uint32_t light_count;
    lsf_light_importance_slot slots[LSF_LIGHT_IMPORTANCE_SLOTS]; /* frames in turn */
    uint32_t newest;                                             /* of the slots */
    GLuint program;
    lsf_timer *timer;
} lsf_light_importance;

/* Lists the pass where there is a choice: with several of the state's lights. */
void lsf_light_importance_plan(lsf_plan *plan, uint32_t light_count);
bool lsf_light_importance_create(lsf_light_importance *pass, lsf_context *context,
                                 const lsf_plan *plan, lsf_error *error);
/* Measures the light that was added last to `radiance` (RGBA32F, of what is seen), in the first
 * iteration of a frame; in others it does nothing. Lights come in order. */
void lsf_light_importance_run(lsf_light_importance *pass, const lsf_iteration *iteration,
                              uint32_t light, GLuint radiance);
/* Called once in an iteration, after its lights: a value for each light, in proportion to the light
 * of it that is seen; valid until the next call. NULL where nothing is known yet. The same values
 * for all runs of an iteration. */
const float *lsf_light_importance_read(lsf_light_importance *pass, const lsf_iteration *iteration);
void lsf_light_importance_destroy(lsf_light_importance *pass);

#endif
