/* A technique: a chain of passes that makes one iteration's picture. Register in registry.c. */
#ifndef LSF_TECHNIQUES_TECHNIQUE_H
#define LSF_TECHNIQUES_TECHNIQUE_H

#include "frame/cone.h"
#include "frame/iteration.h"
#include "passes/bidirectional_shade.h"
#include "passes/blur.h"
#include "passes/compose.h"
#include "passes/denoise.h"
#include "passes/gbuffer.h"
#include "passes/light_filter.h"
#include "passes/light_guide.h"
#include "passes/light_mean.h"
#include "passes/light_tree.h"
#include "passes/light_tree_sample.h"
#include "passes/ray_bundle.h"
#include "passes/reflective_shadow_map.h"
#include "passes/shadow_map.h"
#include "passes/sparse.h"
#include "passes/specular_path.h"
#include "passes/temporal.h"
#include "passes/voxel_path.h"
#include "passes/voxel_view.h"
#include "passes/voxelize.h"
#include "passes/vpl.h"
#include "passes/vpl_cloud.h"
#include "plan/tessellation.h"

/* The params of everything that takes options; lsf_pass_option_tables names them. */
typedef struct lsf_pass_params {
    lsf_tessellation_params tessellation;
    lsf_sky_light_params sky_light;
    lsf_gbuffer_params gbuffer;
    lsf_shadow_map_params shadow_map;
    lsf_reflective_shadow_map_params reflective_shadow_map;
    lsf_vpl_params vpl;
    lsf_ray_bundle_params ray_bundle;
    lsf_sparse_params sparse;
    lsf_blur_params blur;
    lsf_bidirectional_shade_params bidirectional_shade;
    lsf_voxel_grid_params voxel_grid;
    lsf_voxelize_params voxelize;
    lsf_cone_params cone;
    lsf_specular_path_params specular_path;
    lsf_voxel_path_params voxel_path;
    lsf_vpl_cloud_params vpl_cloud;
    lsf_light_tree_params light_tree;
    lsf_light_tree_sample_params light_tree_sample;
    lsf_light_filter_params light_filter;
    lsf_denoise_params denoise;
    lsf_temporal_params temporal;
} lsf_pass_params;

#define LSF_PASS_PARAMS_DEFAULTS                                                                   \
    .tessellation = {LSF_TESSELLATION_PARAMS_DEFAULTS},                                            \
    .sky_light = {LSF_SKY_LIGHT_PARAMS_DEFAULTS}, .gbuffer = {LSF_GBUFFER_PARAMS_DEFAULTS},        \
    .shadow_map = {LSF_SHADOW_MAP_PARAMS_DEFAULTS},                                                \
    .reflective_shadow_map = {LSF_REFLECTIVE_SHADOW_MAP_PARAMS_DEFAULTS},                          \
    .vpl = {LSF_VPL_PARAMS_DEFAULTS}, .ray_bundle = {LSF_RAY_BUNDLE_PARAMS_DEFAULTS},              \
    .sparse = {LSF_SPARSE_PARAMS_DEFAULTS}, .blur = {LSF_BLUR_PARAMS_DEFAULTS},                    \
    .bidirectional_shade = {LSF_BIDIRECTIONAL_SHADE_PARAMS_DEFAULTS},                              \
    .voxel_grid = {LSF_VOXEL_GRID_PARAMS_DEFAULTS}, .voxelize = {LSF_VOXELIZE_PARAMS_DEFAULTS},    \
    .cone = {LSF_CONE_PARAMS_DEFAULTS}, .specular_path = {LSF_SPECULAR_PATH_PARAMS_DEFAULTS},      \
    .voxel_path = {LSF_VOXEL_PATH_PARAMS_DEFAULTS}, .vpl_cloud = {LSF_VPL_CLOUD_PARAMS_DEFAULTS},  \
    .light_tree = {LSF_LIGHT_TREE_PARAMS_DEFAULTS},                                                \
    .light_tree_sample = {LSF_LIGHT_TREE_SAMPLE_PARAMS_DEFAULTS},                                  \
    .light_filter = {LSF_LIGHT_FILTER_PARAMS_DEFAULTS}, .denoise = {LSF_DENOISE_PARAMS_DEFAULTS},  \
    .temporal = {LSF_TEMPORAL_PARAMS_DEFAULTS}

