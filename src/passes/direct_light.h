/* Reflected direct light of punctual lights. See direct_light.md. */
#ifndef LSF_PASSES_DIRECT_LIGHT_H
#define LSF_PASSES_DIRECT_LIGHT_H

#include "plan/iteration.h"

typedef struct lsf_direct_light_inputs {
    GLuint depth, surface, gloss;         /* of the G-buffer */
    GLuint shadow_depth, shadow_gradient,
        shadow_tint; /* of the light in turn, whose buffer is bound */
} lsf_direct_light_inputs;

typedef struct lsf_direct_light {
    lsf_context *context;
    GLuint radiance; /* output: RGBA32F, the sum over lights since lsf_direct_light_clear */
    GLuint framebuffer, program;
    lsf_timer *timer;
} lsf_direct_light;

/* `shadow_pcf`: shadows are filtered by percentage-closer filtering. */
void lsf_direct_light_plan(lsf_plan *plan, bool shadow_pcf);
bool lsf_direct_light_create(lsf_direct_light *pass, lsf_context *context, const lsf_plan *plan,
                             lsf_error *error);
void lsf_direct_light_clear(lsf_direct_light *pass);
/* Adds the light whose shadow map was drawn last. */
void lsf_direct_light_run(lsf_direct_light *pass, const lsf_iteration *iteration,
                          const lsf_direct_light_inputs *inputs);
void lsf_direct_light_destroy(lsf_direct_light *pass);

#endif
