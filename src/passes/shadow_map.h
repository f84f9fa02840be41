/* Shadow maps of punctual lights. See shadow_map.md. */
#ifndef LSF_PASSES_SHADOW_MAP_H
#define LSF_PASSES_SHADOW_MAP_H

#include "frame/light_projection.h"
#include "frame/light_walls.h"
#include "plan/option.h"

typedef enum lsf_shadow_filter {
    LSF_SHADOW_FILTER_NONE, /* one texel's plane against the receiver's; the borders converge over
                             * iterations */
    LSF_SHADOW_FILTER_PCF,  /* 4 x 4 texels, for single frames */
} lsf_shadow_filter;

typedef struct lsf_shadow_map_params {
    int32_t filter;         /* lsf_shadow_filter */
    float texels_per_pixel; /* of the whole map, all faces together, to the picture's pixels; 0:
                             * what the plan chooses */
} lsf_shadow_map_params;

/* A cascade spans about the picture's width at its far end; at the geometric mean of its depths a
 * pixel is sqrt(3) narrower than there, so sqrt(3) width texels a side match it: four cascades of
 * them are 12 width / height texels a pixel, 16 for a picture of 4:3. In hurried plans a texel is
 * twice as wide. */
#define LSF_SHADOW_MAP_TEXELS 16.0
#define LSF_SHADOW_MAP_TEXELS_HURRIED 4.0
#define LSF_SHADOW_MAP_PARAMS_DEFAULTS .filter = LSF_SHADOW_FILTER_NONE, .texels_per_pixel = 0.0f

#define LSF_SHADOW_MAP_OPTION_COUNT 2
extern const lsf_option_row lsf_shadow_map_options[LSF_SHADOW_MAP_OPTION_COUNT];

/* Valid until the next run. 2D arrays with a layer for each face. Depth is reverse-Z, 0 where the
 * light meets nothing; gradient is its change per texel along x and y, relative to the depth in
 * perspective maps, and left out with pcf. */
typedef struct lsf_shadow_map_outputs {
    lsf_shadow shadow;
    struct lsf_light_data light;
} lsf_shadow_map_outputs;

/* One set of textures for maps of the same shape, which lights use in turn. */
typedef struct lsf_shadow_map_target {
    GLuint depth, gradient, tint;
    GLuint framebuffers[6], tint_framebuffers[6];
    uint32_t faces, resolution;
} lsf_shadow_map_target;

typedef struct lsf_shadow_map {
    lsf_context *context;
    lsf_shadow_map_outputs outputs;
    lsf_shadow_map_target targets[LSF_LIGHT_PROJECTION_KINDS];
    /* Map of directional lights for points that the camera does not see. */
    lsf_shadow_map_target scene;
    GLuint program;
    lsf_light_walls walls;
    uint64_t counts[LSF_DRAW_COUNTS];
    lsf_timer *timer;
} lsf_shadow_map;

/* Texels along the side of a directional light's window. */
uint32_t lsf_shadow_map_cascade_side(const lsf_plan *plan, const lsf_shadow_map_params *params);
/* Lists the pass and the textures of the kinds of map that the lights in `state` need. */
void lsf_shadow_map_plan(lsf_plan *plan, const lsf_shadow_map_params *params,
                         const lsf_state *state);
/* Adds a map of directional lights that holds the whole scene, `resolution` texels along its side.
 */
void lsf_shadow_map_plan_scene(lsf_plan *plan, const lsf_shadow_map_params *params,
                               const lsf_state *state, uint32_t resolution);
bool lsf_shadow_map_create(lsf_shadow_map *pass, lsf_context *context, const lsf_plan *plan,
                           lsf_error *error);
/* Draws the map of iteration->lights[light_index], rotated and moved at random for this
 * iteration. */
void lsf_shadow_map_run(lsf_shadow_map *pass, const lsf_iteration *iteration, uint32_t light_index);
/* The same, where the light is directional, with the map that holds the whole scene. */
void lsf_shadow_map_run_scene(lsf_shadow_map *pass, const lsf_iteration *iteration,
                              uint32_t light_index);
void lsf_shadow_map_destroy(lsf_shadow_map *pass);

#endif
