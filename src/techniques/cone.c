/* Cone tracing: light that voxels send out, gathered by cones through its pyramid.
 * C. Crassin, F. Neyret, M. Sainz, S. Green and E. Eisemann, "Interactive Indirect Illumination
 * Using Voxel Cone Tracing", 2011. */
#include <stdlib.h>

#include "base/base.h"
#include "frame/emitter_points.h"
#include "frame/purpose.h"
#include "passes/compose.h"
#include "passes/cone_trace.h"
#include "passes/specular_path.h"
#include "passes/voxel_bounce.h"
#include "passes/voxel_draw.h"
#include "passes/voxel_mip.h"
#include "techniques/sparse_chain.h"
#include "techniques/voxel_chain.h"

/* How light is carried, decided from the scene and the options. */
typedef struct variant {
    bool traced;      /* light comes to visible points in other ways than directly from punctual
                       * lights */
    bool draws;       /* sides of voxels by their radiance */
    bool lamps;       /* smooth metals mirror lamps */
    bool refracts;    /* what media transmit to the eye */
    bool emitters;    /* points on emissive surfaces are drawn */
    bool shines;      /* surfaces or an environment emit */
    uint32_t levels;  /* of radiance */
    uint32_t bounces; /* from voxel to voxel */
} variant;

/* Light of punctual lights is on voxels already, and the last bounce is at visible points; light of
 * surfaces and environments has to come to voxels first. */
static variant choose_variant(const lsf_plan *plan, const lsf_pass_params *params,
                              const lsf_state *state)
{
    const lsf_requirements *r = &plan->requirements;
    variant w = {.levels = lsf_cone_levels(&params->cone),
                 .shines = r->emissive || r->unlit || r->environment};
    w.draws = lsf_cone_draws(&params->cone);
    w.traced = lsf_voxel_chain_has_voxels(plan) && (plan->bounces > 0 || w.shines);
    w.lamps = w.traced && plan->bounces > 0 && lsf_voxel_lamps(plan, state) &&
              params->cone.sealed && lsf_cone_slices(&params->cone) == LSF_VOXEL_SIDES_SURFACE;
    w.refracts = w.traced && params->cone.sealed &&
                 lsf_cone_slices(&params->cone) == LSF_VOXEL_SIDES_SURFACE &&
                 lsf_specular_path_media(plan, &params->specular_path);
    w.emitters = w.traced && lsf_cone_emitters(&params->cone, plan);
    if (w.traced && plan->bounces > 0)
        w.bounces = plan->bounces - (w.shines ? 0 : 1);
    return w;
}

/* Points on emitters are drawn before the first pass that reads them. */
static const char *emitter_name(const variant *w)
{
    return w->bounces > 0 ? "voxel_bounce.emitters" : "cone_trace.emitters";
}

typedef struct cone {
    lsf_context *context;
    variant variant;
    lsf_voxel_chain chain;
    lsf_voxel_mip mip;
    lsf_voxel_draw draw;
    lsf_emitter_points emitters;
    lsf_voxel_bounce bounce;
    lsf_cone_trace trace;
    lsf_specular_path paths;
    lsf_sparse_chain sparse;
    lsf_compose compose;
} cone;

/* Refracted paths end where they meet a surface, and cost little beside the rest. */
#define SPECULAR_PATH_FACTOR 4

static lsf_voxel_chain_use chain_use(const lsf_pass_params *params, const variant *w)
{
    uint32_t slices = lsf_cone_slices(&params->cone);
    return (lsf_voxel_chain_use){
        .sides = slices,
        .levels = w->levels,
        .direct = {params->cone.sealed ? LSF_SKY_CHANCE_LOBES : LSF_SKY_CHANCE_DIFFUSE,
                   {(float)params->cone.count, (float)params->cone.count}},
        .lamps = w->lamps,
        .voxel_rays = (float)params->cone.count,
        .bytes_per_voxel = (8 * slices * 8 / 7 + 1) * (w->bounces < 2 ? w->bounces : 2)};
}

