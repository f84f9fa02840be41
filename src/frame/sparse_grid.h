/* The points at which indirect light is gathered: every n-th pixel of the picture along both
 * axes, others in each iteration. Once all pixels have been gathered n is halved, down to 1, so
 * that the mean converges to that of all pixels. See src/passes/sparse.md. */
#ifndef LSF_FRAME_SPARSE_GRID_H
#define LSF_FRAME_SPARSE_GRID_H

#include <stdint.h>

#include "plan/plan.h"

/* Point (x, y) is at pixel (x, y) stride + phase; past the picture's border there is no point. */
typedef struct lsf_sparse_grid {
    uint32_t stride;        /* pixels, a power of two; 1: points are pixels */
    uint32_t width, height; /* points */
    uint32_t phase[2];      /* below the stride, and within the picture */
    /* Layers of points. The second one, above the first, has for each point another pixel of the
     * same block of stride x stride whose surface no point shows; it does not exist at stride 1. */
    uint32_t layers;
} lsf_sparse_grid;

/* The stride to which the plan's stride falls within so many iterations (UINT32_MAX: any
 * number). */
uint32_t lsf_sparse_grid_finest(uint32_t stride, uint32_t iterations);
/* Whether some iteration has fewer points than pixels. */
bool lsf_sparse_grid_is_sparse(const lsf_plan *plan);
/* Whether points are one of several sample points of each pixel, drawn anew in each iteration: what
 * they gather stands for the pixel, and nothing is upsampled. */
bool lsf_sparse_grid_is_of_pixels(const lsf_plan *plan);
/* Width and height of textures that hold both layers in every iteration; those of the picture
 * where the plan is not sparse. */
void lsf_sparse_grid_texture_size(const lsf_plan *plan, uint32_t size[2]);
/* The same for one layer. */
void lsf_sparse_grid_points(const lsf_plan *plan, uint32_t size[2]);
/* Adds the switch LSF_SPARSE to the pass added last. */
void lsf_sparse_grid_switch(lsf_plan *plan);
/* Adds LSF_PIXEL_SIDE, where it is above 1. */
void lsf_sparse_grid_pixel_switch(lsf_plan *plan);
/* Adds LSF_INTERLEAVE to the pass added last: whether it follows a pattern of interleaved samples
 * of this side, which the plan then keeps for lsf_view_data; 1: it follows none. */
void lsf_interleave_switch(lsf_plan *plan, uint32_t size);
/* Sets the uniforms of lib/sparse_grid.glsl in the program in use, where the plan is sparse. */
void lsf_sparse_grid_set(const lsf_plan *plan, const lsf_sparse_grid *grid);
/* The grid of the frame's iteration number `done`; `index` counts over all frames, so that
 * frames of a few iterations take other phases than the frames before. `seed` permutes the
 * phases. */
lsf_sparse_grid lsf_sparse_grid_at(const lsf_plan *plan, uint32_t done, uint32_t index,
                                   uint32_t seed);

#endif
