#include "sandbox/engine.h"

#include <string.h>

#include "base/base.h"
#include "shared/light.h"
#include "shared/sandbox_data.h"
#include "shared/scene_data.h"

static bool has(const lsf_sandbox_engine *engine, lsf_sandbox_need need)
{
    return engine->setup->own & need;
}

static bool plans(const lsf_sandbox_engine *engine, const char *pass)
{
    return lsf_plan_find_pass(engine->setup->plan, pass) != NULL;
}

static bool create_voxels(lsf_sandbox_engine *engine, lsf_error *error)
{
    const lsf_sandbox_setup *setup = engine->setup;
    const lsf_pass_params *params = &setup->setup.pass_params;
    const lsf_plan *plan = setup->plan;
    if (!has(engine, LSF_NEED_VOXELS))
        return true;
    engine->grid = lsf_sandbox_grid(setup);
    lsf_voxel_grid_set_unit(&engine->grid, setup->setup.scene, &setup->setup.state);
    if (!lsf_voxelize_create(&engine->voxelize, engine->context, plan, &params->voxelize,
                             &engine->grid, setup->setup.scene, error))
        return false;
    lsf_voxel_light_use use = lsf_sandbox_voxel_light(setup);
    if (!has(engine, LSF_NEED_RADIANCE))
        return true;
    if (!lsf_voxel_light_create(&engine->voxel_light, engine->context, plan, &use, error) ||
        !lsf_voxel_mip_create(&engine->voxel_mip, engine->context, plan, &engine->grid, use.sides,
                              error))
        return false;
    /* Shaders ask for places between texels, and between levels. */
    GLuint radiance = engine->voxel_light.radiance;
    glTextureParameteri(radiance, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(radiance, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return true;
}

static bool create_own(lsf_sandbox_engine *engine, lsf_error *error)
{
    lsf_sandbox_setup *own = engine->setup;
    lsf_setup *setup = &own->setup;
    lsf_context *context = engine->context;
    const lsf_state *previous = lsf_setup_previous(setup);
    const lsf_pass_params *params = &setup->pass_params;
    const lsf_ray_bundle_use use = lsf_sandbox_bundle(own);
    return lsf_scene_gpu_create(&engine->gpu, context, setup->plan, setup->scene, &setup->state,
                                previous, error) &&
           lsf_iteration_create(&engine->iteration, context, setup->plan, &engine->gpu,
                                &setup->state, previous, setup->params.seed, error) &&
           (!has(engine, LSF_NEED_GBUFFER) ||
            lsf_gbuffer_create(&engine->gbuffer, context, setup->plan, &params->gbuffer,
                               &engine->gpu, error)) &&
           (!plans(engine, "shadow_map") ||
            lsf_shadow_map_create(&engine->shadow_map, context, setup->plan, error)) &&
           (!plans(engine, "sky_map") ||
            lsf_sky_map_create(&engine->sky_map, context, setup->plan, &engine->gpu, error)) &&
           (!has(engine, LSF_NEED_REFLECTIVE) ||
            lsf_reflective_shadow_map_create(&engine->reflective, context, setup->plan, error)) &&
           create_voxels(engine, error) &&
           (!has(engine, LSF_NEED_BUNDLE) ||
            lsf_ray_bundle_create(&engine->bundle, context, setup->plan, &params->ray_bundle, &use,
                                  error)) &&
           lsf_plan_create_buffer_if_planned(setup->plan, context, "sandbox.lights", NULL,
                                             GL_DYNAMIC_STORAGE_BIT, &engine->lights, error);
}

bool lsf_sandbox_engine_create(lsf_sandbox_engine *engine, lsf_context *context,
                               lsf_sandbox_setup *setup, const lsf_sandbox_text *text,
                               lsf_error *error)
{
    lsf_float3 along = lsf_f3_load(text->bundle);
    *engine = (lsf_sandbox_engine){.context = context,
                                   .setup = setup,
                                   .aim_is_view = !text->bundle_given,
                                   .aim.pdf = 1.0f,
                                   .jitter = text->jitter,
                                   .light = text->light};
    if (text->bundle_given)
        lsf_f3_store(engine->aim.direction, lsf_f3_normalize(along));
    if (!lsf_plan_check(setup->plan, context, error) ||
        (setup->own != 0 && !create_own(engine, error)))
        return false;
    if (setup->picture)
        engine->renderer = lsf_renderer_create(context, setup->scene, &setup->params, error);
    return !setup->picture || engine->renderer;
}

/* --- a frame --- */

static void upload_lights(const lsf_sandbox_engine *engine)
{
    const lsf_state *state = &engine->setup->setup.state;
    for (uint32_t i = 0; engine->lights && i < state->light_count; i++) {
        const lsf_light_state *light = &state->lights[i];
        const float *p = light->position, *d = light->direction, *c = light->intensity;
        float scale = 0.0f, offset = 1.0f;
        if (light->type == LSF_LIGHT_SPOT) {
            scale = lsf_spot_scale(light->cos_inner, light->cos_outer);
            offset = -light->cos_outer * scale;
        }
        const struct lsf_sandbox_light_data data = {
            .position = {p[0], p[1], p[2], 0.0f},
            .direction = {d[0], d[1], d[2], 0.0f},
            .intensity = {c[0], c[1], c[2], 0.0f},
            .attenuation = {1.0f / (light->range * light->range), scale, offset,
                            (float)light->type}};
        glNamedBufferSubData(engine->lights, (GLintptr)(i * sizeof data), sizeof data, &data);
    }
}

/* As voxel techniques light theirs, with each light that there is. */
static void run_voxels(lsf_sandbox_engine *engine)
{
    const lsf_iteration *iteration = &engine->iteration;
    engine->voxels = lsf_voxelize_run(engine->voxelize, iteration);
    if (!has(engine, LSF_NEED_RADIANCE))
        return;
    lsf_voxel_light *light = &engine->voxel_light;
    lsf_shadow_map *map = &engine->shadow_map;
    lsf_voxel_light_begin(light, engine->voxels);
    for (uint32_t i = 0; map->timer && i < iteration->state->light_count; i++) {
        if (iteration->lights[i].type == LSF_LIGHT_DIRECTIONAL)
            lsf_shadow_map_run_scene(map, iteration, i);
        else
            lsf_shadow_map_run(map, iteration, i);
        lsf_voxel_light_add(light, iteration, engine->voxels, &map->outputs.shadow);
    }
    if (engine->sky_map.timer)
        lsf_sky_map_begin_scene(&engine->sky_map, iteration);
    while (engine->sky_map.timer && lsf_sky_map_next(&engine->sky_map, iteration))
        lsf_voxel_light_add_sky(light, iteration, engine->voxels, &engine->sky_map.outputs.shadow,
                                engine->sky_map.outputs.count);
    lsf_voxel_light_emit(light, engine->voxels);
    lsf_voxel_mip_run(&engine->voxel_mip, engine->voxels, light->radiance);
}

static void run_bundle(lsf_sandbox_engine *engine)
{
    const lsf_iteration *iteration = &engine->iteration;
    const lsf_plan *plan = iteration->plan;
    const lsf_surface_maps *seen = &engine->gbuffer.outputs.seen;
    const lsf_region region = {0, 0, (int32_t)plan->width, (int32_t)plan->height, 0, 0};
    const lsf_ray_bundle_origins origins = {.depth = seen->depth, .surface = seen->surface};
    uint32_t done;
    if (engine->aim_is_view)
        lsf_f3_store(engine->aim.direction,
                     lsf_f3_normalize(lsf_f3_load(iteration->state->camera.forward)));
    lsf_ray_bundle_aim(engine->bundle, iteration, &engine->aim, seen->depth);
    do {
        lsf_ray_bundle_build(engine->bundle, iteration, 0);
        if (has(engine, LSF_NEED_HITS))
            engine->hits = lsf_ray_bundle_search(engine->bundle, iteration, 0, &origins, &region);
        lsf_ray_bundle_end(engine->bundle, iteration);
    } while (!lsf_ray_bundle_settle(engine->bundle, iteration, true, &done));
}

static void run_passes(lsf_sandbox_engine *engine)
{
    const lsf_iteration *iteration = &engine->iteration;
    upload_lights(engine);
    if (has(engine, LSF_NEED_GBUFFER))
        lsf_gbuffer_run(&engine->gbuffer, iteration);
    if (has(engine, LSF_NEED_VOXELS))
        run_voxels(engine);
    if (has(engine, LSF_NEED_REFLECTIVE))
        lsf_reflective_shadow_map_run(&engine->reflective, iteration, engine->light, NULL);
    else if (has(engine, LSF_NEED_SHADOW)) /* last: lights take turns at the map */
        lsf_shadow_map_run(&engine->shadow_map, iteration, engine->light);
    if (has(engine, LSF_NEED_BUNDLE))
        run_bundle(engine);
}

/* False: voxels need a grid of another size. */
static bool follow_grid(lsf_sandbox_engine *engine)
{
    const lsf_changes *changes = &engine->setup->setup.changes;
    if (!engine->voxelize || !(changes->moved || changes->lights || changes->materials))
        return true;
    lsf_voxel_grid grid = lsf_sandbox_grid(engine->setup);
    if (memcmp(grid.size, engine->grid.size, sizeof grid.size) != 0)
        return false;
    grid.unit = engine->grid.unit;
    engine->grid = engine->voxel_mip.grid = grid;
    lsf_voxelize_follow(engine->voxelize, &grid, changes->materials);
    return true;
}

static lsf_update run_own(lsf_sandbox_engine *engine, const lsf_sandbox_frame *frame,
                          lsf_error *error)
{
    lsf_setup *setup = &engine->setup->setup;
    const lsf_frame at = {.time = frame->time, .view = frame->view};
    if (!lsf_setup_frame(setup, &at, error))
        return LSF_UPDATE_FAILED;
    if (!lsf_setup_fits(setup) || !follow_grid(engine))
        return LSF_UPDATE_REPLAN;
    const lsf_changes *c = &setup->changes;
    const lsf_state *previous = lsf_setup_previous(setup);
    bool changed = c->view || c->moved || c->lights || c->shining || c->materials;
    if (engine->ran && !changed && !engine->jitter && !has(engine, LSF_NEED_MOTION))
        return LSF_UPDATE_DONE;
    lsf_scene_gpu_update(&engine->gpu, &setup->state, previous);
    lsf_iteration_frame(&engine->iteration, &setup->state, previous,
                        engine->jitter ? frame->number : 0);
    lsf_iteration_begin(&engine->iteration, 0);
    run_passes(engine);
    engine->ran = true;
    return LSF_UPDATE_DONE;
}

static bool run_picture(lsf_sandbox_engine *engine, const lsf_sandbox_frame *frame,
                        lsf_error *error)
{
    static const uint32_t aovs[4] = {0, LSF_AOV_DIRECT, LSF_AOV_INDIRECT_DIFFUSE,
                                     LSF_AOV_INDIRECT_SPECULAR};
    const lsf_frame at = {.time = frame->time, .view = frame->view};
    if (!lsf_renderer_begin_frame(engine->renderer, &at, error) ||
        !lsf_renderer_run(engine->renderer, error))
        return false;
    for (int i = 0; i < 4; i++)
        if (aovs[i] == 0 || (engine->setup->params.aovs & aovs[i]))
            engine->picture[i] = lsf_renderer_texture(engine->renderer, aovs[i], error);
    return lsf_context_check(engine->context, error);
}

lsf_update lsf_sandbox_engine_run(lsf_sandbox_engine *engine, const lsf_sandbox_frame *frame,
                                  lsf_error *error)
{
    if (engine->setup->own != 0) {
        lsf_update update = run_own(engine, frame, error);
        if (update != LSF_UPDATE_DONE)
            return update;
    }
    if (engine->renderer && !run_picture(engine, frame, error))
        return LSF_UPDATE_FAILED;
    return LSF_UPDATE_DONE;
}

/* --- what shaders read --- */

static void bind_seen(const lsf_sandbox_engine *engine)
{
    const lsf_renderer *renderer = engine->renderer;
    const lsf_gbuffer_maps *maps = &engine->gbuffer.outputs;
    const lsf_iteration *iteration = &engine->iteration;
    if (renderer && !has(engine, LSF_NEED_GBUFFER)) {
        maps = renderer->outputs.parts.gbuffer;
        iteration = &renderer->iteration;
    }
    if (iteration->view_buffer)
        lsf_iteration_bind_view(iteration);
    if (!maps)
        return;
    lsf_surface_maps_bind(&maps->seen);
    lsf_bind_texture(LSF_UNIT_SEEN_EMISSION, maps->emission);
    lsf_bind_texture(LSF_UNIT_SEEN_MOTION, maps->motion);
}

static void bind_voxels(const lsf_sandbox_engine *engine)
{
    const lsf_voxels *voxels = engine->voxels;
    lsf_voxels_bind_grid(voxels);
    for (GLuint level = 0; level < LSF_VOXEL_OCCUPANCY_LEVELS; level++)
        lsf_bind_texture(LSF_UNIT_VOXEL_OCCUPANCY + level, voxels->occupancy[level]);
    lsf_bind_texture(LSF_UNIT_VOXEL_ALBEDO, voxels->albedo);
    lsf_bind_texture(LSF_UNIT_VOXEL_NORMAL, voxels->normal);
    lsf_bind_texture(LSF_UNIT_VOXEL_RADIANCE, engine->voxel_light.radiance);
}

void lsf_sandbox_engine_bind(const lsf_sandbox_engine *engine, uint32_t needs)
{
    bind_seen(engine);
    for (GLuint i = 0; i < 4; i++)
        lsf_bind_texture(LSF_UNIT_PICTURE + i, engine->picture[i]);
    if (engine->lights)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_SANDBOX_LIGHTS, engine->lights);
    if (has(engine, LSF_NEED_REFLECTIVE)) {
        const lsf_reflective_shadow_map_outputs *map = &engine->reflective.outputs;
        lsf_shadow_bind(&map->shadow);
        lsf_bind_texture(LSF_UNIT_REFLECTIVE_SURFACE, map->seen.surface);
        lsf_bind_texture(LSF_UNIT_REFLECTIVE_SPECULAR_PARAMS, map->seen.specular_params);
    } else if (has(engine, LSF_NEED_SHADOW)) {
        lsf_shadow_bind(&engine->shadow_map.outputs.shadow);
    }
    if (has(engine, LSF_NEED_VOXELS))
        bind_voxels(engine);
    if (needs & LSF_NEED_ENVIRONMENT)
        lsf_scene_gpu_bind_environment(&engine->gpu);
    if (has(engine, LSF_NEED_BUNDLE)) {
        const lsf_bundle_nodes nodes = lsf_ray_bundle_nodes(engine->bundle, 0);
        lsf_bundle_nodes_bind(&nodes);
        lsf_bind_texture(LSF_UNIT_BUNDLE_HITS, engine->hits);
    }
}

uint32_t lsf_sandbox_engine_report(lsf_sandbox_engine *engine, lsf_timer **timers)
{
    lsf_timer *bundle[3] = {NULL};
    uint32_t count = 0;
    if (engine->bundle)
        lsf_ray_bundle_timers(engine->bundle, bundle);
    lsf_timer *const candidates[LSF_SANDBOX_ENGINE_TIMERS] = {
        engine->gbuffer.timer,
        engine->shadow_map.timer,
        engine->sky_map.timer,
        engine->reflective.timer,
        engine->voxelize ? lsf_voxelize_timer(engine->voxelize) : NULL,
        engine->voxel_light.timer,
        engine->voxel_mip.timer,
        bundle[1],
        bundle[2]};
    for (size_t i = 0; i < LSF_COUNT(candidates); i++)
        if (candidates[i])
            timers[count++] = candidates[i];
    return count;
}

void lsf_sandbox_engine_destroy(lsf_sandbox_engine *engine)
{
    if (!engine->context)
        return;
    lsf_renderer_destroy(engine->renderer);
    lsf_buffer_destroy(engine->context, &engine->lights);
    lsf_ray_bundle_destroy(engine->bundle);
    lsf_voxel_mip_destroy(&engine->voxel_mip);
    lsf_voxel_light_destroy(&engine->voxel_light);
    lsf_voxelize_destroy(engine->voxelize);
    lsf_reflective_shadow_map_destroy(&engine->reflective);
    lsf_shadow_map_destroy(&engine->shadow_map);
    lsf_sky_map_destroy(&engine->sky_map);
    lsf_gbuffer_destroy(&engine->gbuffer);
    if (engine->iteration.context)
        lsf_iteration_destroy(&engine->iteration);
    if (engine->gpu.context)
        lsf_scene_gpu_destroy(&engine->gpu);
    *engine = (lsf_sandbox_engine){0};
}
