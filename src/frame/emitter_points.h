/* Points on emissive surfaces, drawn by their power anew in each iteration, for
 * lib/emitter.glsl: one for each cell of a square, so that readers with stratified numbers take
 * stratified points. */
#ifndef LSF_FRAME_EMITTER_POINTS_H
#define LSF_FRAME_EMITTER_POINTS_H

#include "frame/iteration.h"
#include "frame/upload.h"
#include "scene/emitters.h"
#include "shared/emitter_data.h"

#define LSF_EMITTER_POINTS (LSF_EMITTER_CELLS * LSF_EMITTER_CELLS)

typedef struct lsf_emitter_points {
    lsf_emitters list;
    lsf_upload upload; /* no buffer: there are none */
} lsf_emitter_points;

/* Lists their buffers, under a name of the pass. */
void lsf_emitter_points_plan(lsf_plan *plan, const char *name);
bool lsf_emitter_points_create(lsf_emitter_points *points, lsf_context *context,
                               const lsf_plan *plan, const char *name, const lsf_scene *scene,
                               const lsf_state *state, lsf_error *error);
/* Updates the emitters to the current state. False without memory. */
bool lsf_emitter_points_follow(lsf_emitter_points *points, bool materials_edited);
/* Binds the points, and sets the uniform of lib/voxel_emitter.glsl for the program in use; `count`:
 * points for each vertex. */
void lsf_emitter_points_bind(const lsf_emitter_points *points, int32_t count);
/* Draws the iteration's points, by a sequence of `purpose`, and binds them. False: the emitters
 * have no area, and nothing is drawn. */
bool lsf_emitter_points_draw(lsf_emitter_points *points, const lsf_iteration *iteration,
                             uint32_t purpose);
void lsf_emitter_points_destroy(lsf_emitter_points *points, lsf_context *context);

#endif
