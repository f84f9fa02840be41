/* Sides of voxels drawn by their radiance. See voxel_draw.md. */
#ifndef LSF_PASSES_VOXEL_DRAW_H
#define LSF_PASSES_VOXEL_DRAW_H

#include "frame/iteration.h"
#include "frame/voxel_grid.h"

typedef struct lsf_voxel_draw {
    lsf_context *context;
    GLuint list;   /* the output; shared/voxel_draw_data.h has the layout */
    GLuint bricks; /* a float for each brick of the grid */
    GLuint sum_program, scan_program, pick_program;
    uint32_t runs; /* in the current iteration */
    lsf_timer *timer;
} lsf_voxel_draw;

/* `sides`: slices of the radiance along z, 1 or LSF_VOXEL_SIDES_SURFACE; `emitters`: emission is
 * found by points drawn on emitters, and does not count. */
void lsf_voxel_draw_plan(lsf_plan *plan, const lsf_voxel_grid *grid, uint32_t sides, bool emitters);
bool lsf_voxel_draw_create(lsf_voxel_draw *pass, lsf_context *context, const lsf_plan *plan,
                           lsf_error *error);
/* To be called once an iteration: runs differ in what they draw. */
void lsf_voxel_draw_begin(lsf_voxel_draw *pass);
/* Draws by the `radiance` of voxels, RGBA16F, slices along z. */
void lsf_voxel_draw_run(lsf_voxel_draw *pass, const lsf_iteration *iteration,
                        const lsf_voxels *voxels, GLuint radiance);
void lsf_voxel_draw_destroy(lsf_voxel_draw *pass);

#endif
