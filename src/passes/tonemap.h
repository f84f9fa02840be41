/* Tone mapping for 8-bit output. See tonemap.md. */
#ifndef LSF_PASSES_TONEMAP_H
#define LSF_PASSES_TONEMAP_H

#include "frame/iteration.h"

typedef struct lsf_tonemap {
    lsf_context *context;
    GLuint display; /* output: RGBA8, sRGB-encoded, row 0 at the top; 0 where only windows are
                     * drawn to */
    GLuint framebuffer, program;
    uint32_t width, height;
    lsf_timer *timer;
} lsf_tonemap;

/* `rgb8`: with the output `display`. */
void lsf_tonemap_plan(lsf_plan *plan, bool rgb8);
bool lsf_tonemap_create(lsf_tonemap *pass, lsf_context *context, const lsf_plan *plan, bool rgb8,
                        lsf_error *error);
/* `exposure` in EV; `radiance` is a float texture of the plan's size. */
void lsf_tonemap_run(lsf_tonemap *pass, GLuint radiance, float exposure, lsf_tone_curve curve);
/* The same to a framebuffer of the caller's, scaled to a part of it: x, y, width and height in
 * pixels from its lower left corner. */
void lsf_tonemap_present(lsf_tonemap *pass, GLuint radiance, GLuint framebuffer,
                         const int32_t viewport[4], float exposure, lsf_tone_curve curve);
void lsf_tonemap_destroy(lsf_tonemap *pass);

#endif
