/* Reflected direct light of punctual lights and of the environment. See direct_light.md. */
#ifndef LSF_PASSES_DIRECT_LIGHT_H
#define LSF_PASSES_DIRECT_LIGHT_H

#include "frame/light_projection.h"
#include "frame/maps.h"
#include "frame/sky_use.h"

typedef struct lsf_direct_light_inputs {
    const lsf_surface_maps *seen;
    const lsf_shadow *shadow;
    uint32_t first;              /* first of the directions, among those of the iteration */
    uint32_t directions;         /* number of the environment's directions in the shadow; 0: it
                                  * is a light's */
    const lsf_split_light *open; /* the environment's without shadows; NULL: nobody counts on it */
    GLuint lobes, narrow;        /* lsf_open_sky's; 0: there is none */
    float lobe_angle;            /* as in the G-buffer */
} lsf_direct_light_inputs;

typedef struct lsf_direct_light_use {
    bool shadow_pcf; /* shadows are filtered by percentage-closer filtering */
    lsf_sky_use sky;
} lsf_direct_light_use;

typedef struct lsf_direct_light {
    lsf_context *context;
    GLuint radiance;     /* output: RGBA32F, the sum over lights since lsf_direct_light_clear */
    lsf_split_light sky; /* output: light of the environment's directions where it is filtered, of
                          * which a pixel has its share of the pattern; else it is in `radiance` */
    GLuint
        control; /* RGBA32F array, what directions of either sequence have found; 0: nobody asks */
    GLuint sky_framebuffer;
    GLuint framebuffer, program, sky_program; /* 0: there are no such lights */
    lsf_direct_light_use use;
    lsf_timer *timer, *sky_timer;
} lsf_direct_light;

/* Plans `lights` punctual lights, and the plan's directions of the environment. */
void lsf_direct_light_plan(lsf_plan *plan, uint32_t lights, const lsf_direct_light_use *use);
/* `seen_depth`: the depth of the visible points, a texture that outlives the pass. */
bool lsf_direct_light_create(lsf_direct_light *pass, lsf_context *context, const lsf_plan *plan,
                             const lsf_direct_light_use *use, GLuint seen_depth, lsf_error *error);
void lsf_direct_light_clear(lsf_direct_light *pass);
/* Adds the light of the shadow: a punctual light's, or that of the directions. */
void lsf_direct_light_run(lsf_direct_light *pass, const lsf_iteration *iteration,
                          const lsf_direct_light_inputs *inputs);
void lsf_direct_light_destroy(lsf_direct_light *pass);

#endif
