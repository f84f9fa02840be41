/* Thin walls that transmit, in the maps of lights: light goes straight through them. In each
 * iteration a wall is in the map by chance (lib/straight.glsl); what a map then shows behind walls
 * is tinted by them. */
#ifndef LSF_PLAN_LIGHT_WALLS_H
#define LSF_PLAN_LIGHT_WALLS_H

#include "plan/iteration.h"

/* Of a light's map: unit-range colours, 10 bits each. */
#define LSF_LIGHT_TINT_FORMAT GL_RGB10_A2

typedef struct lsf_light_walls {
    lsf_context *context;
    GLuint depth_program; /* walls that are there: depth and its slope; 0 where nobody draws them
                             alone */
    GLuint tint_program;  /* those that are not; 0: no wall transmits */
} lsf_light_walls;

/* Whether the scene has such walls. */
bool lsf_light_walls_needed(const lsf_plan *plan);

/* Adds a pass `name` to the plan, where it is needed. */
void lsf_light_walls_plan(lsf_plan *plan, const char *name, bool gradient);
/* With `depth`, for maps that hold nothing but depth and slope. */
bool lsf_light_walls_create(lsf_light_walls *walls, lsf_context *context, const lsf_plan *plan,
                            const char *name, bool depth, lsf_error *error);

/* Draws the walls that are there into the map that is bound, as lsf_begin_surfaces has left it.
 * `map` tells maps of one purpose apart. */
void lsf_light_walls_draw(const lsf_light_walls *walls, const lsf_iteration *iteration, GLint face,
                          uint32_t purpose, uint32_t map, const lsf_draw_region *region,
                          uint64_t *counts);
/* Multiplies the others into `framebuffer`, a face of `resolution` texels of the map's tint, after
 * white; `depth` is the map's; `purpose` and `map` as above. The light's buffer is bound. */
void lsf_light_walls_tint(const lsf_light_walls *walls, const lsf_iteration *iteration,
                          GLuint framebuffer, uint32_t resolution, GLint face, uint32_t purpose,
                          uint32_t map, GLuint depth, const lsf_draw_region *region,
                          uint64_t *counts);

#endif