static void remark(lsf_plan *plan, const variant *w)
{
    const lsf_requirements *r = &plan->requirements;
    if (w->shines)
        lsf_plan_remark(plan, "with cones, direct light of surfaces and environments is in the "
                              "indirect layers");
    if (r->anisotropic && w->levels > 1)
        lsf_plan_remark(plan, "cones of anisotropic surfaces are round");
}

static void plan_cone(lsf_plan *plan, const lsf_pass_params *params, const lsf_state *state)
{
    variant w = choose_variant(plan, params, state);
    plan->refracted = w.refracts;
    plan->voxel_chance = w.traced && plan->straight && !params->cone.sealed;
    if (w.traced) {
        lsf_voxel_chain_use use = chain_use(params, &w);
        lsf_voxel_chain_plan(plan, params, state, &use);
        if (w.levels > 1)
            lsf_voxel_mip_plan(plan, use.sides);
        else
            lsf_plan_omit(plan, "voxel_mip", "no cone marches: each is the ray along its axis");
        lsf_voxel_grid grid = lsf_voxel_chain_grid(plan, params, state, &use);
        if (w.bounces > 0)
            lsf_voxel_bounce_plan(plan, &params->cone, &grid, w.bounces > 1, w.lamps);
        else
            lsf_plan_omit(plan, "voxel_bounce", "light does not go from voxel to voxel");
        if (w.emitters && w.bounces > 0)
            lsf_emitter_points_plan(plan, emitter_name(&w));
        if (w.draws)
            lsf_voxel_draw_plan(plan, &grid, use.sides, w.emitters);
        lsf_sparse_chain_plan_split(plan, params, 1);
        bool mirrors = params->cone.sealed && plan->bounces > 1 && lsf_voxel_mirrors(plan, state);
        lsf_cone_trace_plan(plan, &params->cone, mirrors, w.lamps);
        if (w.emitters && w.bounces == 0)
            lsf_emitter_points_plan(plan, emitter_name(&w));
        if (w.refracts)
            lsf_specular_path_plan(
                plan, &params->specular_path,
                &(lsf_specular_path_use){.reads = "cone_trace.specular voxel_bounce|voxel_light",
                                         .factor = SPECULAR_PATH_FACTOR,
                                         .interleave = 1,
                                         .mirrors = mirrors,
                                         .lamps = w.lamps});
        lsf_sparse_chain_plan_finish(plan, params, 1);
    } else {
        lsf_direct_chain_plan(plan, params, state, NULL);
        lsf_plan_omit(plan, "cone_trace", "no light bounces");
    }
    lsf_compose_plan(
        plan, &(lsf_compose_use){.direct = lsf_light_any(plan, state), .indirect = w.traced});
    remark(plan, &w);
}

static bool create_traced(cone *c, lsf_context *context, const lsf_plan *plan,
                          const lsf_pass_params *params, const lsf_scene_gpu *scene,
                          const lsf_state *state, lsf_error *error)
{
    lsf_voxel_chain_use use = chain_use(params, &c->variant);
    const lsf_voxel_grid *grid = &c->chain.grid;
    return lsf_voxel_chain_create(&c->chain, context, plan, params, scene, state, &use, error) &&
           (c->variant.levels == 1 ||
            lsf_voxel_mip_create(&c->mip, context, plan, grid, use.sides, error)) &&
           (!c->variant.draws || lsf_voxel_draw_create(&c->draw, context, plan, error)) &&
           (!c->variant.emitters ||
            lsf_emitter_points_create(&c->emitters, context, plan, emitter_name(&c->variant),
                                      scene->scene, state, error)) &&
           (c->variant.bounces == 0 ||
            lsf_voxel_bounce_create(&c->bounce, context, plan, &params->cone, grid, error)) &&
           lsf_cone_trace_create(&c->trace, context, plan, &params->cone, grid, error) &&
           (!c->variant.refracts ||
            lsf_specular_path_create(
                &c->paths, context, plan, &params->specular_path, SPECULAR_PATH_FACTOR,
                &(lsf_specular_path_targets){.specular = c->trace.light.specular}, scene->scene,
                state, error)) &&
           lsf_sparse_chain_create(&c->sparse, context, plan, params, error);
}