extern const lsf_option_table lsf_pass_option_tables[];
extern const uint32_t lsf_pass_option_table_count;

/* The outputs of an iteration, valid until the next; 0 where the technique has none. */
typedef struct lsf_technique_outputs {
    lsf_light_parts parts;
    lsf_composed layers;
    lsf_voxel_view_outputs voxels;
    bool bounded; /* the picture's alpha holds the luminance that a bound took away */
    float kernel; /* solid angle that glossy lobes are spread over, for want of samples [sr] */
    GLuint gate;  /* see lsf_accumulate_run; for a technique that settles */
} lsf_technique_outputs;

/* A pass in the statistics. */
typedef struct lsf_pass_report {
    lsf_timer *timer;
    uint32_t count_count;
    const char *const *count_names;
    const uint64_t *counts;
} lsf_pass_report;

#define LSF_TECHNIQUE_MAX_PASSES 32

/* What differs from the frame before. */
typedef struct lsf_changes {
    bool view;
    bool moved;       /* instances or lights */
    bool lights;      /* were edited */
    bool shining;     /* lights have changed or moved, for whatever reason */
    bool materials;   /* ... likewise */
    bool environment; /* it was rotated or scaled */
} lsf_changes;

/* The result of updating a technique to another frame. */
typedef enum lsf_update {
    LSF_UPDATE_DONE,
    LSF_UPDATE_REPLAN, /* the plan's resources do not fit the state */
    LSF_UPDATE_FAILED, /* for want of memory */
} lsf_update;

typedef struct lsf_technique {
    const char *name, *help;
    const char *const *groups; /* of options that it takes beside those that all do: what stands
                                * before the point; NULL ends them. NULL: none */
    bool bounces;  /* follows light from surface to surface, as often as the plan's bounces say */
    bool refracts; /* scatters and refracts light that surfaces transmit; else that goes straight */
    bool draws_lobes; /* finds the environment by rays drawn from the BRDF, which suit a uniform one
                       * better than directions drawn by its radiance */
    bool draws_alone; /* each pixel draws samples of its own whatever interleave.size is, and
                       * finds the environment by its directions */
    bool traces_pixels; /* each pixel traces light of its own, which takes most of an iteration */
    float points_per_second; /* at which two cores gather light that bounces, with some of the time
                              * left for all else; 0: it gathers none */
    uint32_t voxels_in_a_second; /* along the scene's longest side, in software with a time limit of
                                  * 1 s and voxel.resolution=0; 0: a time limit changes nothing */
    bool maps_scene; /* draws maps that hold all of the scene, for which its empty regions matter */
    /* Lists passes and resources, and what is left out. */
    void (*plan)(lsf_plan *plan, const lsf_pass_params *params, const lsf_state *state);
    /* Allocates what the plan lists. On failure it returns what is to be destroyed, and sets
     * `error`; NULL without memory. */
    bool (*create)(void **self, lsf_context *context, const lsf_plan *plan,
                   const lsf_pass_params *params, const lsf_scene_gpu *scene,
                   const lsf_state *state, lsf_error *error);
    /* Updates what it made of the state, which is still at the address given to `create`. NULL:
     * it made nothing. */
    lsf_update (*update)(void *self, const lsf_pass_params *params, const lsf_iteration *iteration,
                         const lsf_changes *changes);
    void (*run)(void *self, const lsf_iteration *iteration, lsf_technique_outputs *outputs);
    /* Learns what the GPU found out about iterations that were run, all of it only with `wait`.
     * False: buffers were too small, their gate let no picture through and now they are larger; to
     * be run again are those of a serial number above `iterations_done`. NULL: no buffer is ever
     * too small. */
    bool (*settle)(void *self, const lsf_iteration *iteration, bool wait,
                   uint32_t *iterations_done);
    void (*destroy)(void *self); /* NULL allowed */
    /* Its passes in order; returns their number. */
    uint32_t (*report)(void *self, lsf_pass_report reports[LSF_TECHNIQUE_MAX_PASSES]);
} lsf_technique;

extern const lsf_technique lsf_technique_bidirectional, lsf_technique_cone, lsf_technique_direct,
    lsf_technique_substitute_tree, lsf_technique_voxel_path;

/* NULL when unknown. */
const lsf_technique *lsf_technique_find(const char *name);

#endif
