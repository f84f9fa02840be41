/* The parts of the engine that a sandbox's shader names: passes, run once for as long as nothing
 * changes. */
#ifndef LSF_SANDBOX_ENGINE_H
#define LSF_SANDBOX_ENGINE_H

#include "passes/gbuffer.h"
#include "passes/ray_bundle.h"
#include "passes/reflective_shadow_map.h"
#include "passes/shadow_map.h"
#include "passes/sky_map.h"
#include "passes/tonemap.h"
#include "passes/voxel_light.h"
#include "passes/voxel_mip.h"
#include "passes/voxelize.h"
#include "sandbox/text.h"
#include "techniques/renderer_parts.h"

/* The name in the plan under which the switches of the shader's own passes stand. */
#define LSF_SANDBOX_PASS "sandbox"

/* Everything that is decided before GL is needed. */
typedef struct lsf_sandbox_setup {
    const lsf_scene *scene; /* NULL: there is none */
    lsf_render_params params;
    const char **options; /* of the text and of the caller; the strings are theirs */
    uint32_t needs;       /* of the text */
    uint32_t own;         /* the number of them that are not options of the picture's technique */
    lsf_setup setup;      /* made with those options; empty without */
    lsf_plan *plan;       /* setup.plan, or one of its own */
    lsf_plan *picture;    /* of the technique; NULL: no picture is named */
} lsf_sandbox_setup;

/* Options, state and plan. Finish it in either case. */
bool lsf_sandbox_setup_begin(lsf_sandbox_setup *setup, const lsf_scene *scene,
                             const lsf_sandbox_text *text, const lsf_render_params *params,
                             lsf_error *error);
void lsf_sandbox_setup_finish(lsf_sandbox_setup *setup);

typedef struct lsf_sandbox_engine {
    lsf_context *context;
    lsf_sandbox_setup *setup; /* borrowed */
    lsf_ray_bundle_direction aim;
    bool aim_is_view, jitter, ran;
    uint32_t light; /* of shadow maps */
    lsf_scene_gpu gpu;
    lsf_iteration iteration;
    lsf_gbuffer gbuffer;
    lsf_shadow_map shadow_map;
    lsf_sky_map sky_map;
    lsf_reflective_shadow_map reflective;
    lsf_voxel_grid grid;
    lsf_voxelize *voxelize;
    const lsf_voxels *voxels;
    lsf_voxel_light voxel_light;
    lsf_voxel_mip voxel_mip;
    lsf_ray_bundle *bundle;
    GLuint hits, lights;
    lsf_renderer *renderer; /* of the picture */
    GLuint picture[4];      /* and its layers */
} lsf_sandbox_engine;

bool lsf_sandbox_engine_create(lsf_sandbox_engine *engine, lsf_context *context,
                               lsf_sandbox_setup *setup, const lsf_sandbox_text *text,
                               lsf_error *error);
/* Brings everything up to date for a frame. LSF_UPDATE_REPLAN: the engine has to be made anew. */
lsf_update lsf_sandbox_engine_run(lsf_sandbox_engine *engine, const lsf_sandbox_frame *frame,
                                  lsf_error *error);
/* Binds inputs for the program in use, whose pass has such needs. */
void lsf_sandbox_engine_bind(const lsf_sandbox_engine *engine, uint32_t needs);
/* Reports as lsf_technique does, without the picture's passes. */
uint32_t lsf_sandbox_engine_report(lsf_sandbox_engine *engine, lsf_timer **timers);
void lsf_sandbox_engine_destroy(lsf_sandbox_engine *engine);

#define LSF_SANDBOX_ENGINE_TIMERS 9

/* The grid of voxels, and how they keep light. */
lsf_voxel_grid lsf_sandbox_grid(const lsf_sandbox_setup *setup);
lsf_voxel_light_use lsf_sandbox_voxel_light(const lsf_sandbox_setup *setup);
lsf_ray_bundle_use lsf_sandbox_bundle(const lsf_sandbox_setup *setup);

#endif
