/* Interleaved sampling: splits the G-buffer into tiles that each take samples of their own, puts
 * the light together again and filters it. See interleave.md. */
#ifndef LSF_PASSES_INTERLEAVE_H
#define LSF_PASSES_INTERLEAVE_H

#include "frame/iteration.h"
#include "frame/maps.h"
#include "plan/option.h"

typedef struct lsf_interleave_params {
    int32_t size;       /* tiles along a side of the pattern; 1: off */
    int32_t periods;    /* of the pattern that the filter is wide; 0: no filter */
    float depth_weight; /* pixels that a neighbour may be off the pixel's plane, for each pixel that
                         * it is away */
    float normal_weight; /* exponent of the cosine between normals */
} lsf_interleave_params;

#define LSF_INTERLEAVE_PARAMS_DEFAULTS                                                             \
    .size = 0, .periods = 0, .depth_weight = 0.5f, .normal_weight = 32.0f

#define LSF_INTERLEAVE_OPTION_COUNT 4
extern const lsf_option_row lsf_interleave_options[LSF_INTERLEAVE_OPTION_COUNT];

typedef struct lsf_interleave {
    lsf_context *context;
    lsf_interleave_params params;
    lsf_surface_maps split; /* output */
    lsf_split_light light;  /* output, in the picture's order, filtered */
    lsf_split_light between;
    GLuint split_framebuffer, light_framebuffer, between_framebuffer;
    GLuint split_program, gather_program, filter_program;
    lsf_timer *split_timer, *gather_timer, *filter_timer;
} lsf_interleave;

/* The region of tile `index`, 0 to size * size - 1, row by row: pixel (x, y) belongs to tile
 * (x % size, y % size) and lies at the tile's corner plus (x / size, y / size). A region is empty
 * when the picture is smaller than the pattern. */
lsf_region lsf_interleave_region(const lsf_plan *plan, uint32_t size, uint32_t index);

/* Lists "interleave_split", "interleave_gather" and "interleave_filter", for a size above 1. */
void lsf_interleave_plan(lsf_plan *plan, const lsf_interleave_params *params);
bool lsf_interleave_create(lsf_interleave *pass, lsf_context *context, const lsf_plan *plan,
                           const lsf_interleave_params *params, lsf_error *error);
/* Sets `split` from what the G-buffer has seen. */
void lsf_interleave_split(lsf_interleave *pass, const lsf_iteration *iteration,
                          const lsf_surface_maps *seen);
/* Sets `light` from light in split order. */
void lsf_interleave_gather(lsf_interleave *pass, const lsf_iteration *iteration,
                           const lsf_surface_maps *seen, const lsf_split_light *split_light);
void lsf_interleave_destroy(lsf_interleave *pass);

#endif
