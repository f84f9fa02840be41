#include "techniques/voxel_chain.h"

#include <string.h>

/* Levels of a texture take a seventh more than its finest. */
static uint32_t bytes_per_voxel(const lsf_plan *plan, const lsf_pass_params *params,
                                const lsf_voxel_chain_use *use)
{
    uint32_t radiance = 8 * use->sides, lamps = use->lamps ? 16 * use->sides : 0;
    return lsf_voxelize_bytes(plan, params->voxel_grid.jitter) + radiance + lamps +
           (use->levels > 1 ? (radiance + 6) / 7 : 0) + use->bytes_per_voxel;
}

static lsf_voxel_light_use light_use(const lsf_pass_params *params, const lsf_state *state,
                                     const lsf_voxel_chain_use *use)
{
    return (lsf_voxel_light_use){.sides = use->sides,
                                 .levels = use->levels,
                                 .lights = state->light_count > 0,
                                 .lamps = use->lamps,
                                 .sky_rays = use->voxel_rays,
                                 .pcf = params->shadow_map.filter == LSF_SHADOW_FILTER_PCF};
}

bool lsf_voxel_chain_has_voxels(const lsf_plan *plan)
{
    return plan->requirements.triangles > 0;
}

lsf_voxel_grid lsf_voxel_chain_grid(const lsf_plan *plan, const lsf_pass_params *params,
                                    const lsf_state *state, const lsf_voxel_chain_use *use)
{
    const lsf_voxel_grid_use grid = {.voxels = plan->voxels,
                                     .bytes = bytes_per_voxel(plan, params, use),
                                     .sides = use->sides > 0 ? use->sides : 1};
    return lsf_voxel_grid_fit(&params->voxel_grid, state, &grid);
}

static void plan_light(lsf_plan *plan, const lsf_pass_params *params, const lsf_state *state,
                       const lsf_voxel_chain_use *use, const lsf_voxel_grid *grid)
{
    lsf_voxel_light_use light = light_use(params, state, use);
    lsf_shadow_map_plan_scene(plan, &params->shadow_map, state,
                              LSF_VOXEL_LIGHT_TEXELS * grid->resolution);
    if (plan->sky_lights > 0)
        lsf_sky_map_plan_scene(plan, LSF_VOXEL_LIGHT_SKY_TEXELS * grid->resolution);
    lsf_voxel_light_plan(plan, grid, &light);
    if (lsf_voxel_view_needed(plan))
        lsf_voxel_view_plan(plan, use->sides);
}

void lsf_voxel_chain_plan(lsf_plan *plan, const lsf_pass_params *params, const lsf_state *state,
                          const lsf_voxel_chain_use *use)
{
    bool lit = use->sides > 0;
    lsf_gbuffer_plan(plan);
    if (!lsf_voxel_chain_has_voxels(plan)) {
        lsf_plan_omit(plan, "voxelize", "the scene has no triangles");
        lsf_direct_chain_plan_lights(plan, params, state, &use->direct);
        if (lit)
            lsf_plan_omit(plan, "voxel_light", "the scene has no triangles");
        return;
    }
    lsf_voxel_grid grid = lsf_voxel_chain_grid(plan, params, state, use);
    lsf_voxel_grid_remark(plan, &params->voxel_grid, &grid);
    if (plan->bounces > 0 || plan->requirements.emissive || plan->requirements.environment)
        plan->grain = (lsf_plan_grain){.width = grid.side,
                                       .cell = "a voxel",
                                       .of = "grid",
                                       .option = "voxel.resolution",
                                       .instead = ", or take the bidirectional technique"};
    lsf_voxelize_plan(plan, &params->voxelize, &grid);
    lsf_direct_chain_plan_lights(plan, params, state, &use->direct);
    if (lit)
        plan_light(plan, params, state, use, &grid);
}

bool lsf_voxel_chain_create(lsf_voxel_chain *chain, lsf_context *context, const lsf_plan *plan,
                            const lsf_pass_params *params, const lsf_scene_gpu *scene,
                            const lsf_state *state, const lsf_voxel_chain_use *use,
                            lsf_error *error)
{
    if (!lsf_direct_chain_create(&chain->direct, context, plan, params, scene, &use->direct, error))
        return false;
    if (!lsf_voxel_chain_has_voxels(plan))
        return true;
    lsf_voxel_light_use light = light_use(params, state, use);
    chain->grid = lsf_voxel_chain_grid(plan, params, state, use);
    lsf_voxel_grid_set_unit(&chain->grid, scene->scene, state);
    chain->lit = use->sides > 0;
    return lsf_voxelize_create(&chain->voxelize, context, plan, &params->voxelize, &chain->grid,
                               scene->scene, error) &&
           (!chain->lit || lsf_voxel_light_create(&chain->light, context, plan, &light, error)) &&
           (!lsf_plan_find_pass(plan, "voxel_view") ||
            lsf_voxel_view_create(&chain->view, context, plan, error));
}

