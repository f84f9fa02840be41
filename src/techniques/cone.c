/* Cone tracing: light that voxels send out, gathered by cones through its pyramid.
 * C. Crassin, F. Neyret, M. Sainz, S. Green and E. Eisemann, "Interactive Indirect Illumination
 * Using Voxel Cone Tracing", 2011. */
#include <stdlib.h>

#include "base/base.h"
#include "passes/blur.h"
#include "passes/compose.h"
#include "passes/cone_trace.h"
#include "passes/upsample_search.h"
#include "passes/voxel_bounce.h"
#include "passes/voxel_mip.h"
#include "techniques/voxel_chain.h"

/* How light goes, decided from the scene and the options. */
typedef struct way {
    bool traced;            /* to visible points otherwise than straight from punctual lights */
    bool shines;            /* from surfaces or an environment */
    uint32_t levels;        /* of radiance */
    bool coarse;            /* cones are traced on a grid of fewer texels than pixels */
    uint32_t width, height; /* of the grid */
    uint32_t bounces;       /* from voxel to voxel */
} way;

/* Light of punctual lights is on voxels already, and the last bounce is at visible points; light of
 * surfaces and environments has to come to voxels first. */
static way choose_way(const lsf_plan *plan, const lsf_pass_params *params)
{
    const lsf_requirements *r = &plan->requirements;
    way w = {.levels = lsf_cone_levels(&params->cone),
             .shines = r->emissive || r->unlit || r->environment,
             .width = lsf_coarse_grid_length(plan->width, params->cone.scale),
             .height = lsf_coarse_grid_length(plan->height, params->cone.scale)};
    w.coarse = lsf_coarse_grid_is_coarse(plan, w.width, w.height);
    w.traced = lsf_voxel_chain_has_voxels(plan) && (plan->bounces > 0 || w.shines);
    if (w.traced && plan->bounces > 0)
        w.bounces = plan->bounces - (w.shines ? 0 : 1);
    return w;
}

typedef struct cone {
    way way;
    lsf_voxel_chain chain;
    lsf_voxel_mip mip;
    lsf_voxel_bounce bounce;
    lsf_cone_trace trace;
    lsf_blur blur;
    lsf_upsample_search upsample;
    lsf_compose compose;
} cone;

static lsf_voxel_chain_use chain_use(const lsf_pass_params *params, const way *w)
{
    uint32_t slices = lsf_cone_slices(&params->cone);
    return (lsf_voxel_chain_use){
        .sides = slices,
        .levels = w->levels,
        .direct = {params->cone.sealed ? LSF_SKY_CHANCE_LOBES : LSF_SKY_CHANCE_DIFFUSE,
                   {(float)params->cone.count, (float)params->cone.count}},
        .voxel_rays = (float)params->cone.count,
        .bytes_per_voxel = (8 * slices * 8 / 7 + 1) * (w->bounces < 2 ? w->bounces : 2)};
}

static void remark(lsf_plan *plan, const way *w)
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
    way w = choose_way(plan, params);
    if (w.traced) {
        lsf_voxel_chain_use use = chain_use(params, &w);
        lsf_voxel_chain_plan(plan, params, state, &use);
        if (w.levels > 1)
            lsf_voxel_mip_plan(plan, use.sides);
        else
            lsf_plan_omit(plan, "voxel_mip", "no cone marches: each is the ray along its axis");
        lsf_voxel_grid grid = lsf_voxel_chain_grid(plan, params, state, &use);
        if (w.bounces > 0)
            lsf_voxel_bounce_plan(plan, &params->cone, &grid, w.bounces > 1);
        else
            lsf_plan_omit(plan, "voxel_bounce", "light does not go from voxel to voxel");
        lsf_cone_trace_plan(plan, &params->cone, w.width, w.height);
        lsf_blur_plan(plan, &params->blur, w.width, w.height);
        lsf_upsample_search_plan(plan, &params->upsample_search, w.width, w.height);
        lsf_blur_remark(plan, &params->blur);
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
    lsf_voxel_chain_use use = chain_use(params, &c->way);
    const lsf_voxel_grid *grid = &c->chain.grid;
    return lsf_voxel_chain_create(&c->chain, context, plan, params, scene, state, &use, error) &&
           (c->way.levels == 1 ||
            lsf_voxel_mip_create(&c->mip, context, plan, grid, use.sides, error)) &&
           (c->way.bounces == 0 ||
            lsf_voxel_bounce_create(&c->bounce, context, plan, &params->cone, grid, error)) &&
           lsf_cone_trace_create(&c->trace, context, plan, &params->cone, grid, error) &&
           (!lsf_blur_wanted(&params->blur) ||
            lsf_blur_create(&c->blur, context, plan, &params->blur, error)) &&
           (!c->way.coarse || lsf_upsample_search_create(&c->upsample, context, plan,
                                                         &params->upsample_search, error));
}

