/* The voxels as the camera sees them: layers to look at. See voxel_view.md. */
#ifndef LSF_PASSES_VOXEL_VIEW_H
#define LSF_PASSES_VOXEL_VIEW_H

#include "frame/voxel_grid.h"

/* RGBA32F, 0 where nothing is seen; 0 (the name) unless asked for. */
typedef struct lsf_voxel_view_outputs {
    GLuint albedo, normal, radiance;
} lsf_voxel_view_outputs;

typedef struct lsf_voxel_view {
    lsf_context *context;
    lsf_voxel_view_outputs outputs;
    GLuint framebuffer, program;
    lsf_timer *timer;
} lsf_voxel_view;

/* Whether a layer of voxels is asked for. */
bool lsf_voxel_view_needed(const lsf_plan *plan);
/* `sides` of the voxels' radiance. */
void lsf_voxel_view_plan(lsf_plan *plan, uint32_t sides);
bool lsf_voxel_view_create(lsf_voxel_view *pass, lsf_context *context, const lsf_plan *plan,
                           lsf_error *error);
void lsf_voxel_view_run(lsf_voxel_view *pass, const lsf_iteration *iteration,
                        const lsf_voxels *voxels, GLuint radiance);
void lsf_voxel_view_destroy(lsf_voxel_view *pass);

#endif
