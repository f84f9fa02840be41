/* What every pass reads of the iteration in progress: the plan, the scene and the view. */
#ifndef LSF_FRAME_ITERATION_H
#define LSF_FRAME_ITERATION_H

#include "frame/scene_gpu.h"
#include "frame/sparse_grid.h"
#include "plan/sky_light.h"
#include "shared/view.h"

/* Whether an iteration that takes long shall go on. */
typedef bool (*lsf_iteration_question)(void *user);

typedef struct lsf_iteration {
    lsf_context *context;
    lsf_plan *plan; /* passes change the size of what grows while rendering, nothing else */
    const lsf_state *state;
    lsf_scene_gpu *scene;
    uint64_t seed;
    uint32_t index;       /* of the random numbers it takes */
    uint32_t done;        /* iterations of the frame before it */
    uint32_t serial;      /* iterations of all frames up to and with it; one that is run again keeps
                           * its number */
    uint32_t first_index; /* of the frame's first iteration */
    uint32_t serial_before; /* of the iteration before that */
    lsf_sparse_grid grid;   /* of the points at which it gathers indirect light */
    GLuint view_buffer;     /* struct lsf_view_data */
    struct lsf_view_data view;
    lsf_camera_state previous_camera; /* for motion */
    float kept;                       /* samples that light of the frames before stands for */
    uint32_t light_count; /* the state's lights, then those that stand for the environment */
    lsf_light_state *lights;
    lsf_sky_share *shares; /* one for each light; a technique that finds the environment in other
                            * ways, too, sets them for the iteration */
    lsf_sky sky;
    lsf_iteration_question question; /* NULL: it shall */
    void *question_user;
} lsf_iteration;

/* Asked before each light, each VPL and each path. Once it is false it stays so, and nobody will
 * use what the iteration leaves. */
static inline bool lsf_iteration_goes_on(const lsf_iteration *iteration)
{
    return !iteration->question || iteration->question(iteration->question_user);
}

/* A part of the picture to work on: a viewport, and with interleaved sampling the tile whose pixels
 * it holds; see lib/region.glsl. */
typedef struct lsf_region {
    int32_t x, y, width, height;
    int32_t tile_x, tile_y;
} lsf_region;

/* Sets the viewport and, for the program in use, the region. */
void lsf_region_set(const lsf_region *region);

void lsf_iteration_plan(lsf_plan *plan);
/* `previous` is the state that motion is measured from, NULL without motion. */
bool lsf_iteration_create(lsf_iteration *iteration, lsf_context *context, lsf_plan *plan,
                          lsf_scene_gpu *scene, const lsf_state *state, const lsf_state *previous,
                          uint64_t seed, lsf_error *error);
void lsf_iteration_destroy(lsf_iteration *iteration);

/* Follows an edit of the environment. False without memory. */
bool lsf_iteration_update_sky(lsf_iteration *iteration);

/* Goes over to a frame of that state, whose iterations take random numbers from `first_index` on.
 * It has as many lights as the one before. `previous` as for lsf_iteration_create. */
void lsf_iteration_frame(lsf_iteration *iteration, const lsf_state *state,
                         const lsf_state *previous, uint32_t first_index);

/* Begins the frame's iteration number `done`: jitters the pixel (uniform over the pixel: a box
 * filter), uploads the view and draws the directions from which the environment lights. */
void lsf_iteration_begin(lsf_iteration *iteration, uint32_t done);

/* The view of the iteration begun last, which that has bound for its passes: for those that run
 * after it. */
void lsf_iteration_bind_view(const lsf_iteration *iteration);

/* Iterations that the picture's light will have, with those of frames before that are kept; those
 * so far when that is open. */
float lsf_iteration_expected(const lsf_iteration *iteration);

/* Solid angle over which directions of the environment spread a lobe, were they uniform over the
 * sphere [sr]; 0: there are none. */
float lsf_iteration_sky_angle(const lsf_iteration *iteration);

/* For lib/sky.glsl in the program in use. */
void lsf_iteration_bind_sky(const lsf_iteration *iteration);

/* The half spaces of the view's four sides and its near plane. */
void lsf_iteration_region(const lsf_iteration *iteration, lsf_draw_region *region);

/* Two numbers, uniform over 32 bits, that pick light sample `index` of all iterations: points of a
 * Sobol sequence of `purpose`'s own, or plain random ones when the plan says so. */
void lsf_iteration_sample(const lsf_iteration *iteration, uint32_t index, uint32_t purpose,
                          uint32_t bits[2]);
/* Of sample i of `count` in an iteration: its number in a low-discrepancy sequence, and what its
 * bits are then xored with. Of the plan's tiles, to which samples are dealt out in turn, each has a
 * whole sequence, and what all take at once is spread over the range by a digital shift: its
 * digits are the tile's, over and over. */
typedef struct lsf_iteration_number {
    uint32_t index, shift[2];
} lsf_iteration_number;
lsf_iteration_number lsf_iteration_deal(const lsf_iteration *iteration, uint32_t i, uint32_t count);
/* lsf_iteration_sample of it. */
void lsf_iteration_sample_dealt(const lsf_iteration *iteration, uint32_t i, uint32_t count,
                                uint32_t purpose, uint32_t bits[2]);

/* For lib/chance.glsl in the program in use: numbers of `purpose`'s own, which `map` tells apart
 * among those of one purpose. */
void lsf_iteration_set_chance(const lsf_iteration *iteration, uint32_t purpose, uint32_t map);
/* The same for programs that draw blended surfaces, where there are any. */
void lsf_iteration_set_blend_chance(const lsf_iteration *iteration, uint32_t purpose, uint32_t map);

/* A seed of its own for each use of random numbers, named by `purpose`. */
uint32_t lsf_iteration_seed(const lsf_iteration *iteration, uint32_t purpose);

#endif