static bool create_cone(void **self, lsf_context *context, const lsf_plan *plan,
                        const lsf_pass_params *params, const lsf_scene_gpu *scene,
                        const lsf_state *state, lsf_error *error)
{
    cone *c = *self = lsf_alloc(1, sizeof *c);
    if (!c)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    c->context = context;
    c->variant = choose_variant(plan, params, state);
    return (c->variant.traced ? create_traced(c, context, plan, params, scene, state, error)
                              : lsf_direct_chain_create(&c->chain.direct, context, plan, params,
                                                        scene, NULL, error)) &&
           lsf_compose_create(&c->compose, context, plan, error);
}

static lsf_update update_cone(void *self, const lsf_pass_params *params,
                              const lsf_iteration *iteration, const lsf_changes *changes)
{
    cone *c = self;
    lsf_voxel_chain_use use = chain_use(params, &c->variant);
    if ((changes->moved || changes->materials) &&
        !lsf_emitter_points_follow(&c->emitters, changes->materials))
        return LSF_UPDATE_FAILED;
    lsf_update update = lsf_voxel_chain_update(&c->chain, params, iteration, &use, changes);
    c->mip.grid = c->bounce.grid = c->trace.grid = c->chain.grid;
    return update;
}

/* What cones and rays need to find the light of voxels. */
static void prepare(cone *c, const lsf_iteration *iteration, GLuint radiance)
{
    if (c->variant.levels > 1)
        lsf_voxel_mip_run(&c->mip, c->chain.voxels, radiance);
    if (c->variant.draws)
        lsf_voxel_draw_run(&c->draw, iteration, c->chain.voxels, radiance);
}

/* Light on voxels, with as many bounces between them as there are to be; returns its pyramid. With
 * E what voxels emit, D what they reflect of punctual lights, and R what they reflect of each other
 * and of the environment: X_0 = E or, where nothing shines, D; X_k = E + D + R(X_k-1). */
static GLuint light_voxels(cone *c, const lsf_iteration *iteration)
{
    const lsf_voxels *voxels = c->chain.voxels;
    GLuint base = c->chain.light.radiance, light = base;
    const lsf_emitter_points *emitters = c->variant.emitters ? &c->emitters : NULL;
    uint32_t done = 0;
    lsf_voxel_draw_begin(&c->draw);
    if (emitters)
        lsf_emitter_points_draw(&c->emitters, iteration, LSF_PURPOSE_VOXEL_EMITTER);
    if (c->variant.bounces > 0)
        lsf_voxel_bounce_begin(&c->bounce, voxels);
    if (c->variant.bounces > 0 && c->variant.shines) {
        const lsf_voxel_bounce_sum reflected = {.source = base,
                                                .lamps = c->chain.light.lamps,
                                                .draws = c->draw.list,
                                                .emitters = emitters,
                                                .later = c->variant.bounces - 1};
        const lsf_voxel_bounce_sum all = {.base = base, .keep = true};
        lsf_voxel_chain_emit(&c->chain);
        prepare(c, iteration, base);
        lsf_voxel_bounce_run(&c->bounce, iteration, voxels, &reflected);
        lsf_voxel_chain_lights(&c->chain, iteration, true);
        light = lsf_voxel_bounce_run(&c->bounce, iteration, voxels, &all);
        done = 1;
    } else {
        lsf_voxel_chain_lights(&c->chain, iteration, iteration->plan->bounces > 0);
    }
    prepare(c, iteration, light);
    for (; done < c->variant.bounces; done++) {
        const lsf_voxel_bounce_sum sum = {.base = base,
                                          .source = light,
                                          .lamps = c->chain.light.lamps,
                                          .lit = true,
                                          .draws = c->draw.list,
                                          .emitters = emitters,
                                          .later = c->variant.bounces - 1 - done};
        light = lsf_voxel_bounce_run(&c->bounce, iteration, voxels, &sum);
        prepare(c, iteration, light);
    }
    return light;
}

