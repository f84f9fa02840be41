/* Reflected direct light of punctual lights and of the environment. See direct_light.md. */
#ifndef LSF_PASSES_DIRECT_LIGHT_H
#define LSF_PASSES_DIRECT_LIGHT_H

#include "frame/light_map.h"
#include "frame/maps.h"

typedef struct lsf_direct_light_inputs {
    const lsf_surface_maps *seen;
    const lsf_shadow *shadow;
    uint32_t first;      /* of the directions, among those of the iteration */
    uint32_t directions; /* of the environment that the shadow is of; 0: it is of a light */
    float lobe_angle;    /* as the G-buffer has it */
} lsf_direct_light_inputs;

/* What else finds the environment from a visible point, by chance: its light is shared with that.
 */
typedef enum lsf_sky_chance {
    LSF_SKY_CHANCE_NONE,    /* nothing that the light's own share does not know of */
    LSF_SKY_CHANCE_PATHS,   /* paths drawn by the whole BRDF */
    LSF_SKY_CHANCE_LOBES,   /* diffuse rays by the cosine, and one by the specular lobe */
    LSF_SKY_CHANCE_DIFFUSE, /* diffuse rays; the specular lobe does without this pass */
} lsf_sky_chance;

typedef struct lsf_direct_light_use {
    bool shadow_pcf; /* shadows are filtered by percentage-closer filtering */
    lsf_sky_chance chance;
    float paths[2]; /* of chance: their number at roughness 0 and 1, rounded between */
} lsf_direct_light_use;

typedef struct lsf_direct_light {
    lsf_context *context;
    GLuint radiance;     /* output: RGBA32F, the sum over lights since lsf_direct_light_clear */
    lsf_split_light sky; /* output: light of the environment's directions where it is filtered, of
                          * which a pixel has its share of the pattern; else it is in `radiance` */
    GLuint sky_framebuffer;
    GLuint framebuffer, program, sky_program; /* 0: there are no such lights */
    lsf_direct_light_use use;
    lsf_timer *timer, *sky_timer;
} lsf_direct_light;

/* Beside `lights` punctual ones, the plan's directions of the environment. */
void lsf_direct_light_plan(lsf_plan *plan, uint32_t lights, const lsf_direct_light_use *use);
bool lsf_direct_light_create(lsf_direct_light *pass, lsf_context *context, const lsf_plan *plan,
                             const lsf_direct_light_use *use, lsf_error *error);
void lsf_direct_light_clear(lsf_direct_light *pass);
/* Adds the light, or the directions. */
void lsf_direct_light_run(lsf_direct_light *pass, const lsf_iteration *iteration,
                          const lsf_direct_light_inputs *inputs);
void lsf_direct_light_destroy(lsf_direct_light *pass);

#endif
