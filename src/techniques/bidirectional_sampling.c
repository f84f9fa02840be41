#include "techniques/bidirectional_sampling.h"

#include <math.h>

#include "base/base.h"
#include "passes/compose.h"
#include "plan/sky_light.h"
#include "techniques/bundle_directions.h"
#include "techniques/direct_chain.h"
#include "techniques/sparse_chain.h"
#include "techniques/specular_path_chain.h"

static uint32_t max_u32(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

/* Lights that have a map: punctual ones, and those that stand for the environment, unless it is
 * uniform: bundles find that as well. */
static bool mapped_light_shines(const lsf_plan *plan, const lsf_state *state)
{
    if (plan->sky_lights > 0 && plan->requirements.environment_map)
        return true;
    for (uint32_t i = 0; i < state->light_count; i++)
        if (lsf_light_power(&state->lights[i]) > 0.0f)
            return true;
    return false;
}

lsf_bidirectional_sampling lsf_bidirectional_sampling_choose(const lsf_plan *plan,
                                                             const lsf_pass_params *params,
                                                             const lsf_state *state)
{
    const lsf_requirements *r = &plan->requirements;
    int strategy = params->bidirectional_shade.strategy;
    int window = params->ray_bundle.window;
    uint32_t vpl_count = (uint32_t)params->vpl.count;
    bool mapped = mapped_light_shines(plan, state) && plan->bounces > 0;
    lsf_bidirectional_sampling s = {
        .bounces = plan->bounces,
        .bundle_count = (uint32_t)params->ray_bundle.count,
        .interleave = (uint32_t)params->sparse.interleave,
        .tiles = (uint32_t)(params->sparse.interleave * params->sparse.interleave)};
    s.vpl_light = mapped && strategy != LSF_BIDIRECTIONAL_BUNDLE && vpl_count > 0;
    s.bundle_light = mapped && strategy != LSF_BIDIRECTIONAL_VPL;
    s.vpl_emitter = r->emissive && strategy != LSF_BIDIRECTIONAL_BUNDLE && vpl_count > 0;
    s.bundle_emitter = r->emissive && !(s.vpl_emitter && strategy == LSF_BIDIRECTIONAL_VPL);
    s.sky_by_maps = lsf_sky_light_is_controlled(plan->sky_lights, &params->sky_light);
    s.emission =
        s.bundle_emitter || r->unlit || (r->environment && (plan->bounces > 0 || !s.sky_by_maps));
    if (s.emission)
        s.segments = plan->bounces + 1;
    else if (s.bundle_light || s.vpl_emitter)
        s.segments = plan->bounces;
    else if (s.vpl_light)
        s.segments = plan->bounces - 1;
    s.whole_scene = window == LSF_RAY_BUNDLE_WINDOW_SCENE ||
                    (window == LSF_RAY_BUNDLE_WINDOW_AUTO && s.segments > 1);
    if (!s.whole_scene && s.segments > 1)
        s.segments = 1;
    /* The last hit is joined to VPLs when light may take one bounce, or two, more. */
    if (s.segments > 0)
        s.vertices =
            (s.vpl_light && s.bounces > s.segments) || (s.vpl_emitter && s.bounces >= s.segments)
                ? s.segments
                : s.segments - 1;
    if (s.segments == 0)
        s.bundle_count = 0;
    else
        s.bundle_count = max_u32(s.bundle_count, max_u32(s.segments, s.tiles));
    s.vpl_count = s.vpl_light ? max_u32(vpl_count, s.tiles) : 0;
    s.emitter_count = s.vpl_emitter ? max_u32(vpl_count, s.tiles) : 0;
    if (!s.vpl_light && !s.vpl_emitter && s.segments == 0)
        s.interleave = s.tiles = 1;
    s.specular_paths = (s.vpl_light || s.vpl_emitter || s.segments > 0) &&
                       lsf_specular_path_chain_needed(plan, params);
    s.split_direct =
        (s.emission || s.vpl_emitter) && lsf_sparse_chain_is_plain(plan, params, s.interleave) &&
        (plan->aovs & (LSF_AOV_DIRECT | LSF_AOV_INDIRECT_DIFFUSE | LSF_AOV_INDIRECT_SPECULAR));
    return s;
}

lsf_ray_bundle_use lsf_bidirectional_bundle_use(const lsf_bidirectional_sampling *s)
{
    return (lsf_ray_bundle_use){.count = s->bundle_count,
                                .slots = s->segments > 1 ? s->bundle_count : 1,
                                .whole_scene = s->whole_scene,
                                .interleave = s->interleave,
                                .deep_vertices = s->segments > 1};
}

lsf_vpl_params lsf_bidirectional_vpl_params(const lsf_pass_params *params,
                                            const lsf_bidirectional_sampling *s)
{
    lsf_vpl_params vpl = params->vpl;
    vpl.count = (int32_t)max_u32(s->vpl_count, s->emitter_count);
    return vpl;
}

static void remark(lsf_plan *plan, const lsf_pass_params *params,
                   const lsf_bidirectional_sampling *s)
{
    const lsf_requirements *r = &plan->requirements;
    if (s->bundle_count > (uint32_t)params->ray_bundle.count)
        lsf_plan_remark(plan,
                        "%u bundles an iteration instead of %d: paths of %u segment%s need as many "
                        "independent directions, and each of %u tile%s a sample",
                        s->bundle_count, params->ray_bundle.count, s->segments,
                        lsf_plural(s->segments), s->tiles, lsf_plural(s->tiles));
    if (max_u32(s->vpl_count, s->emitter_count) > (uint32_t)params->vpl.count)
        lsf_plan_remark(plan, "%u VPLs an iteration instead of %d: each of %u tiles needs one",
                        s->tiles, params->vpl.count, s->tiles);
    if ((s->emission || s->vpl_emitter) && !lsf_sparse_chain_is_plain(plan, params, s->interleave))
        lsf_plan_remark(plan, "where light is shared between pixels (interleave.size, sparse.*), "
                              "direct light of surfaces and environments is in the indirect "
                              "layers");
    if (!s->whole_scene && plan->bounces > 2)
        lsf_plan_remark(plan,
                        "bundle.window=visible ends paths after one bundle: %u bounces are "
                        "2 at most, of light from surfaces %s, and from environments none",
                        plan->bounces, s->vpl_emitter ? "1" : "none");
    else if (!s->whole_scene && plan->bounces > 0 && (r->environment || r->unlit))
        lsf_plan_remark(plan, "bundle.window=visible ends paths after one bundle: light from "
                              "environments and unlit surfaces does not bounce");
    else if (!s->whole_scene && s->emission && plan->bounces > (s->vpl_emitter ? 1u : 0u))
        lsf_plan_remark(plan,
                        "bundle.window=visible ends paths after one bundle: light from "
                        "surfaces bounces %s",
                        s->vpl_emitter ? "once" : "not at all");
}

/* The texels of all islands together, along the longest side of each. */
static float islands_length(const lsf_islands *islands)
{
    float sum = 0.0f;
    for (uint32_t i = 0; i < islands->count; i++) {
        const float *b = islands->bounds[i];
        sum += fmaxf(b[3] - b[0], fmaxf(b[4] - b[1], b[5] - b[2]));
    }
    return sum;
}

void lsf_bidirectional_plan(lsf_plan *plan, const lsf_pass_params *params, const lsf_state *state)
{
    lsf_bidirectional_sampling s = lsf_bidirectional_sampling_choose(plan, params, state);
    lsf_vpl_params vpl = lsf_bidirectional_vpl_params(params, &s);
    plan->random_samples = params->bidirectional_shade.sequence == LSF_BIDIRECTIONAL_RANDOM;
    plan->tiles = s.tiles;
    bool indirect = s.vpl_light || s.vpl_emitter || s.segments > 0;
    plan->refracted = s.specular_paths && lsf_specular_path_media(plan, &params->specular_path);
    if (s.specular_paths) {
        lsf_voxel_chain_use voxels = lsf_specular_path_chain_voxels(plan, params, state);
        lsf_voxel_chain_plan(plan, params, state, &voxels);
    } else {
        lsf_direct_chain_plan(plan, params, state, NULL);
    }
    if (indirect)
        lsf_sparse_chain_plan_split(plan, params, s.interleave);
    if (s.vpl_light || s.bundle_light) {
        lsf_light_importance_plan(plan, state->light_count);
        lsf_reflective_shadow_map_plan(
            plan, &params->reflective_shadow_map, state,
            &(lsf_reflective_shadow_map_use){.sky = plan->sky_lights > 0 &&
                                                    plan->requirements.environment_map,
                                             .few_vpls = true});
    } else {
        lsf_plan_omit(plan, "reflective_shadow_map", "no punctual light bounces");
    }
    if (s.vpl_light || s.vpl_emitter)
        lsf_vpl_plan(plan, &vpl, &(lsf_vpl_use){.lights = s.vpl_light, .emitters = s.vpl_emitter});
    else
        lsf_plan_omit(plan, "vpl", "%s",
                      s.bundle_light || s.bundle_emitter
                          ? "bidirectional.strategy is bundle, or vpl.count 0"
                          : "no punctual light bounces, no surface emits light");
    if (s.segments > 0) {
        lsf_ray_bundle_use use = lsf_bidirectional_bundle_use(&s);
        lsf_bundle_directions_plan(plan);
        lsf_ray_bundle_plan(plan, &params->ray_bundle, &use);
        if (s.whole_scene)
            plan->grain = (lsf_plan_grain){
                .width = islands_length(&plan->islands) / (float)params->ray_bundle.resolution,
                .cell = "a texel of ray-bundles",
                .of = "map",
                .option = "bundle.resolution",
                .instead = s.segments > 1 ? ", or let light bounce once" : ""};
    } else {
        lsf_plan_omit(plan, "ray_bundle",
                      s.vpl_light || s.vpl_emitter ? "VPLs alone light visible points"
                                                   : "no light bounces");
    }
    if (indirect) {
        lsf_bidirectional_shade_use use = {
            .segments = s.segments,
            .vertices = s.vertices,
            .vpl_light = s.vpl_light,
            .vpl_emitter = s.vpl_emitter,
            .hit_light = s.bundle_light,
            .deep_vpl = s.segments > 0 &&
                        ((s.vpl_light && s.bounces > 1) || (s.vpl_emitter && s.bounces > 0)),
            .split_direct = s.split_direct,
            .lobes = s.specular_paths && lsf_specular_path_lobes(plan, &params->specular_path),
            .interleave = s.interleave};
        lsf_bidirectional_shade_plan(plan, &params->bidirectional_shade, &use);
        if (s.specular_paths)
            lsf_specular_path_chain_plan(
                plan, params, state,
                &(lsf_specular_path_use){.reads = "bidirectional_shade.specular voxel_light",
                                         .factor = 1,
                                         .interleave = s.interleave,
                                         .split_direct = s.split_direct});
        lsf_sparse_chain_plan_finish(plan, params, s.interleave);
    } else {
        lsf_plan_omit(plan, "bidirectional_shade", "no light bounces");
    }
    lsf_compose_plan(plan, &(lsf_compose_use){.direct = lsf_light_any(plan, state),
                                              .indirect = indirect,
                                              .split_direct = s.split_direct});
    remark(plan, params, &s);
}
