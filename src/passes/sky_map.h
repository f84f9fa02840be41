/* Shadow maps of directions of the environment, a batch at a time. See sky_map.md. */
#ifndef LSF_PASSES_SKY_MAP_H
#define LSF_PASSES_SKY_MAP_H

#include "frame/light_projection.h"
#include "frame/light_walls.h"
#include "shared/sky_map_data.h"

/* Layers of a batch, valid until the next run. */
typedef struct lsf_sky_map_outputs {
    lsf_shadow shadow;     /* keys of lib/sky_map.glsl; struct lsf_sky_map_data */
    uint32_t first, count; /* directions of the batch */
} lsf_sky_map_outputs;

typedef struct lsf_sky_map {
    lsf_context *context;
    lsf_sky_map_outputs outputs;
    struct lsf_sky_map_data *maps; /* of all directions of the iteration */
    lsf_draw_region *regions;
    GLuint depth, large_array, framebuffer, tint_framebuffers[LSF_SKY_MAPS_MAX];
    GLuint small_program, large_program, map_program; /* the last for what is not listed */
    GLuint straight_program, tint_program;            /* 0: no light passes surfaces */
    bool masked;
    uint32_t batch, side;
    uint64_t counts[LSF_DRAW_COUNTS];
    lsf_timer *timer;
} lsf_sky_map;

/* `side`: texels. */
void lsf_sky_map_plan(lsf_plan *plan, uint32_t side);
bool lsf_sky_map_create(lsf_sky_map *pass, lsf_context *context, const lsf_plan *plan,
                        const lsf_scene_gpu *scene, lsf_error *error);
/* To be called before the first batch of an iteration: projects its directions, each map rotated
 * and moved at random. */
void lsf_sky_map_begin(lsf_sky_map *pass, const lsf_iteration *iteration);
/* Draws the next batch; false when there is none. */
bool lsf_sky_map_next(lsf_sky_map *pass, const lsf_iteration *iteration);
void lsf_sky_map_destroy(lsf_sky_map *pass);

#endif
