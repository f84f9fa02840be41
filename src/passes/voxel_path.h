/* Light at visible points by uni-directional paths through the voxels. See voxel_path.md. */
#ifndef LSF_PASSES_VOXEL_PATH_H
#define LSF_PASSES_VOXEL_PATH_H

#include "frame/emitter_points.h"
#include "frame/path_inputs.h"
#include "plan/option.h"

typedef enum lsf_voxel_path_sequence {
    LSF_VOXEL_PATH_SOBOL,   /* low discrepancy over a pixel's samples of all iterations */
    LSF_VOXEL_PATH_TEXTURE, /* a texture of plain random numbers, skewed along the depth */
} lsf_voxel_path_sequence;

typedef struct lsf_voxel_path_params {
    int32_t min_samples, max_samples; /* paths of a pixel, at roughness 0 and at roughness 1; the
                                       * latter 0: 4, or those that fit into the time */
    int32_t emitters; /* points on emissive surfaces that each vertex is joined to; 0: none */
    int32_t draws;    /* sides of voxels drawn by their radiance at each vertex; 0: none */
    int32_t sequence; /* lsf_voxel_path_sequence */
} lsf_voxel_path_params;

/* Paths of a pixel, at most: software GL ends all loops of a shader together after 65535 turns,
 * some 40 of which a segment takes. */
#define LSF_VOXEL_PATH_MOST 64

#define LSF_VOXEL_PATH_PARAMS_DEFAULTS                                                             \
    .min_samples = 1, .max_samples = 0, .emitters = 1, .draws = 1, .sequence = LSF_VOXEL_PATH_SOBOL

#define LSF_VOXEL_PATH_OPTION_COUNT 5
extern const lsf_option_row lsf_voxel_path_options[LSF_VOXEL_PATH_OPTION_COUNT];

/* Lengths of a path that the plan's bounces and light take; 0: nothing to find by paths. What
 * emits, environments included, takes one more than punctual lights, whose light voxels hold. */
uint32_t lsf_voxel_path_segments(const lsf_plan *plan, bool punctual);

/* Whether vertices are joined to points on emissive surfaces. */
bool lsf_voxel_path_emitters(const lsf_plan *plan, const lsf_voxel_path_params *params);

typedef struct lsf_voxel_path_use {
    uint32_t segments;
    bool split_direct; /* emission that the first segment finds is asked for apart */
    bool draws;        /* voxels are drawn by what they reflect */
    bool mirrors;      /* smooth metals show what is around them in their lobes */
    bool lamps;        /* and lamps that voxels keep */
} lsf_voxel_path_use;

/* At the points' places. */
typedef struct lsf_voxel_path_outputs {
    lsf_split_light light;
    lsf_split_light direct; /* 0 unless split_direct */
} lsf_voxel_path_outputs;

typedef struct lsf_voxel_path {
    lsf_context *context;
    lsf_voxel_path_params params;
    lsf_voxel_path_outputs outputs;
    uint32_t segments;
    lsf_emitter_points emitters; /* points that its vertices are joined to */
    GLuint random;               /* 0 with Sobol points */
    GLuint framebuffer, program;
    lsf_timer *timer;
} lsf_voxel_path;

/* Needs the G-buffer's plan and that of the voxels. */
void lsf_voxel_path_plan(lsf_plan *plan, const lsf_voxel_path_params *params,
                         const lsf_voxel_path_use *use);
bool lsf_voxel_path_create(lsf_voxel_path *pass, lsf_context *context, const lsf_plan *plan,
                           const lsf_voxel_path_params *params, const lsf_voxel_path_use *use,
                           const lsf_scene *scene, const lsf_state *state, lsf_error *error);
/* Updates the emitters to the current state. False without memory. */
bool lsf_voxel_path_follow(lsf_voxel_path *pass, bool materials_edited);
/* `draws`: the list of voxel_draw.h by the inputs' radiance; 0 unless the use has them. */
void lsf_voxel_path_run(lsf_voxel_path *pass, const lsf_iteration *iteration,
                        const lsf_path_inputs *inputs, GLuint draws);
void lsf_voxel_path_destroy(lsf_voxel_path *pass);

#endif
