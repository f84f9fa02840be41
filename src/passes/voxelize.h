/* The scene as voxels: every voxel that a triangle touches, and the surface in it. See voxelize.md.
 */
#ifndef LSF_PASSES_VOXELIZE_H
#define LSF_PASSES_VOXELIZE_H

#include "frame/voxel_grid.h"

typedef enum lsf_voxelize_method {
    LSF_VOXELIZE_COMPUTE, /* an exact triangle-box test */
    LSF_VOXELIZE_RASTER,  /* enlarged triangles on the raster pipeline */
} lsf_voxelize_method;

typedef struct lsf_voxelize_params {
    int32_t method; /* lsf_voxelize_method */
} lsf_voxelize_params;

#define LSF_VOXELIZE_PARAMS_DEFAULTS .method = LSF_VOXELIZE_COMPUTE

#define LSF_VOXELIZE_OPTION_COUNT 1
extern const lsf_option_row lsf_voxelize_options[LSF_VOXELIZE_OPTION_COUNT];

enum { LSF_VOXELIZE_INSTANCES, LSF_VOXELIZE_TRIANGLES, LSF_VOXELIZE_COUNTS };
extern const char *const lsf_voxelize_count_names[LSF_VOXELIZE_COUNTS];

typedef struct lsf_voxelize lsf_voxelize;

/* Bytes of a voxel in this pass's textures, for lsf_voxel_grid_fit. `jitter`: the grid moves. */
uint32_t lsf_voxelize_bytes(const lsf_plan *plan, bool jitter);
void lsf_voxelize_plan(lsf_plan *plan, const lsf_voxelize_params *params,
                       const lsf_voxel_grid *grid);
/* On failure *pass is to be destroyed. */
bool lsf_voxelize_create(lsf_voxelize **pass, lsf_context *context, const lsf_plan *plan,
                         const lsf_voxelize_params *params, const lsf_voxel_grid *grid,
                         const lsf_scene *scene, lsf_error *error);
/* Goes over to a grid of the same size and, with `anew`, to changed materials. */
void lsf_voxelize_follow(lsf_voxelize *pass, const lsf_voxel_grid *grid, bool anew);
/* Voxelises the instances that moved since the last run, and with a grid that is shifted all of
 * them. Its outputs are valid until the next run. */
const lsf_voxels *lsf_voxelize_run(lsf_voxelize *pass, const lsf_iteration *iteration);
lsf_timer *lsf_voxelize_timer(lsf_voxelize *pass);
const uint64_t *lsf_voxelize_counts(const lsf_voxelize *pass);
void lsf_voxelize_destroy(lsf_voxelize *pass); /* NULL allowed */

#endif
