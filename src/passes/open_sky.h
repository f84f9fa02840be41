/* Light of the environment as if nothing stood before it, for sky_light to count on. See
 * open_sky.md. */
#ifndef LSF_PASSES_OPEN_SKY_H
#define LSF_PASSES_OPEN_SKY_H

#include "frame/iteration.h"
#include "frame/maps.h"
#include "frame/sky_use.h"
#include "frame/upload.h"
#include "frame/voxel_grid.h"
#include "shared/open_sky_data.h"

typedef struct lsf_open_sky {
    lsf_context *context;
    lsf_split_light light; /* output: of the iteration */
    GLuint lobes;          /* output: how much of narrow lobes leaves the scene; 0: nobody asks */
    GLuint narrow;         /* output: specular light, the part that those rays decide on */
    lsf_upload drawn;      /* LSF_OPEN_SKY_DRAWN directions */
    GLuint drawn_fetch;    /* buffer texture of the same */
    uint32_t samples;      /* of each kind */
    lsf_sky_use use;
    GLuint framebuffer, program;
    lsf_timer *timer; /* NULL: there is no such pass */
} lsf_open_sky;

/* Nothing without directions of the environment, or where `samples`, of each kind in a pixel and
 * iteration, are 0. `use` is that of the light that they share. */
void lsf_open_sky_plan(lsf_plan *plan, const lsf_sky_use *use);
/* `seen_depth`: the depth of the visible points, a texture that outlives the pass. */
bool lsf_open_sky_create(lsf_open_sky *pass, lsf_context *context, const lsf_plan *plan,
                         const lsf_sky_use *use, GLuint seen_depth, lsf_error *error);
/* `control`: lsf_direct_light's; `voxels`: what lobes ask, where the use says so. */
void lsf_open_sky_run(lsf_open_sky *pass, const lsf_iteration *iteration,
                      const lsf_surface_maps *seen, GLuint control, const lsf_voxels *voxels);
void lsf_open_sky_destroy(lsf_open_sky *pass);

#endif
