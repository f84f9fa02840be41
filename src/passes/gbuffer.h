/* G-buffer: the surface in each pixel. See gbuffer.md. */
#ifndef LSF_PASSES_GBUFFER_H
#define LSF_PASSES_GBUFFER_H

#include "frame/iteration.h"
#include "frame/maps.h"
#include "plan/option.h"

typedef struct lsf_gbuffer_params {
    float
        texture_lod_bias; /* added to the level of colour textures that the iteration count gives */
    float frame_time;     /* seconds; motion is measured from this much earlier */
    int32_t side;         /* sample points along a pixel's side: one more than the logarithm; 0: by
                           * the plan */
} lsf_gbuffer_params;

#define LSF_GBUFFER_PARAMS_DEFAULTS .texture_lod_bias = 0.0f, .frame_time = 1.0f / 60.0f, .side = 0

#define LSF_GBUFFER_OPTION_COUNT 3
extern const lsf_option_row lsf_gbuffer_options[LSF_GBUFFER_OPTION_COUNT];

typedef struct lsf_gbuffer {
    lsf_context *context;
    lsf_gbuffer_maps outputs; /* of the plan's size, valid until the next run */
    GLuint framebuffer, program;
    GLuint tint_framebuffer, tint_program; /* 0: nothing transmits */
    GLuint far_framebuffer, far_program;   /* 0: no medium is refracted */
    float lobe_angle; /* solid angle that the technique spreads a lobe over [sr]; 0: it spreads
                       * none. It decides how much rough walls scatter (lib/straight.glsl) */
    uint64_t counts[LSF_DRAW_COUNTS];
    lsf_timer *timer;
} lsf_gbuffer;

/* Lists the pass and its textures. */
void lsf_gbuffer_plan(lsf_plan *plan);
bool lsf_gbuffer_create(lsf_gbuffer *pass, lsf_context *context, const lsf_plan *plan,
                        const lsf_gbuffer_params *params, const lsf_scene_gpu *scene,
                        lsf_error *error);
void lsf_gbuffer_run(lsf_gbuffer *pass, const lsf_iteration *iteration);
void lsf_gbuffer_destroy(lsf_gbuffer *pass);

#endif
