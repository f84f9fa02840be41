/* The picture as the sum of emission and reflected light. See compose.md. */
#ifndef LSF_PASSES_COMPOSE_H
#define LSF_PASSES_COMPOSE_H

#include "frame/iteration.h"
#include "frame/maps.h"

/* The parts to add up. */
typedef struct lsf_compose_use {
    bool direct;       /* radiance of punctual lights */
    bool indirect;     /* irradiance, and with specular lobes their radiance */
    bool split_direct; /* the same of direct light apart */
} lsf_compose_use;

/* RGBA32F; all but the picture are 0 unless asked for. */
typedef struct lsf_composed {
    GLuint picture;
    GLuint coverage;          /* 1 where a surface is, else 0 */
    GLuint emission;          /* emission of visible surfaces and the environment */
    GLuint direct;            /* all kinds of direct light */
    GLuint indirect_diffuse;  /* irradiance reflected */
    GLuint indirect_specular; /* tinted */
} lsf_composed;

typedef struct lsf_compose {
    lsf_context *context;
    lsf_composed outputs; /* outputs of the last run: textures of its own, and inputs that are a
                           * layer */
    lsf_composed own;
    GLuint framebuffer, program;
    lsf_timer *timer;
} lsf_compose;

void lsf_compose_plan(lsf_plan *plan, const lsf_compose_use *use);
bool lsf_compose_create(lsf_compose *pass, lsf_context *context, const lsf_plan *plan,
                        lsf_error *error);
void lsf_compose_run(lsf_compose *pass, const lsf_iteration *iteration,
                     const lsf_light_parts *parts);
void lsf_compose_destroy(lsf_compose *pass);

#endif
