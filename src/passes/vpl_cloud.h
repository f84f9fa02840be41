/* Virtual point lights in quantity, without a map each: the vertices of light paths. See
 * vpl_cloud.md. */
#ifndef LSF_PASSES_VPL_CLOUD_H
#define LSF_PASSES_VPL_CLOUD_H

#include "frame/emitter_points.h"
#include "frame/light_projection.h"
#include "frame/maps.h"
#include "frame/voxel_grid.h"
#include "math/distribution.h"
#include "plan/option.h"

typedef struct lsf_vpl_cloud_params {
    int32_t count; /* of records, at most */
    float
        lobe_share; /* least share of what a surface reflects by microfacets that keeps its lobe */
    int32_t directions; /* of the environment, at which paths begin in an iteration, at most; 0: by
                         * the scene */
} lsf_vpl_cloud_params;

#define LSF_VPL_CLOUD_PARAMS_DEFAULTS .count = 100000, .lobe_share = 0.5f, .directions = 0

#define LSF_VPL_CLOUD_OPTION_COUNT 3
extern const lsf_option_row lsf_vpl_cloud_options[LSF_VPL_CLOUD_OPTION_COUNT];

/* The kinds of lights at which light paths begin, and how often surfaces may reflect them. */
typedef struct lsf_vpl_cloud_use {
    bool lights;   /* at lights with reflective shadow maps */
    bool emitters; /* on emissive surfaces */
    uint32_t bounces;
} lsf_vpl_cloud_use;

/* Records in their order: points on emitters, then the first vertices of all paths, the second ones
 * and so on. */
typedef struct lsf_vpl_cloud_shape {
    uint32_t points, paths, vertices; /* vertices of a path */
} lsf_vpl_cloud_shape;

/* A light's reflective shadow map. */
typedef struct lsf_vpl_cloud_inputs {
    const lsf_shadow *shadow;
    const lsf_surface_maps *seen; /* by the light */
    GLuint importance, sums;      /* with adaptive emission */
} lsf_vpl_cloud_inputs;

/* The paths of an iteration that begin at one light. */
typedef struct lsf_vpl_cloud_run {
    uint32_t light, first, count;
    float share; /* share of the light's flux that each path carries */
} lsf_vpl_cloud_run;

typedef struct lsf_vpl_cloud {
    lsf_context *context;
    lsf_vpl_cloud_use use;
    lsf_vpl_cloud_shape shape;
    bool specular; /* materials have specular lobes */
    float lobe_share;
    uint32_t directions;  /* of the environment, at which paths begin */
    uint32_t light_paths; /* of the iteration; the others begin on emitters */
    GLuint records;       /* output: struct lsf_vpl_record each */
    lsf_emitter_points emitters;
    GLuint light_program, emitter_program, bounce_program; /* 0: nothing of the kind */
    lsf_timer *light_timer, *emitter_timer, *bounce_timer;
} lsf_vpl_cloud;

/* The most records for `use`: 0 where no path begins. */
lsf_vpl_cloud_shape lsf_vpl_cloud_shape_of(const lsf_vpl_cloud_params *params,
                                           const lsf_vpl_cloud_use *use);
uint32_t lsf_vpl_cloud_records(const lsf_vpl_cloud_shape *shape);

/* Needs the plan of the reflective shadow map with lights, and that of voxels. */
void lsf_vpl_cloud_plan(lsf_plan *plan, const lsf_vpl_cloud_params *params,
                        const lsf_vpl_cloud_use *use);
bool lsf_vpl_cloud_create(lsf_vpl_cloud *pass, lsf_context *context, const lsf_plan *plan,
                          const lsf_vpl_cloud_params *params, const lsf_vpl_cloud_use *use,
                          const lsf_scene *scene, const lsf_state *state, lsf_error *error);
/* Updates the emitters to the current state. False without memory. */
bool lsf_vpl_cloud_follow(lsf_vpl_cloud *pass, bool materials_edited);
/* Empties the cloud and draws the iteration's points on emitters. `light_power`: of all lights
 * together, as lsf_light_power states it. */
void lsf_vpl_cloud_begin(lsf_vpl_cloud *pass, const lsf_iteration *iteration, float light_power);
/* Deals the iteration's light paths out to the lights in proportion to `picks`; some may get
 * none. */
lsf_vpl_cloud_run lsf_vpl_cloud_deal(const lsf_vpl_cloud *pass, const lsf_iteration *iteration,
                                     const lsf_distribution *picks, uint32_t light);
/* Finds the first vertices of a light's paths. */
void lsf_vpl_cloud_light(lsf_vpl_cloud *pass, const lsf_iteration *iteration,
                         const lsf_vpl_cloud_run *run, const lsf_vpl_cloud_inputs *inputs);
/* Follows all paths through the voxels. */
void lsf_vpl_cloud_bounce(lsf_vpl_cloud *pass, const lsf_iteration *iteration,
                          const lsf_voxels *voxels);
void lsf_vpl_cloud_destroy(lsf_vpl_cloud *pass);

#endif
