/* Tone mapping for 8-bit output. See tonemap.md. */
#ifndef LSF_PASSES_TONEMAP_H
#define LSF_PASSES_TONEMAP_H

#include "plan/iteration.h"

typedef struct lsf_tonemap {
    lsf_context *context;
    GLuint display; /* output: RGBA8, sRGB-encoded, row 0 at the top */
    GLuint framebuffer, program;
    uint32_t width, height;
    lsf_timer *timer;
} lsf_tonemap;

void lsf_tonemap_plan(lsf_plan *plan);
bool lsf_tonemap_create(lsf_tonemap *pass, lsf_context *context, const lsf_plan *plan,
                        lsf_error *error);
/* `exposure` in EV; `radiance` is a float texture of the plan's size. */
void lsf_tonemap_run(lsf_tonemap *pass, GLuint radiance, float exposure, lsf_tone_curve curve);
void lsf_tonemap_destroy(lsf_tonemap *pass);

#endif
