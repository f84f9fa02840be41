/* Many lights: a cloud of virtual point lights in each iteration, a tree over it whose inner nodes
 * stand for what is below them, and a few samples of it at each visible point. W. Tatzgern,
 * "Stochastic Substitute Trees for Real-Time Global Illumination", master's thesis, Graz University
 * of Technology, 2020. docs/substitute_tree.md has the chain. */
#include <stdlib.h>

#include "base/base.h"
#include "passes/compose.h"
#include "passes/light_tree.h"
#include "passes/light_tree_sample.h"
#include "passes/reflective_shadow_map.h"
#include "passes/vpl_cloud.h"
#include "techniques/light_picks.h"
#include "techniques/sparse_chain.h"
#include "techniques/specular_path_chain.h"
#include "techniques/voxel_chain.h"

/* Voxels serve for paths of light and for visibility; they send out light only for paths from
 * visible points. */
static lsf_voxel_chain_use chain_use(const lsf_plan *plan, const lsf_pass_params *params,
                                     const lsf_state *state)
{
    return lsf_specular_path_chain_needed(plan, params)
               ? lsf_specular_path_chain_voxels(plan, params, state)
               : (lsf_voxel_chain_use){0};
}

typedef struct substitute_tree {
    lsf_voxel_chain chain;
    lsf_vpl_cloud_use use;
    lsf_light_picks picks;
    lsf_reflective_shadow_map rsm;
    lsf_vpl_cloud cloud;
    lsf_light_tree tree;
    lsf_light_tree_sample sample;
    lsf_specular_path paths;
    lsf_sparse_chain sparse;
    lsf_compose compose;
} substitute_tree;

static bool light_shines(const lsf_plan *plan, const lsf_state *state)
{
    for (uint32_t i = 0; i < state->light_count; i++)
        if (lsf_light_power(&state->lights[i]) > 0.0f)
            return true;
    return plan->sky_lights > 0;
}

/* The lights beside those that have shadow maps. */
static lsf_vpl_cloud_use cloud_use(const lsf_plan *plan, const lsf_state *state)
{
    bool surfaces = lsf_voxel_chain_has_voxels(plan);
    return (lsf_vpl_cloud_use){.lights = surfaces && plan->bounces > 0 && light_shines(plan, state),
                               .emitters = surfaces && plan->requirements.emissive,
                               .bounces = plan->bounces};
}

static bool is_traced(const lsf_vpl_cloud_use *use)
{
    return use->lights || use->emitters;
}

static void remark(lsf_plan *plan)
{
    const lsf_requirements *r = &plan->requirements;
    if (r->emissive)
        lsf_plan_remark(plan, "with a tree of lights, direct light of surfaces is in the indirect "
                              "layers");
    if (r->unlit)
        lsf_plan_remark(plan,
                        "unlit surfaces are visible, but light no others with this technique");
    if (r->environment && plan->sky_lights == 0)
        lsf_plan_remark(plan, "environment.directions=0: the environment is seen, but lights "
                              "nothing");
}

static uint32_t record_count(const lsf_pass_params *params, const lsf_vpl_cloud_use *use)
{
    lsf_vpl_cloud_shape shape = lsf_vpl_cloud_shape_of(&params->vpl_cloud, use);
    return lsf_vpl_cloud_records(&shape);
}

static void plan_substitute_tree(lsf_plan *plan, const lsf_pass_params *params,
                                 const lsf_state *state)
{
    lsf_vpl_cloud_use use = cloud_use(plan, state);
    plan->refracted = is_traced(&use) && lsf_specular_path_media(plan, &params->specular_path);
    if (is_traced(&use)) {
        lsf_voxel_chain_use voxels = chain_use(plan, params, state);
        lsf_voxel_chain_plan(plan, params, state, &voxels);
        if (use.lights)
            lsf_reflective_shadow_map_plan(
                plan, &params->reflective_shadow_map, state,
                &(lsf_reflective_shadow_map_use){.sky = plan->sky_lights > 0});
        else
            lsf_plan_omit(plan, "reflective_shadow_map", "no light but what surfaces emit bounces");
        lsf_vpl_cloud_plan(plan, &params->vpl_cloud, &use);
        lsf_light_tree_plan(plan, &params->light_tree, record_count(params, &use), "vpl_cloud");
        lsf_sparse_chain_plan_split(plan, params, 1);
        lsf_light_tree_sample_plan(plan, &params->light_tree_sample, params->light_tree.covariance,
                                   lsf_specular_path_lobes(plan, &params->specular_path));
        if (lsf_specular_path_chain_needed(plan, params))
            lsf_specular_path_chain_plan(
                plan, params, state,
                &(lsf_specular_path_use){.reads = "light_tree_sample.specular voxel_light",
                                         .factor = 1,
                                         .interleave = 1});
        lsf_sparse_chain_plan_finish(plan, params, 1);
    } else {
        lsf_direct_chain_plan(plan, params, state, NULL);
        lsf_plan_omit(plan, "light_tree",
                      lsf_voxel_chain_has_voxels(plan) ? "no light bounces, no surface emits light"
                                                       : "the scene has no triangles");
    }
    lsf_compose_plan(plan, &(lsf_compose_use){.direct = lsf_light_any(plan, state),
                                              .indirect = is_traced(&use)});
    remark(plan);
}

