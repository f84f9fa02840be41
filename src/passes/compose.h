/* The picture as the sum of what is seen itself and what is reflected. See compose.md. */
#ifndef LSF_PASSES_COMPOSE_H
#define LSF_PASSES_COMPOSE_H

#include "plan/iteration.h"
#include "plan/maps.h"

typedef struct lsf_compose_inputs {
    const lsf_gbuffer_maps *gbuffer;
    GLuint direct; /* RGBA32F radiance; 0: none */
    lsf_split_light indirect;
    lsf_split_light split_direct; /* direct light beside that in `direct` */
} lsf_compose_inputs;

/* What there is to add up. */
typedef struct lsf_compose_use {
    bool direct;       /* radiance of punctual lights */
    bool indirect;     /* irradiance, and with specular lobes their radiance */
    bool split_direct; /* the same of direct light apart */
} lsf_compose_use;

/* RGBA32F. Layers are 0 unless asked for and different from an input. */
typedef struct lsf_compose {
    lsf_context *context;
    GLuint radiance;
    GLuint coverage;          /* 1 where a surface is, else 0 */
    GLuint seen;              /* emission and environment alone */
    GLuint indirect_diffuse;  /* irradiance reflected */
    GLuint direct;            /* all kinds of direct light */
    GLuint indirect_specular; /* tinted */
    GLuint framebuffer, program;
    lsf_timer *timer;
} lsf_compose;

void lsf_compose_plan(lsf_plan *plan, const lsf_compose_use *use);
bool lsf_compose_create(lsf_compose *pass, lsf_context *context, const lsf_plan *plan,
                        lsf_error *error);
void lsf_compose_run(lsf_compose *pass, const lsf_iteration *iteration,
                     const lsf_compose_inputs *inputs);
void lsf_compose_destroy(lsf_compose *pass);

#endif
