/* Voxel path tracing: direct light by shadow maps, everything else by uni-directional paths through
 * the voxels, blurred and upsampled. docs/voxels.md has the chain. */
#include <stdlib.h>

#include "base/base.h"
#include "passes/compose.h"
#include "passes/voxel_draw.h"
#include "passes/voxel_path.h"
#include "techniques/sparse_chain.h"
#include "techniques/voxel_chain.h"

/* A path goes on from each voxel by one ray. */
static lsf_voxel_chain_use chain_use(const lsf_plan *plan, const lsf_pass_params *params,
                                     const lsf_state *state)
{
    const lsf_voxel_path_params *p = &params->voxel_path;
    return (lsf_voxel_chain_use){
        .sides = LSF_VOXEL_SIDES_SURFACE,
        .levels = 1,
        .direct = {LSF_SKY_CHANCE_PATHS, {(float)p->min_samples, (float)p->max_samples}},
        .lamps = plan->bounces > 0 && lsf_voxel_lamps(plan, state),
        .voxel_rays = 1.0f};
}

typedef struct voxel_path {
    lsf_voxel_chain chain;
    lsf_voxel_draw draw;
    lsf_voxel_path path;
    lsf_sparse_chain sparse;
    lsf_compose compose;
    bool traced; /* there are paths */
} voxel_path;

/* No segments where there are no voxels to find. */
static lsf_voxel_path_use path_use(const lsf_plan *plan, const lsf_pass_params *params,
                                   const lsf_state *state)
{
    lsf_voxel_path_use use = {0};
    const lsf_requirements *r = &plan->requirements;
    uint32_t layers = LSF_AOV_DIRECT | LSF_AOV_INDIRECT_DIFFUSE | LSF_AOV_INDIRECT_SPECULAR;
    if (lsf_voxel_chain_has_voxels(plan))
        use.segments = lsf_voxel_path_segments(plan, state->light_count > 0);
    use.split_direct = use.segments > 0 && (r->emissive || r->unlit || r->environment) &&
                       (plan->aovs & layers) && lsf_sparse_chain_is_plain(plan, params, 1);
    use.draws = use.segments > 0 && plan->bounces > 0 && params->voxel_path.draws > 0 &&
                (state->light_count > 0 || r->environment);
    use.mirrors = use.segments > 0 && lsf_voxel_mirrors(plan, state);
    use.lamps = chain_use(plan, params, state).lamps;
    return use;
}

static void remark(lsf_plan *plan, const lsf_voxel_path_use *use)
{
    const lsf_requirements *r = &plan->requirements;
    if (use->segments == 0)
        return;
    if ((r->emissive || r->unlit || r->environment) && !use->split_direct &&
        (plan->aovs & (LSF_AOV_DIRECT | LSF_AOV_INDIRECT_DIFFUSE | LSF_AOV_INDIRECT_SPECULAR)))
        lsf_plan_remark(plan,
                        "where paths' light is shared between pixels, direct light of surfaces "
                        "and environments is in the indirect layers");
}

static void plan_voxel_path(lsf_plan *plan, const lsf_pass_params *params, const lsf_state *state)
{
    lsf_voxel_path_use use = path_use(plan, params, state);
    lsf_voxel_chain_use chain = chain_use(plan, params, state);
    plan->refracted = use.segments > 0 && plan->requirements.refractive;
    lsf_voxel_chain_plan(plan, params, state, &chain);
    if (use.segments > 0) {
        lsf_voxel_grid grid = lsf_voxel_chain_grid(plan, params, state, &chain);
        if (use.draws)
            lsf_voxel_draw_plan(plan, &grid, chain.sides,
                                lsf_voxel_path_emitters(plan, &params->voxel_path));
        lsf_sparse_chain_plan_split(plan, params, 1);
        lsf_voxel_path_plan(plan, &params->voxel_path, &use);
        lsf_sparse_chain_plan_finish(plan, params, 1);
    } else {
        lsf_plan_omit(plan, "voxel_path",
                      lsf_voxel_chain_has_voxels(plan) ? "no light bounces"
                                                       : "the scene has no triangles");
    }
    lsf_compose_plan(plan, &(lsf_compose_use){.direct = lsf_light_any(plan, state),
                                              .indirect = use.segments > 0,
                                              .split_direct = use.split_direct});
    remark(plan, &use);
}

static bool create_paths(voxel_path *v, lsf_context *context, const lsf_plan *plan,
                         const lsf_pass_params *params, const lsf_voxel_path_use *use,
                         const lsf_scene *scene, const lsf_state *state, lsf_error *error)
{
    v->traced = true;
    return (!use->draws || lsf_voxel_draw_create(&v->draw, context, plan, error)) &&
           lsf_voxel_path_create(&v->path, context, plan, &params->voxel_path, use, scene, state,
                                 error) &&
           lsf_sparse_chain_create(&v->sparse, context, plan, params, error);
}

