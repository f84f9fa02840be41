/* The pyramid of radiance over the voxels, which cones read at a distance. See voxel_mip.md. */
#ifndef LSF_PASSES_VOXEL_MIP_H
#define LSF_PASSES_VOXEL_MIP_H

#include "frame/voxel_grid.h"

typedef struct lsf_voxel_mip {
    lsf_context *context;
    lsf_voxel_grid grid;
    uint32_t sides;
    GLuint clear_program, fine_program, brick_program, whole_program;
    lsf_timer *timer;
} lsf_voxel_mip;

/* `sides` slices along z: 1, or LSF_VOXEL_SIDES_AXES. */
void lsf_voxel_mip_plan(lsf_plan *plan, uint32_t sides);
bool lsf_voxel_mip_create(lsf_voxel_mip *pass, lsf_context *context, const lsf_plan *plan,
                          const lsf_voxel_grid *grid, uint32_t sides, lsf_error *error);
/* `radiance`: RGBA16F, LSF_VOXEL_LEVELS levels. Level 0 is read; the others, which must be empty
 * before the first run, are written. */
void lsf_voxel_mip_run(lsf_voxel_mip *pass, const lsf_voxels *voxels, GLuint radiance);
void lsf_voxel_mip_destroy(lsf_voxel_mip *pass);

#endif
