/* Light from voxel to voxel: the light of others and of the environment that each one reflects.
 * See voxel_bounce.md. */
#ifndef LSF_PASSES_VOXEL_BOUNCE_H
#define LSF_PASSES_VOXEL_BOUNCE_H

#include "frame/cone.h"
#include "frame/emitter_points.h"

/* The terms of the sum; pyramids as of voxel_light.h. */
typedef struct lsf_voxel_bounce_sum {
    GLuint base;   /* added unchanged; 0: nothing */
    GLuint source; /* added after reflection; 0: nothing. It may be the output of the last run */
    GLuint lamps;  /* that smooth metals mirror, voxel_light.h; 0: none */
    bool lit;      /* the source contains the light of lamps */
    GLuint draws;  /* by the source, voxel_draw.h; 0 without cone.draws */
    const lsf_emitter_points *emitters; /* of the iteration; NULL unless lsf_cone_emitters */
    uint32_t later; /* number of times that voxels reflect the sum's light after this */
    bool keep;      /* the output of the last run is a part of the sum; not with a source */
} lsf_voxel_bounce_sum;

typedef struct lsf_voxel_bounce {
    lsf_context *context;
    lsf_cone_params params;
    lsf_voxel_grid grid;
    GLuint radiance[2]; /* as voxel_light's; only level 0 is written. The second is there for
                         * sources that the pass has written itself */
    uint32_t last;      /* that was written */
    uint32_t levels;    /* with 1 texels of empty voxels mean nothing */
    GLuint program, clear_program;
    lsf_timer *timer;
} lsf_voxel_bounce;

/* `of_own`: some source will be an output of the pass; `lamps`: there are voxels that keep one. */
void lsf_voxel_bounce_plan(lsf_plan *plan, const lsf_cone_params *params,
                           const lsf_voxel_grid *grid, bool of_own, bool lamps);
bool lsf_voxel_bounce_create(lsf_voxel_bounce *pass, lsf_context *context, const lsf_plan *plan,
                             const lsf_cone_params *params, const lsf_voxel_grid *grid,
                             lsf_error *error);
/* Clears the output of the run before. To be called once an iteration. */
void lsf_voxel_bounce_begin(lsf_voxel_bounce *pass, const lsf_voxels *voxels);
/* Returns the sum. */
GLuint lsf_voxel_bounce_run(lsf_voxel_bounce *pass, const lsf_iteration *iteration,
                            const lsf_voxels *voxels, const lsf_voxel_bounce_sum *sum);
void lsf_voxel_bounce_destroy(lsf_voxel_bounce *pass);

#endif