static bool create_cone(void **self, lsf_context *context, const lsf_plan *plan,
                        const lsf_pass_params *params, const lsf_scene_gpu *scene,
                        const lsf_state *state, lsf_error *error)
{
    cone *c = *self = lsf_alloc(1, sizeof *c);
    if (!c)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    c->way = choose_way(plan, params);
    return (c->way.traced ? create_traced(c, context, plan, params, scene, state, error)
                          : lsf_direct_chain_create(&c->chain.direct, context, plan, params, scene,
                                                    NULL, error)) &&
           lsf_compose_create(&c->compose, context, plan, error);
}

static lsf_update update_cone(void *self, const lsf_pass_params *params,
                              const lsf_iteration *iteration, const lsf_changes *changes)
{
    cone *c = self;
    lsf_voxel_chain_use use = chain_use(params, &c->way);
    lsf_update update = lsf_voxel_chain_update(&c->chain, params, iteration, &use, changes);
    c->mip.grid = c->bounce.grid = c->trace.grid = c->chain.grid;
    return update;
}

static void build_pyramid(cone *c, GLuint radiance)
{
    if (c->way.levels > 1)
        lsf_voxel_mip_run(&c->mip, c->chain.voxels, radiance);
}

/* Light on voxels, with as many bounces between them as there are to be; returns its pyramid. With
 * E what voxels emit, D what they reflect of punctual lights, and R what they reflect of each other
 * and of the environment: X_0 = E or, where nothing shines, D; X_k = E + D + R(X_k-1). */
static GLuint light_voxels(cone *c, const lsf_iteration *iteration)
{
    const lsf_voxels *voxels = c->chain.voxels;
    GLuint base = c->chain.light.radiance, light = base;
    uint32_t done = 0;
    if (c->way.bounces > 0)
        lsf_voxel_bounce_begin(&c->bounce, voxels);
    if (c->way.bounces > 0 && c->way.shines) {
        const lsf_voxel_bounce_sum reflected = {.source = base};
        const lsf_voxel_bounce_sum all = {.base = base, .keep = true};
        lsf_voxel_chain_emit(&c->chain);
        build_pyramid(c, base);
        lsf_voxel_bounce_run(&c->bounce, iteration, voxels, &reflected);
        lsf_voxel_chain_lights(&c->chain, iteration, true);
        light = lsf_voxel_bounce_run(&c->bounce, iteration, voxels, &all);
        done = 1;
    } else {
        lsf_voxel_chain_lights(&c->chain, iteration, iteration->plan->bounces > 0);
    }
    build_pyramid(c, light);
    for (; done < c->way.bounces; done++) {
        const lsf_voxel_bounce_sum sum = {.base = base, .source = light};
        light = lsf_voxel_bounce_run(&c->bounce, iteration, voxels, &sum);
        build_pyramid(c, light);
    }
    return light;
}

