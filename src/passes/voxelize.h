/* The scene as voxels: every voxel that a triangle touches, and the surface in it. See voxelize.md.
 */
#ifndef LSF_PASSES_VOXELIZE_H
#define LSF_PASSES_VOXELIZE_H

#include "plan/voxel_grid.h"

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

/* Valid until the next run. 3D textures of the grid's size, read with texelFetch; lib/voxel.glsl
 * says what is in them. Attributes are meaningful in occupied voxels only. */
typedef struct lsf_voxelize_outputs {
    GLuint grid_buffer;                           /* struct lsf_voxel_grid_data */
    GLuint occupancy[LSF_VOXEL_OCCUPANCY_LEVELS]; /* R32UI */
    GLuint albedo, point;                         /* R32UI */
    GLuint normal;                                /* R32UI; RG32UI where shading normals bend */
    GLuint emission;                              /* R32UI; 0 without emitting materials */
    GLuint gloss;                                 /* R32UI; 0 unless some material is glossy */
    GLuint transmission;                          /* R32UI; 0 unless light passes some material */
    GLuint bricks;                                /* occupied bricks; voxel_data.h has the layout */
    GLuint previous_bricks; /* those of the run before, where its readers' textures want clearing */
    bool changed;           /* since the run before */
} lsf_voxelize_outputs;

enum { LSF_VOXELIZE_INSTANCES, LSF_VOXELIZE_TRIANGLES, LSF_VOXELIZE_COUNTS };
extern const char *const lsf_voxelize_count_names[LSF_VOXELIZE_COUNTS];

typedef struct lsf_voxelize lsf_voxelize;

/* What a voxel takes in this pass's textures, for lsf_voxel_grid_fit [bytes]. `jitter`: the grid
 * moves. */
uint32_t lsf_voxelize_bytes(const lsf_plan *plan, bool jitter);
void lsf_voxelize_plan(lsf_plan *plan, const lsf_voxelize_params *params,
                       const lsf_voxel_grid *grid);
/* On failure *pass is what is to be destroyed. */
bool lsf_voxelize_create(lsf_voxelize **pass, lsf_context *context, const lsf_plan *plan,
                         const lsf_voxelize_params *params, const lsf_voxel_grid *grid,
                         const lsf_scene *scene, lsf_error *error);
/* Goes over to a grid of the same size and, with `anew`, to what materials have become. */
void lsf_voxelize_follow(lsf_voxelize *pass, const lsf_voxel_grid *grid, bool anew);
/* Voxelises what moved since the last run, and with a grid that is shifted all. Binds the grid at
 * LSF_BINDING_VOXEL. */
const lsf_voxelize_outputs *lsf_voxelize_run(lsf_voxelize *pass, const lsf_iteration *iteration);
lsf_timer *lsf_voxelize_timer(lsf_voxelize *pass);
const uint64_t *lsf_voxelize_counts(const lsf_voxelize *pass);
void lsf_voxelize_destroy(lsf_voxelize *pass); /* NULL allowed */

#endif
