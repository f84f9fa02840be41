/* A variance-guided, edge-avoiding filter of mean light that vanishes as its noise does. See
 * light_filter.md. */
#ifndef LSF_PASSES_LIGHT_FILTER_H
#define LSF_PASSES_LIGHT_FILTER_H

#include "frame/iteration.h"
#include "frame/maps.h"
#include "plan/option.h"

/* The filter that removes noise from light. */
typedef enum lsf_light_filter_kind {
    LSF_LIGHT_FILTER_ATROUS,
    LSF_LIGHT_FILTER_NETWORK, /* goes on from there (passes/denoise.h) */
} lsf_light_filter_kind;

typedef struct lsf_light_filter_params {
    int32_t kind;       /* lsf_light_filter_kind */
    int32_t steps;      /* the last one's neighbours are 2^(steps - 1) pixels apart; 0: no filter */
    float tolerance;    /* standard deviations that count as noise */
    float depth_weight; /* pixels that a neighbour may be off the pixel's plane, for each pixel
                         * that it is away */
    float normal_weight; /* exponent of the cosine between normals */
    int32_t limit;       /* bool: the change is limited to what noise explains */
} lsf_light_filter_params;

#define LSF_LIGHT_FILTER_PARAMS_DEFAULTS                                                           \
    .kind = LSF_LIGHT_FILTER_ATROUS, .steps = 5, .tolerance = 2.0f, .depth_weight = 0.1f,          \
    .normal_weight = 32.0f, .limit = 1

#define LSF_LIGHT_FILTER_OPTION_COUNT 6
extern const lsf_option_row lsf_light_filter_options[LSF_LIGHT_FILTER_OPTION_COUNT];

/* Mean light and its factors, as in lsf_light_mean_part. */
typedef struct lsf_light_filter_part {
    GLuint light, factor;
} lsf_light_filter_part;

typedef struct lsf_light_filter_inputs {
    lsf_guide_maps guide;
    GLuint half; /* as lsf_light_mean's, of the first `half_count` iterations; 0: there is none */
    uint32_t half_count;
    GLuint picture;                 /* RGBA32F mean of the whole picture */
    lsf_light_filter_part parts[2]; /* diffuse, specular where materials have lobes */
} lsf_light_filter_inputs;

typedef struct lsf_light_filter {
    lsf_context *context;
    lsf_light_filter_params params;
    GLuint picture; /* output: RGBA32F; A: variance of luminance that is left, 0: none is known */
    /* Outputs, too: without tint, of the diffuse part and, where materials have lobes, of the
     * specular one; A: variance, below 0: it tells nothing. After the steps: */
    GLuint light[2], filtered[2]; /* `filtered` are two of the turns */
    GLuint lone;                  /* RG8, of both parts: marks of lib/light_lone.glsl */
    GLuint lost, lost_sums[2];    /* light taken out of lone pixels; by blocks, and its squares */
    GLuint ping_pong[2][2];       /* what the last step but one, and the last, made of both parts */
    GLuint light_framebuffer, ping_pong_framebuffers[2], divided_framebuffer, picture_framebuffer;
    GLuint lost_framebuffer, spread_framebuffer;
    GLuint divide, window, variance, step, change, blend, pool, spread; /* programs */
    lsf_timer *timer;
} lsf_light_filter;

void lsf_light_filter_plan(lsf_plan *plan, const lsf_light_filter_params *params);
bool lsf_light_filter_create(lsf_light_filter *pass, lsf_context *context, const lsf_plan *plan,
                             const lsf_light_filter_params *params, lsf_error *error);
/* Filters the mean of `iterations` iterations, the last of which was `iteration`: light without
 * tint. */
void lsf_light_filter_run(lsf_light_filter *pass, const lsf_iteration *iteration,
                          uint32_t iterations, const lsf_light_filter_inputs *inputs);
/* Makes the picture of it, or of `filtered` as another pass has changed it. */
void lsf_light_filter_finish(lsf_light_filter *pass, const lsf_iteration *iteration,
                             uint32_t iterations, const lsf_light_filter_inputs *inputs,
                             const GLuint filtered[2]);
void lsf_light_filter_destroy(lsf_light_filter *pass);

#endif
