/* Thin walls that transmit, in the shadow maps of lights: light goes straight through them. In
 * each iteration a wall is in the map by chance (lib/straight.glsl); the light behind the others
 * is tinted by them. */
#ifndef LSF_FRAME_LIGHT_WALLS_H
#define LSF_FRAME_LIGHT_WALLS_H

#include "frame/iteration.h"

/* Of the tint in a light's map: unit-range colours of 10 bits, with media floats, for their
 * surfaces each multiply by much and by little. */
GLenum lsf_light_tint_format(const lsf_plan *plan);

typedef struct lsf_light_walls {
    lsf_context *context;
    GLuint depth_program; /* draws the walls that are in the map: depth and its slope; 0 where
                           * they are not drawn apart */
    GLuint tint_program;  /* draws the walls that are not; 0: no wall transmits */
} lsf_light_walls;

/* Whether light of some lamp or of the sky passes some surface. */
bool lsf_light_walls_needed(const lsf_plan *plan);

/* Which surfaces light of a lamp passes: thin walls. Light of the sky passes all surfaces that
 * light goes straight through, as it does for all other ways to find the sky. */
typedef struct lsf_light_passage {
    bool any;
    lsf_draw_mode stops, passes; /* surfaces drawn as opaque, and surfaces drawn by chance */
} lsf_light_passage;

lsf_light_passage lsf_light_passage_of(const lsf_iteration *iteration, uint32_t light_index);

/* Adds a pass `name` to the plan, where it is needed. */
void lsf_light_walls_plan(lsf_plan *plan, const char *name, bool gradient);
/* With `depth`, for maps that hold only depth and slope. */
bool lsf_light_walls_create(lsf_light_walls *walls, lsf_context *context, const lsf_plan *plan,
                            const char *name, bool depth, lsf_error *error);

/* Draws the walls that are in the map into the bound framebuffer, as lsf_begin_surfaces has left
 * it. */
void lsf_light_walls_draw(const lsf_light_walls *walls, const lsf_iteration *iteration, GLint face,
                          uint32_t purpose, uint32_t light_index, const lsf_draw_region *region,
                          uint64_t *counts);
/* Multiplies the tints of the other walls into `framebuffer`, a face of `resolution` texels of
 * the map's tint, after clearing it to white; `depth` is the map's; `purpose` is as above. The
 * light's buffer is bound. */
void lsf_light_walls_tint(const lsf_light_walls *walls, const lsf_iteration *iteration,
                          GLuint framebuffer, uint32_t resolution, GLint face, uint32_t purpose,
                          uint32_t light_index, GLuint depth, const lsf_draw_region *region,
                          uint64_t *counts);

#endif
