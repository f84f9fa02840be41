/* Running means of the parts of reflected light over iterations, with their variance and the
 * reflectance that tinted them, for filters that work on light without its tint. See
 * light_mean.md. */
#ifndef LSF_PASSES_LIGHT_MEAN_H
#define LSF_PASSES_LIGHT_MEAN_H

#include "frame/iteration.h"
#include "frame/maps.h"

/* The parts of light that exist. */
typedef struct lsf_light_mean_use {
    bool indirect, split_direct, sky;
} lsf_light_mean_use;

/* RGBA32F, of the picture's size. */
typedef struct lsf_light_mean_part {
    GLuint light;  /* R, G, B: mean radiance towards the eye; A: sum of squared deviations of its
                    * luminance from the mean */
    GLuint factor; /* mean factor from light without tint to that radiance; A of the specular
                    * part: roughness */
} lsf_light_mean_part;

typedef struct lsf_light_mean {
    lsf_context *context;
    lsf_light_mean_part diffuse, specular; /* outputs; specular 0 where nothing is glossy */
    GLuint
        guide;   /* output: mean shading normal, 0 where nothing is seen; A: mean reverse-Z depth */
    GLuint half; /* output: RG32F, luminance of the diffuse and the specular mean of the first
                  * lsf_light_mean_half iterations */
    GLuint framebuffer, program;
    lsf_timer *timer;
} lsf_light_mean;

/* The largest power of two below `iterations`; 0 for one. */
uint32_t lsf_light_mean_half(uint32_t iterations);

void lsf_light_mean_plan(lsf_plan *plan, const lsf_light_mean_use *use);
bool lsf_light_mean_create(lsf_light_mean *pass, lsf_context *context, const lsf_plan *plan,
                           lsf_error *error);
/* Adds an iteration's parts except `direct`; `gate` is as for lsf_accumulate_run. */
void lsf_light_mean_run(lsf_light_mean *pass, const lsf_iteration *iteration,
                        const lsf_light_parts *parts, GLuint gate);
void lsf_light_mean_destroy(lsf_light_mean *pass);

#endif
