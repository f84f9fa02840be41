/* A grid of fewer texels than the picture has pixels, on which light is traced before it is
 * upsampled: each texel stands for a block of pixels and sees exactly what one of them sees,
 * another one each iteration. Its shaders' half is lib/coarse.glsl. */
#ifndef LSF_FRAME_COARSE_GRID_H
#define LSF_FRAME_COARSE_GRID_H

#include "frame/iteration.h"

/* Along an axis of `length` pixels, texel t stands for the pixels from t length / size up to
 * (t + 1) length / size, rounded down, and sees the one at offset / 2^16 of these. */
typedef struct lsf_coarse_grid {
    uint32_t width, height;
    uint32_t offset[2];
    bool coarse; /* has fewer texels than the picture; else texels are pixels */
} lsf_coarse_grid;

/* Texels along an axis of `length` pixels at a scale in (0, 1]. */
uint32_t lsf_coarse_grid_length(uint32_t length, float scale);
/* Whether a grid of that size is coarse. Neither side may be larger than the picture's. */
bool lsf_coarse_grid_is_coarse(const lsf_plan *plan, uint32_t width, uint32_t height);
/* Adds the switch LSF_COARSE to the pass added last. */
void lsf_coarse_grid_switch(lsf_plan *plan, uint32_t width, uint32_t height);
/* The grid of the iteration in progress. */
lsf_coarse_grid lsf_coarse_grid_at(const lsf_iteration *iteration, uint32_t width, uint32_t height);
/* Sets it for the program in use. */
void lsf_coarse_grid_set(const lsf_coarse_grid *grid);

#endif