/* Light of voxels and the environment on visible points. */
static lsf_split_light trace(cone *c, const lsf_iteration *iteration)
{
    const lsf_surface_maps *seen = &c->chain.direct.gbuffer.outputs.seen;
    lsf_voxel_chain_begin(&c->chain, iteration);
    const lsf_cone_trace_inputs inputs = {.seen =
                                              lsf_sparse_chain_split(&c->sparse, iteration, seen),
                                          .voxels = c->chain.voxels,
                                          .radiance = light_voxels(c, iteration),
                                          .lamps = c->chain.light.lamps,
                                          .draws = c->draw.list,
                                          .emitters = c->variant.emitters ? &c->emitters : NULL};
    lsf_cone_trace_run(&c->trace, iteration, &inputs);
    if (c->variant.refracts) {
        lsf_path_inputs paths = lsf_voxel_chain_paths(&c->chain, inputs.seen);
        paths.radiance = inputs.radiance; /* with the light that has bounced */
        lsf_specular_path_run(&c->paths, iteration, &paths);
    }
    return lsf_sparse_chain_finish(&c->sparse, iteration, seen, &c->trace.light);
}

static void run_cone(void *self, const lsf_iteration *iteration, lsf_technique_outputs *outputs)
{
    cone *c = self;
    lsf_split_light light = {0};
    /* The roughness whose lobe is as narrow as a voxel seen over half the scene's extent:
     * narrower ones show no more. */
    c->chain.direct.gbuffer.lobe_angle =
        c->variant.traced ? lsf_voxel_solid_angle(&c->chain.grid) : 0.0f;
    if (c->variant.traced)
        light = trace(c, iteration);
    else
        lsf_direct_chain_run(&c->chain.direct, iteration);
    lsf_light_parts parts = lsf_direct_chain_parts(&c->chain.direct);
    parts.indirect = light;
    lsf_compose_run(&c->compose, iteration, &parts);
    *outputs = (lsf_technique_outputs){.parts = parts, .layers = c->compose.outputs};
    if (c->variant.traced)
        outputs->voxels = lsf_voxel_chain_view(&c->chain, iteration);
}

static void destroy_cone(void *self)
{
    cone *c = self;
    if (!c)
        return;
    lsf_compose_destroy(&c->compose);
    lsf_sparse_chain_destroy(&c->sparse);
    lsf_emitter_points_destroy(&c->emitters, c->context);
    lsf_specular_path_destroy(&c->paths);
    lsf_cone_trace_destroy(&c->trace);
    lsf_voxel_bounce_destroy(&c->bounce);
    lsf_voxel_draw_destroy(&c->draw);
    lsf_voxel_mip_destroy(&c->mip);
    lsf_voxel_chain_destroy(&c->chain);
    free(c);
}

static uint32_t report_cone(void *self, lsf_pass_report reports[LSF_TECHNIQUE_MAX_PASSES])
{
    cone *c = self;
    uint32_t count = lsf_voxel_chain_report(&c->chain, reports);
    if (c->variant.traced) {
        if (c->variant.bounces > 0)
            reports[count++] = (lsf_pass_report){.timer = c->bounce.timer};
        if (c->variant.levels > 1)
            reports[count++] = (lsf_pass_report){.timer = c->mip.timer};
        if (c->variant.draws)
            reports[count++] = (lsf_pass_report){.timer = c->draw.timer};
        count += lsf_sparse_chain_report_split(&c->sparse, reports + count);
        reports[count++] = (lsf_pass_report){.timer = c->trace.timer};
        if (c->variant.refracts)
            reports[count++] = (lsf_pass_report){.timer = c->paths.timer};
        count += lsf_sparse_chain_report_finish(&c->sparse, reports + count);
    }
    reports[count++] = (lsf_pass_report){.timer = c->compose.timer};
    return count;
}

static const char *const groups[] = {"voxel", "cone", "specular_path", "sparse", NULL};

const lsf_technique lsf_technique_cone = {
    .name = "cone",
    .help = "global illumination by cones through voxels",
    .groups = groups,
    .bounces = true,
    .draws_lobes = true,
    .traces_pixels = true,
    .points_per_second = 0x1p18f,
    .voxels_in_a_second = 64,
    .plan = plan_cone,
    .create = create_cone,
    .update = update_cone,
    .run = run_cone,
    .destroy = destroy_cone,
    .report = report_cone,
};
