/* The picture as the sum of what is seen itself and what is reflected. See compose.md. */
#ifndef LSF_PASSES_COMPOSE_H
#define LSF_PASSES_COMPOSE_H

#include "plan/iteration.h"

typedef struct lsf_compose_inputs {
    GLuint depth, emission; /* of the G-buffer; emission 0: none */
    GLuint direct;          /* RGBA32F radiance; 0: none */
} lsf_compose_inputs;

typedef struct lsf_compose {
    lsf_context *context;
    GLuint radiance; /* output: RGBA32F */
    GLuint seen;     /* output: RGBA32F, emission and environment alone; 0 unless asked for */
    GLuint framebuffer, program;
    lsf_timer *timer;
} lsf_compose;

void lsf_compose_plan(lsf_plan *plan, bool direct);
bool lsf_compose_create(lsf_compose *pass, lsf_context *context, const lsf_plan *plan,
                        lsf_error *error);
void lsf_compose_run(lsf_compose *pass, const lsf_iteration *iteration,
                     const lsf_compose_inputs *inputs);
void lsf_compose_destroy(lsf_compose *pass);

#endif
