/* A tree over a cloud of VPLs, whose inner nodes may stand for the VPLs below them. See
 * light_tree.md. */
#ifndef LSF_PASSES_LIGHT_TREE_H
#define LSF_PASSES_LIGHT_TREE_H

#include "frame/iteration.h"
#include "frame/light_tree_buffers.h"
#include "plan/option.h"

typedef struct lsf_light_tree_params {
    float similarity; /* least similarity of the normals below a node that stands for them */
    float spread;     /* largest spread of positions along its normal [longest side of the scene] */
    float diagonal;   /* largest diagonal of its box [the same]; 0: any */
    bool covariance;  /* nodes keep all of their positions' covariance, not three variances */
} lsf_light_tree_params;

#define LSF_LIGHT_TREE_PARAMS_DEFAULTS                                                             \
    .similarity = 0.5f, .spread = 0.1f, .diagonal = 0.0f, .covariance = false

#define LSF_LIGHT_TREE_OPTION_COUNT 4
extern const lsf_option_row lsf_light_tree_options[LSF_LIGHT_TREE_OPTION_COUNT];

/* The most VPLs of a cloud: every device can read as many nodes. */
#define LSF_LIGHT_TREE_MOST                                                                        \
    ((uint32_t)(LSF_STORAGE_BLOCK_BYTES / sizeof(struct lsf_light_tree_node)))

enum {
    LSF_LIGHT_TREE_BOUNDS,
    LSF_LIGHT_TREE_CODE,
    LSF_LIGHT_TREE_COUNT,
    LSF_LIGHT_TREE_SCAN,
    LSF_LIGHT_TREE_SCATTER,
    LSF_LIGHT_TREE_LINK,
    LSF_LIGHT_TREE_MERGE,
    LSF_LIGHT_TREE_AREA,
    LSF_LIGHT_TREE_PROGRAMS
};

typedef struct lsf_light_tree {
    lsf_context *context;
    lsf_light_tree_params params;
    uint32_t capacity; /* records of the cloud */
    lsf_light_tree_buffers outputs;
    GLuint codes[2], counts; /* of the sort */
    GLuint parents, dispatches;
    GLuint programs[LSF_LIGHT_TREE_PROGRAMS];
    lsf_timer *sort_timer, *timer;
} lsf_light_tree;

/* `capacity`: records of the cloud, live and dead, from 1 to LSF_LIGHT_TREE_MOST; `cloud`: the stem
 * of their buffer in the plan. */
void lsf_light_tree_plan(lsf_plan *plan, const lsf_light_tree_params *params, uint32_t capacity,
                         const char *cloud);
bool lsf_light_tree_create(lsf_light_tree *pass, lsf_context *context, const lsf_plan *plan,
                           const lsf_light_tree_params *params, uint32_t capacity,
                           lsf_error *error);
/* Builds the tree over a cloud whose buffer holds `capacity` records and nothing else. */
void lsf_light_tree_run(lsf_light_tree *pass, const lsf_iteration *iteration, GLuint cloud);
void lsf_light_tree_destroy(lsf_light_tree *pass);

#endif