/* What voxels and the environment shed on visible points. */
static lsf_split_light trace(cone *c, const lsf_iteration *iteration)
{
    const lsf_surface_maps *all = &c->chain.direct.gbuffer.outputs.seen, *seen = all;
    lsf_voxel_chain_begin(&c->chain, iteration);
    lsf_coarse_grid grid = lsf_coarse_grid_at(iteration, c->way.width, c->way.height);
    if (c->way.coarse) {
        lsf_upsample_search_split(&c->upsample, iteration, all);
        grid = c->upsample.grid;
        seen = &c->upsample.coarse;
    }
    const lsf_cone_trace_inputs inputs = {.grid = &grid,
                                          .seen = seen,
                                          .voxels = c->chain.voxels,
                                          .radiance = light_voxels(c, iteration)};
    lsf_cone_trace_run(&c->trace, iteration, &inputs);
    const lsf_split_light *light = &c->trace.light;
    if (c->blur.program) {
        const lsf_blur_inputs patterned = {.grid = &grid, .seen = seen, .light = light};
        lsf_blur_run(&c->blur, iteration, &patterned);
        light = &c->blur.light;
    }
    if (!c->way.coarse)
        return *light;
    lsf_upsample_search_run(&c->upsample, iteration, all, light);
    return c->upsample.light;
}

static void run_cone(void *self, const lsf_iteration *iteration, lsf_technique_outputs *outputs)
{
    cone *c = self;
    lsf_split_light light = {0};
    if (c->way.traced)
        light = trace(c, iteration);
    else
        lsf_direct_chain_run(&c->chain.direct, iteration);
    lsf_light_parts parts = lsf_direct_chain_parts(&c->chain.direct);
    parts.indirect = light;
    lsf_compose_run(&c->compose, iteration, &parts);
    *outputs = (lsf_technique_outputs){.parts = parts, .layers = c->compose.outputs};
    if (c->way.traced)
        outputs->voxels = lsf_voxel_chain_view(&c->chain, iteration);
}

static void destroy_cone(void *self)
{
    cone *c = self;
    if (!c)
        return;
    lsf_compose_destroy(&c->compose);
    lsf_upsample_search_destroy(&c->upsample);
    lsf_blur_destroy(&c->blur);
    lsf_cone_trace_destroy(&c->trace);
    lsf_voxel_bounce_destroy(&c->bounce);
    lsf_voxel_mip_destroy(&c->mip);
    lsf_voxel_chain_destroy(&c->chain);
    free(c);
}

static uint32_t report_cone(void *self, lsf_pass_report reports[LSF_TECHNIQUE_MAX_PASSES])
{
    cone *c = self;
    uint32_t count = lsf_voxel_chain_report(&c->chain, reports);
    if (c->way.traced) {
        if (c->way.bounces > 0)
            reports[count++] = (lsf_pass_report){.timer = c->bounce.timer};
        if (c->way.levels > 1)
            reports[count++] = (lsf_pass_report){.timer = c->mip.timer};
        if (c->way.coarse)
            reports[count++] = (lsf_pass_report){.timer = c->upsample.split_timer};
        reports[count++] = (lsf_pass_report){.timer = c->trace.timer};
        if (c->blur.program)
            reports[count++] = (lsf_pass_report){.timer = c->blur.timer};
        if (c->way.coarse)
            reports[count++] = (lsf_pass_report){.timer = c->upsample.timer};
    }
    reports[count++] = (lsf_pass_report){.timer = c->compose.timer};
    return count;
}

static const char *const groups[] = {"voxel", "cone", "blur", "upsample_search", NULL};

const lsf_technique lsf_technique_cone = {
    .name = "cone",
    .help = "global illumination by cones through voxels",
    .groups = groups,
    .bounces = true,
    .draws_lobes = true,
    .plan = plan_cone,
    .create = create_cone,
    .update = update_cone,
    .run = run_cone,
    .destroy = destroy_cone,
    .report = report_cone,
};