static bool create_lights(substitute_tree *t, lsf_context *context, const lsf_plan *plan,
                          const lsf_scene *scene, const lsf_state *state, lsf_error *error)
{
    return lsf_light_picks_init(&t->picks, plan, scene, state, plan->sky_lights > 0, error) &&
           lsf_reflective_shadow_map_create(&t->rsm, context, plan, error);
}

static bool create_traced(substitute_tree *t, lsf_context *context, const lsf_plan *plan,
                          const lsf_pass_params *params, const lsf_scene_gpu *scene,
                          const lsf_state *state, lsf_error *error)
{
    lsf_voxel_chain_use voxels = chain_use(plan, params, state);
    return lsf_voxel_chain_create(&t->chain, context, plan, params, scene, state, &voxels, error) &&
           (!t->use.lights || create_lights(t, context, plan, scene->scene, state, error)) &&
           lsf_vpl_cloud_create(&t->cloud, context, plan, &params->vpl_cloud, &t->use, scene->scene,
                                state, error) &&
           lsf_light_tree_create(&t->tree, context, plan, &params->light_tree,
                                 record_count(params, &t->use), error) &&
           lsf_light_tree_sample_create(&t->sample, context, plan, &params->light_tree_sample,
                                        error) &&
           (!lsf_specular_path_chain_needed(plan, params) ||
            lsf_specular_path_create(
                &t->paths, context, plan, &params->specular_path, 1,
                &(lsf_specular_path_targets){.specular = t->sample.light.specular}, scene->scene,
                state, error)) &&
           lsf_sparse_chain_create(&t->sparse, context, plan, params, error);
}

static bool create_substitute_tree(void **self, lsf_context *context, const lsf_plan *plan,
                                   const lsf_pass_params *params, const lsf_scene_gpu *scene,
                                   const lsf_state *state, lsf_error *error)
{
    substitute_tree *t = *self = lsf_alloc(1, sizeof *t);
    if (!t)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    t->use = cloud_use(plan, state);
    return (is_traced(&t->use) ? create_traced(t, context, plan, params, scene, state, error)
                               : lsf_direct_chain_create(&t->chain.direct, context, plan, params,
                                                         scene, NULL, error)) &&
           lsf_compose_create(&t->compose, context, plan, error);
}

static lsf_update update_substitute_tree(void *self, const lsf_pass_params *params,
                                         const lsf_iteration *iteration, const lsf_changes *changes)
{
    substitute_tree *t = self;
    if (!is_traced(&t->use))
        return LSF_UPDATE_DONE;
    if (changes->lights && t->use.lights)
        lsf_light_picks_update(&t->picks, iteration->plan, iteration->scene->scene,
                               iteration->state);
    if ((changes->moved || changes->materials) &&
        (!lsf_vpl_cloud_follow(&t->cloud, changes->materials) ||
         !lsf_specular_path_follow(&t->paths, changes->materials)))
        return LSF_UPDATE_FAILED;
    lsf_voxel_chain_use voxels = chain_use(iteration->plan, params, iteration->state);
    return lsf_voxel_chain_update(&t->chain, params, iteration, &voxels, changes);
}

/* The first vertices of the light's paths, where it has any in this iteration. */
static void begin_paths(substitute_tree *t, const lsf_iteration *iteration, uint32_t light)
{
    lsf_vpl_cloud_run run = lsf_vpl_cloud_deal(&t->cloud, iteration, &t->picks.distribution, light);
    if (run.count == 0)
        return;
    lsf_reflective_shadow_map_run(&t->rsm, iteration, light, &t->chain.direct.gbuffer.outputs.seen);
    const lsf_reflective_shadow_map_outputs *out = &t->rsm.outputs;
    const lsf_vpl_cloud_inputs inputs = {&out->shadow, &out->seen, out->importance, out->sums};
    lsf_vpl_cloud_light(&t->cloud, iteration, &run, &inputs);
}

static void fill_cloud(substitute_tree *t, const lsf_iteration *iteration)
{
    lsf_vpl_cloud_begin(&t->cloud, iteration, t->picks.power);
    for (uint32_t i = 0; t->use.lights && i < iteration->light_count; i++)
        if (lsf_iteration_goes_on(iteration))
            begin_paths(t, iteration, i);
    lsf_vpl_cloud_bounce(&t->cloud, iteration, t->chain.voxels);
}

