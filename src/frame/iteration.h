/* The iteration in progress, which every pass reads: the plan, the scene and the view. */
#ifndef LSF_FRAME_ITERATION_H
#define LSF_FRAME_ITERATION_H

#include "frame/scene_gpu.h"
#include "frame/sparse_grid.h"
#include "plan/sky_light.h"
#include "shared/view.h"

/* Whether an iteration that takes long is to go on. */
typedef bool (*lsf_iteration_question)(void *user);

typedef struct lsf_iteration {
    lsf_context *context;
    lsf_plan *plan; /* passes change only the size of what grows while rendering */
    const lsf_state *state;
    lsf_scene_gpu *scene;
    uint64_t seed;
    uint32_t index;         /* of its random numbers */
    uint32_t done;          /* iterations of the frame that came before */
    uint32_t serial;        /* iterations of all frames up to and including this one; an iteration
                             * that is run again keeps its number */
    uint32_t first_index;   /* of the frame's first iteration */
    uint32_t serial_before; /* of the iteration before that */
    lsf_sparse_grid grid;   /* points at which it gathers indirect light */
    GLuint view_buffer;     /* struct lsf_view_data */
    struct lsf_view_data view;
    lsf_camera_state previous_camera; /* for motion */
    float kept;                       /* samples that the light kept from earlier frames stands
                                       * for */
    uint32_t light_count; /* the state's lights, then those that stand for the environment */
    lsf_light_state *lights;
    lsf_sky_share *shares; /* one for each light; a technique that also finds the environment in
                            * other ways sets them for the iteration */
    lsf_sky sky;
    lsf_iteration_question question; /* NULL: it shall */
    void *question_user;
} lsf_iteration;

/* Asked before each light, each VPL and each path. Once it is false it stays false, and the
 * outputs of the iteration are not used. */
static inline bool lsf_iteration_goes_on(const lsf_iteration *iteration)
{
    return !iteration->question || iteration->question(iteration->question_user);
}

/* A part of the picture to work on: a viewport and, with interleaved sampling, the tile whose
 * pixels it holds; see lib/region.glsl. */
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

/* Goes over to a frame of that state, whose iterations take random numbers from `first_index`
 * on. It has as many lights as the frame before. `previous` is as for lsf_iteration_create. */
void lsf_iteration_frame(lsf_iteration *iteration, const lsf_state *state,
                         const lsf_state *previous, uint32_t first_index);

/* Begins the frame's iteration number `done`: jitters the pixel (uniform over the pixel: a box
 * filter), uploads the view and draws the directions from which the environment lights. */
void lsf_iteration_begin(lsf_iteration *iteration, uint32_t done);

/* Binds the view of the iteration that was begun last, for passes that run after it. */
void lsf_iteration_bind_view(const lsf_iteration *iteration);

/* Iterations that the picture's light will have, with those of earlier frames that are kept;
 * where the number is open, the iterations so far. */
float lsf_iteration_expected(const lsf_iteration *iteration);
/* m' over that number: samples of one direction that a glossy lobe is to be spread over
 * (brdf_evaluate). */
float lsf_iteration_kernel(const lsf_iteration *iteration);

/* Solid angle by which each direction of the environment widens a lobe, as if directions were
 * uniform over the sphere [sr]; 0: there are none. */
float lsf_iteration_sky_angle(const lsf_iteration *iteration);

/* Directions of the environment are drawn from two independent sequences in turn. Which one that of
 * number `direction` of the iteration is from, 0 or 1. */
uint32_t lsf_iteration_sky_sequence(const lsf_iteration *iteration, uint32_t direction);

/* For lib/sky.glsl in the program in use. */
void lsf_iteration_bind_sky(const lsf_iteration *iteration);

/* The half spaces of the view's four sides and its near plane. */
void lsf_iteration_region(const lsf_iteration *iteration, lsf_draw_region *region);

/* Two numbers, uniform over 32 bits, that pick light sample `index` of all iterations: points of
 * a Sobol sequence of `purpose`, or plain random ones when the plan says so. */
void lsf_iteration_sample(const lsf_iteration *iteration, uint32_t index, uint32_t purpose,
                          uint32_t bits[2]);
/* For sample i of `count` in an iteration: its number in a low-discrepancy sequence, and the
 * bits that it is xored with. Each of the plan's tiles, to which samples are dealt out in turn,
 * has a whole sequence. The samples of one iteration are spread over the range by a digital
 * shift whose digits are those of the tile, repeated. */
typedef struct lsf_iteration_number {
    uint32_t index, shift[2];
} lsf_iteration_number;
lsf_iteration_number lsf_iteration_deal(const lsf_iteration *iteration, uint32_t i, uint32_t count);
/* The value of lsf_iteration_sample in that sequence. */
void lsf_iteration_sample_dealt(const lsf_iteration *iteration, uint32_t i, uint32_t count,
                                uint32_t purpose, uint32_t bits[2]);

/* Sets the uniforms of lib/chance.glsl in the program in use: random numbers of `purpose`; `map`
 * separates those of one purpose. */
void lsf_iteration_set_chance(const lsf_iteration *iteration, uint32_t purpose, uint32_t map);
/* The same for programs that draw blended surfaces, where there are any. */
void lsf_iteration_set_blend_chance(const lsf_iteration *iteration, uint32_t purpose, uint32_t map);

/* A seed of its own for each use of random numbers, named by `purpose`. */
uint32_t lsf_iteration_seed(const lsf_iteration *iteration, uint32_t purpose);

#endif