static bool create_voxel_path(void **self, lsf_context *context, const lsf_plan *plan,
                              const lsf_pass_params *params, const lsf_scene_gpu *scene,
                              const lsf_state *state, lsf_error *error)
{
    voxel_path *v = *self = lsf_alloc(1, sizeof *v);
    if (!v)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    lsf_voxel_path_use use = path_use(plan, params, state);
    lsf_voxel_chain_use chain = chain_use(plan, params, state);
    return lsf_voxel_chain_create(&v->chain, context, plan, params, scene, state, &chain, error) &&
           (use.segments == 0 ||
            create_paths(v, context, plan, params, &use, scene->scene, state, error)) &&
           lsf_compose_create(&v->compose, context, plan, error);
}

static lsf_update update_voxel_path(void *self, const lsf_pass_params *params,
                                    const lsf_iteration *iteration, const lsf_changes *changes)
{
    voxel_path *v = self;
    lsf_voxel_chain_use use = chain_use(iteration->plan, params, iteration->state);
    if (v->traced && (changes->moved || changes->materials) &&
        !lsf_voxel_path_follow(&v->path, changes->materials))
        return LSF_UPDATE_FAILED;
    return lsf_voxel_chain_update(&v->chain, params, iteration, &use, changes);
}

/* Indirect light of the picture's size, in `parts`, and direct light that is asked for apart. */
static void run_paths(voxel_path *v, const lsf_iteration *iteration, lsf_light_parts *parts)
{
    const lsf_surface_maps *seen = &v->chain.direct.gbuffer.outputs.seen;
    const lsf_path_inputs inputs =
        lsf_voxel_chain_paths(&v->chain, lsf_sparse_chain_split(&v->sparse, iteration, seen));
    if (v->draw.list) {
        lsf_voxel_draw_begin(&v->draw);
        lsf_voxel_draw_run(&v->draw, iteration, v->chain.voxels, v->chain.light.radiance);
    }
    lsf_voxel_path_run(&v->path, iteration, &inputs, v->draw.list);
    parts->indirect = lsf_sparse_chain_finish(&v->sparse, iteration, seen, &v->path.outputs.light);
    parts->split_direct = v->path.outputs.direct;
}

static void run_voxel_path(void *self, const lsf_iteration *iteration,
                           lsf_technique_outputs *outputs)
{
    voxel_path *v = self;
    /* As with cones: narrower lobes show no more. */
    v->chain.direct.gbuffer.lobe_angle = lsf_voxel_solid_angle(&v->chain.grid);
    lsf_voxel_chain_run(&v->chain, iteration);
    lsf_light_parts parts = lsf_direct_chain_parts(&v->chain.direct);
    if (v->traced)
        run_paths(v, iteration, &parts);
    lsf_compose_run(&v->compose, iteration, &parts);
    *outputs = (lsf_technique_outputs){.parts = parts,
                                       .layers = v->compose.outputs,
                                       .voxels = lsf_voxel_chain_view(&v->chain, iteration)};
}

static void destroy_voxel_path(void *self)
{
    voxel_path *v = self;
    if (!v)
        return;
    lsf_compose_destroy(&v->compose);
    lsf_sparse_chain_destroy(&v->sparse);
    lsf_voxel_path_destroy(&v->path);
    lsf_voxel_draw_destroy(&v->draw);
    lsf_voxel_chain_destroy(&v->chain);
    free(v);
}

static uint32_t report_voxel_path(void *self, lsf_pass_report reports[LSF_TECHNIQUE_MAX_PASSES])
{
    voxel_path *v = self;
    uint32_t count = lsf_voxel_chain_report(&v->chain, reports);
    if (v->traced) {
        count += lsf_sparse_chain_report_split(&v->sparse, reports + count);
        if (v->draw.timer)
            reports[count++] = (lsf_pass_report){.timer = v->draw.timer};
        reports[count++] = (lsf_pass_report){.timer = v->path.timer};
        count += lsf_sparse_chain_report_finish(&v->sparse, reports + count);
    }
    reports[count++] = (lsf_pass_report){.timer = v->compose.timer};
    return count;
}

static const char *const groups[] = {"voxel", "voxel_path", "sparse", NULL};

const lsf_technique lsf_technique_voxel_path = {
    .name = "voxel_path",
    .help = "global illumination by paths through the scene's voxels",
    .groups = groups,
    .bounces = true,
    .refracts = true,
    .draws_lobes = true,
    .traces_pixels = true,
    .points_per_second = 0x1p17f, /* 1 to 6 paths each took 4 to 12 us of a core */
    .voxels_in_a_second = 64,
    .plan = plan_voxel_path,
    .create = create_voxel_path,
    .update = update_voxel_path,
    .run = run_voxel_path,
    .destroy = destroy_voxel_path,
    .report = report_voxel_path,
};