/* Light of the cloud on visible points. */
static lsf_split_light gather(substitute_tree *t, const lsf_iteration *iteration)
{
    const lsf_surface_maps *seen = &t->chain.direct.gbuffer.outputs.seen;
    lsf_light_tree_run(&t->tree, iteration, t->cloud.records);
    const lsf_light_tree_sample_inputs inputs = {
        .seen = lsf_sparse_chain_split(&t->sparse, iteration, seen),
        .voxels = t->chain.voxels,
        .tree = &t->tree.outputs};
    lsf_light_tree_sample_run(&t->sample, iteration, &inputs);
    if (t->paths.timer) {
        const lsf_path_inputs paths = lsf_voxel_chain_paths(&t->chain, inputs.seen);
        t->paths.lobe_kernel = lsf_light_tree_sample_lobe_kernel(&t->sample, iteration);
        lsf_specular_path_run(&t->paths, iteration, &paths);
    }
    return lsf_sparse_chain_finish(&t->sparse, iteration, seen, &t->sample.light);
}

static void run_substitute_tree(void *self, const lsf_iteration *iteration,
                                lsf_technique_outputs *outputs)
{
    substitute_tree *t = self;
    lsf_split_light light = {0};
    t->chain.direct.gbuffer.lobe_angle = lsf_iteration_sky_angle(iteration);
    if (is_traced(&t->use)) {
        lsf_voxel_chain_begin(&t->chain, iteration);
        lsf_voxel_chain_lights(&t->chain, iteration, t->chain.lit);
        fill_cloud(t, iteration);
        light = gather(t, iteration);
    } else {
        lsf_direct_chain_run(&t->chain.direct, iteration);
    }
    lsf_light_parts parts = lsf_direct_chain_parts(&t->chain.direct);
    parts.indirect = light;
    lsf_compose_run(&t->compose, iteration, &parts);
    *outputs = (lsf_technique_outputs){
        .parts = parts, .layers = t->compose.outputs, .bounded = t->sample.params.bound > 0.0f};
}

static void destroy_substitute_tree(void *self)
{
    substitute_tree *t = self;
    if (!t)
        return;
    lsf_compose_destroy(&t->compose);
    lsf_sparse_chain_destroy(&t->sparse);
    lsf_specular_path_destroy(&t->paths);
    lsf_light_tree_sample_destroy(&t->sample);
    lsf_light_tree_destroy(&t->tree);
    lsf_vpl_cloud_destroy(&t->cloud);
    lsf_reflective_shadow_map_destroy(&t->rsm);
    lsf_light_picks_finish(&t->picks);
    lsf_voxel_chain_destroy(&t->chain);
    free(t);
}

static uint32_t report_substitute_tree(void *self,
                                       lsf_pass_report reports[LSF_TECHNIQUE_MAX_PASSES])
{
    substitute_tree *t = self;
    uint32_t count = lsf_voxel_chain_report(&t->chain, reports);
    const lsf_pass_report candidates[] = {
        {t->rsm.timer, LSF_DRAW_COUNTS, lsf_draw_count_names, t->rsm.counts},
        {.timer = t->rsm.pdf_timer},
        {.timer = t->cloud.emitter_timer},
        {.timer = t->cloud.light_timer},
        {.timer = t->cloud.bounce_timer},
        {.timer = t->tree.sort_timer},
        {.timer = t->tree.timer},
    };
    for (size_t i = 0; i < LSF_COUNT(candidates); i++)
        if (candidates[i].timer)
            reports[count++] = candidates[i];
    count += lsf_sparse_chain_report_split(&t->sparse, reports + count);
    if (t->sample.timer)
        reports[count++] = (lsf_pass_report){t->sample.timer, LSF_LIGHT_TREE_SAMPLE_COUNTS,
                                             lsf_light_tree_sample_count_names,
                                             lsf_light_tree_sample_counts(&t->sample)};
    if (t->paths.timer)
        reports[count++] = (lsf_pass_report){.timer = t->paths.timer};
    count += lsf_sparse_chain_report_finish(&t->sparse, reports + count);
    reports[count++] = (lsf_pass_report){.timer = t->compose.timer};
    return count;
}

static const char *const groups[] = {"cloud",  "light_tree", "specular_path", "rsm", "voxel",
                                     "sparse", NULL};

const lsf_technique lsf_technique_substitute_tree = {
    .name = "substitute_tree",
    .help = "global illumination by a tree over a hundred thousand virtual point lights",
    .groups = groups,
    .bounces = true,
    .draws_alone = true,
    .traces_pixels = true,
    .points_per_second = 0x1p16f, /* a point took 16 us of a core with one sample of the cloud */
    .plan = plan_substitute_tree,
    .create = create_substitute_tree,
    .update = update_substitute_tree,
    .run = run_substitute_tree,
    .destroy = destroy_substitute_tree,
    .report = report_substitute_tree,
};
