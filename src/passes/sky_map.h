/* Shadow maps of directions of the environment, a batch at a time. See sky_map.md. */
#ifndef LSF_PASSES_SKY_MAP_H
#define LSF_PASSES_SKY_MAP_H

#include "frame/light_projection.h"
#include "frame/light_walls.h"
#include "shared/sky_map_data.h"

/* Layers of a batch, valid until the next run. */
typedef struct lsf_sky_map_outputs {
    lsf_shadow shadow;     /* keys of lib/sky_map.glsl; struct lsf_sky_map_data */
    uint32_t first, count; /* directions of the batch, of those that have a map of this kind */
    uint32_t whole;        /* how many of its maps hold the whole scene */
} lsf_sky_map_outputs;

/* Maps of one kind of window. */
typedef struct lsf_sky_map_target {
    GLuint map, depth, tint, buffer;
    GLuint framebuffer, tint_framebuffers[LSF_SKY_MAPS_MAX];
    struct lsf_sky_map_data *maps; /* of all directions of the iteration that have such a map */
    lsf_draw_region *regions;
    uint32_t *lights; /* their indices in the iteration */
    uint32_t count;
    uint32_t batch, side; /* layers; texels, 0: the plan has no such maps */
} lsf_sky_map_target;

typedef struct lsf_sky_map {
    lsf_context *context;
    lsf_sky_map_outputs outputs;
    lsf_sky_map_target seen, scene;   /* windows: what the camera sees; the whole scene */
    const lsf_sky_map_target *target; /* the one in turn */
    GLuint large_array;
    GLuint small_program, large_program, map_program; /* the last for what is not listed */
    GLuint straight_program, tint_program;            /* 0: no light passes surfaces */
    bool masked;
    uint64_t counts[LSF_DRAW_COUNTS];
    lsf_timer *timer;
} lsf_sky_map;

/* Lists the pass, and maps of what the camera sees, `side` texels along a side; 0: no such maps. */
void lsf_sky_map_plan(lsf_plan *plan, uint32_t side);
/* Adds maps that hold the whole scene, for points that the camera may not see. */
void lsf_sky_map_plan_scene(lsf_plan *plan, uint32_t side);
bool lsf_sky_map_create(lsf_sky_map *pass, lsf_context *context, const lsf_plan *plan,
                        const lsf_scene_gpu *scene, lsf_error *error);
/* To be called before the first batch of an iteration: projects its directions, each map rotated
 * and moved at random. */
void lsf_sky_map_begin(lsf_sky_map *pass, const lsf_iteration *iteration);
/* The same for maps of the whole scene, after those of what the camera sees, where the plan has
 * them: of directions whose map there does not serve. */
void lsf_sky_map_begin_scene(lsf_sky_map *pass, const lsf_iteration *iteration);
/* Draws the next batch; false when there is none. */
bool lsf_sky_map_next(lsf_sky_map *pass, const lsf_iteration *iteration);
void lsf_sky_map_destroy(lsf_sky_map *pass);

#endif