lsf_update lsf_voxel_chain_update(lsf_voxel_chain *chain, const lsf_pass_params *params,
                                  const lsf_iteration *iteration, const lsf_voxel_chain_use *use,
                                  const lsf_changes *changes)
{
    if (!chain->voxelize || !(changes->moved || changes->lights || changes->materials))
        return LSF_UPDATE_DONE;
    lsf_voxel_grid grid = lsf_voxel_chain_grid(iteration->plan, params, iteration->state, use);
    if (memcmp(grid.size, chain->grid.size, sizeof grid.size) != 0)
        return LSF_UPDATE_REPLAN;
    grid.unit = chain->grid.unit;
    if (changes->lights || changes->materials)
        lsf_voxel_grid_set_unit(&grid, iteration->scene->scene, iteration->state);
    chain->grid = grid;
    lsf_voxelize_follow(chain->voxelize, &grid, changes->materials);
    return LSF_UPDATE_DONE;
}

/* The map that the camera's points were lit with serves voxels too, but for that of a directional
 * light, which is fitted to what the camera sees. */
static void light_voxels(lsf_voxel_chain *chain, const lsf_iteration *iteration, uint32_t light)
{
    lsf_shadow_map *map = &chain->direct.shadow_map;
    if (iteration->lights[light].type == LSF_LIGHT_DIRECTIONAL)
        lsf_shadow_map_run_scene(map, iteration, light);
    lsf_voxel_light_add(&chain->light, iteration, chain->voxels, &map->outputs.shadow);
}

void lsf_voxel_chain_begin(lsf_voxel_chain *chain, const lsf_iteration *iteration)
{
    lsf_direct_chain_begin(&chain->direct, iteration);
    if (!chain->voxelize)
        return;
    chain->voxels = lsf_voxelize_run(chain->voxelize, iteration);
    if (chain->lit)
        lsf_voxel_light_begin(&chain->light, chain->voxels);
}

void lsf_voxel_chain_emit(lsf_voxel_chain *chain)
{
    if (chain->lit)
        lsf_voxel_light_emit(&chain->light, chain->voxels);
}

/* Voxels are lit by the maps of what the camera sees, where they hold the whole scene, and by maps
 * of the other directions that do. */
static void run_sky(lsf_voxel_chain *chain, const lsf_iteration *iteration, bool on_voxels)
{
    lsf_sky_map *map = &chain->direct.sky_map;
    lsf_direct_chain_sky_begin(&chain->direct, iteration, chain->voxels);
    while (lsf_direct_chain_sky_next(&chain->direct, iteration))
        if (on_voxels && map->outputs.whole > 0)
            lsf_voxel_light_add_sky(&chain->light, iteration, chain->voxels, &map->outputs.shadow,
                                    map->outputs.count);
    if (!on_voxels)
        return;
    lsf_sky_map_begin_scene(map, iteration);
    while (lsf_iteration_goes_on(iteration) && lsf_sky_map_next(map, iteration))
        lsf_voxel_light_add_sky(&chain->light, iteration, chain->voxels, &map->outputs.shadow,
                                map->outputs.count);
}

void lsf_voxel_chain_lights(lsf_voxel_chain *chain, const lsf_iteration *iteration, bool on_voxels)
{
    uint32_t lights = iteration->state->light_count;
    on_voxels = on_voxels && chain->voxelize;
    for (uint32_t i = 0; i < lights && lsf_iteration_goes_on(iteration); i++) {
        lsf_direct_chain_light(&chain->direct, iteration, i);
        if (on_voxels)
            light_voxels(chain, iteration, i);
    }
    if (chain->direct.sky_map.timer)
        run_sky(chain, iteration, on_voxels);
    lsf_voxel_chain_emit(chain); /* where no light has brought it along */
}

lsf_path_inputs lsf_voxel_chain_paths(const lsf_voxel_chain *chain, const lsf_surface_maps *seen)
{
    return (lsf_path_inputs){.seen = seen,
                             .far_side = chain->direct.gbuffer.outputs.far_side,
                             .far_color = chain->direct.gbuffer.outputs.far_color,
                             .voxels = chain->voxels,
                             .grid = &chain->grid,
                             .radiance = chain->light.radiance,
                             .lamps = chain->light.lamps};
}

lsf_voxel_view_outputs lsf_voxel_chain_view(lsf_voxel_chain *chain, const lsf_iteration *iteration)
{
    if (chain->view.program)
        lsf_voxel_view_run(&chain->view, iteration, chain->voxels, chain->light.radiance);
    return chain->view.outputs;
}

void lsf_voxel_chain_run(lsf_voxel_chain *chain, const lsf_iteration *iteration)
{
    lsf_voxel_chain_begin(chain, iteration);
    lsf_voxel_chain_lights(chain, iteration, true);
}

void lsf_voxel_chain_destroy(lsf_voxel_chain *chain)
{
    lsf_voxel_view_destroy(&chain->view);
    lsf_voxel_light_destroy(&chain->light);
    lsf_voxelize_destroy(chain->voxelize);
    lsf_direct_chain_destroy(&chain->direct);
}

uint32_t lsf_voxel_chain_report(lsf_voxel_chain *chain, lsf_pass_report *reports)
{
    uint32_t count = lsf_direct_chain_report(&chain->direct, reports);
    if (!chain->voxelize)
        return count;
    reports[count++] =
        (lsf_pass_report){lsf_voxelize_timer(chain->voxelize), LSF_VOXELIZE_COUNTS,
                          lsf_voxelize_count_names, lsf_voxelize_counts(chain->voxelize)};
    if (chain->lit)
        reports[count++] = (lsf_pass_report){.timer = chain->light.timer};
    if (chain->view.timer)
        reports[count++] = (lsf_pass_report){.timer = chain->view.timer};
    return count;
}
