/* Light that visible points gather by cones through voxels. See cone_trace.md. */
#ifndef LSF_PASSES_CONE_TRACE_H
#define LSF_PASSES_CONE_TRACE_H

#include "frame/cone.h"
#include "frame/emitter_points.h"
#include "frame/iteration.h"
#include "frame/maps.h"

typedef struct lsf_cone_trace_inputs {
    const lsf_surface_maps *seen; /* by points */
    const lsf_voxels *voxels;
    GLuint radiance;                    /* the pyramid over them; voxel_light.h, voxel_mip.h */
    GLuint lamps;                       /* that smooth metals mirror, voxel_light.h; 0: none */
    GLuint draws;                       /* by it, voxel_draw.h; 0 without cone.draws */
    const lsf_emitter_points *emitters; /* of the iteration; NULL unless lsf_cone_emitters */
} lsf_cone_trace_inputs;

typedef struct lsf_cone_trace {
    lsf_context *context;
    lsf_cone_params params;
    lsf_voxel_grid grid;
    /* Output, at the points' places. Alpha of irradiance: ambient visibility, the share of the
     * hemisphere, weighted by its cosine, in which no voxel is met. */
    lsf_split_light light;
    GLuint lobe_albedo; /* RG32F by cosine of the view and roughness */
    GLuint framebuffer, program;
    bool mirrors;
    lsf_timer *timer;
} lsf_cone_trace;

/* `mirrors`: rays of specular lobes find what metals mirror; only where cones are sealed and light
 * bounces twice or more; `lamps`: there are voxels that keep one. */
void lsf_cone_trace_plan(lsf_plan *plan, const lsf_cone_params *params, bool mirrors, bool lamps);
bool lsf_cone_trace_create(lsf_cone_trace *pass, lsf_context *context, const lsf_plan *plan,
                           const lsf_cone_params *params, const lsf_voxel_grid *grid,
                           lsf_error *error);
void lsf_cone_trace_run(lsf_cone_trace *pass, const lsf_iteration *iteration,
                        const lsf_cone_trace_inputs *inputs);
void lsf_cone_trace_destroy(lsf_cone_trace *pass);

#endif
