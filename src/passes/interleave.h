/* Interleaved sampling: splits the G-buffer into tiles that each take samples of their own, puts
 * the light together again and filters it. See interleave.md. */
#ifndef LSF_PASSES_INTERLEAVE_H
#define LSF_PASSES_INTERLEAVE_H

#include "plan/iteration.h"
#include "plan/option.h"

typedef struct lsf_interleave_params {
    int32_t size;        /* tiles along a side of the pattern; 1: off */
    int32_t radius;      /* of the filter [pixels]; 0: off */
    float depth_weight;  /* how far from the pixel's plane light is taken from, relative ... */
    float normal_weight; /* exponent of the cosine between normals */
} lsf_interleave_params;

#define LSF_INTERLEAVE_PARAMS_DEFAULTS                                                             \
    .size = 1, .radius = 2, .depth_weight = 1.0f, .normal_weight = 32.0f

#define LSF_INTERLEAVE_OPTION_COUNT 4
extern const lsf_option_row lsf_interleave_options[LSF_INTERLEAVE_OPTION_COUNT];

/* Pixel (x, y) belongs to tile (x % size, y % size) and lies in the split buffers at the tile's
 * corner plus (x / size, y / size). */
typedef struct lsf_interleave_outputs {
    GLuint depth;                /* R32F */
    GLuint surface;              /* as in the G-buffer */
    GLuint gloss;                /* 0 where the G-buffer has none */
    GLuint irradiance, specular; /* RGBA32F, gathered and filtered */
} lsf_interleave_outputs;

typedef struct lsf_interleave_inputs {
    GLuint depth, surface, gloss; /* of the G-buffer */
    GLuint irradiance, specular;  /* in split order, RGBA32F; specular 0 when nothing is glossy */
} lsf_interleave_inputs;

typedef struct lsf_interleave {
    lsf_context *context;
    lsf_interleave_params params;
    lsf_interleave_outputs outputs;
    GLuint split_framebuffer, gather_framebuffer, filter_framebuffers[2];
    GLuint gathered[2], half_filtered[2];
    GLuint split_program, gather_program, filter_program;
    lsf_timer *split_timer, *gather_timer, *filter_timer;
} lsf_interleave;

/* The region of tile `index`, 0 to size * size - 1, row by row. With size 1: the whole picture. */
lsf_region lsf_interleave_region(const lsf_plan *plan, uint32_t size, uint32_t index);

/* Lists "interleave_split", "interleave_gather" and "interleave_filter". Only for size > 1. */
void lsf_interleave_plan(lsf_plan *plan, const lsf_interleave_params *params);
bool lsf_interleave_create(lsf_interleave *pass, lsf_context *context, const lsf_plan *plan,
                           const lsf_interleave_params *params, lsf_error *error);
void lsf_interleave_split(lsf_interleave *pass, const lsf_iteration *iteration,
                          const lsf_interleave_inputs *inputs);
/* Gathers and filters; sets outputs.irradiance and outputs.specular. */
void lsf_interleave_gather(lsf_interleave *pass, const lsf_iteration *iteration,
                           const lsf_interleave_inputs *inputs);
void lsf_interleave_destroy(lsf_interleave *pass);

#endif
