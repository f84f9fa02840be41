#include "techniques/direct_chain.h"

#include "base/base.h"

/* Samples of the environment's light without shadows that a pixel takes of each kind. In the open
 * it counts on nearly all of that light; frames that keep light are to be fast, and so are pictures
 * whose time is short. */
static uint32_t open_samples(const lsf_plan *plan, const lsf_sky_light_params *params)
{
    if (params->open >= 0)
        return (uint32_t)params->open;
    if (plan->open)
        return plan->temporal && plan->filtered ? 32 : 64;
    return plan->hurried ? 8 : 32;
}

static lsf_direct_light_use light_use(const lsf_plan *plan, const lsf_pass_params *params,
                                      const lsf_direct_chain_use *use)
{
    lsf_direct_light_use light = {.shadow_pcf = params->shadow_map.filter == LSF_SHADOW_FILTER_PCF};
    if (lsf_sky_light_is_controlled(plan->sky_lights, &params->sky_light)) {
        light.sky.open_samples = 1;
        light.sky.control = params->sky_light.control == LSF_SKY_LIGHT_WHOLE
                                ? LSF_SKY_CONTROL_WHOLE
                                : LSF_SKY_CONTROL_SHARE;
        uint32_t points = plan->pixel_side * plan->pixel_side; /* of a pixel share its samples */
        uint32_t samples = open_samples(plan, &params->sky_light);
        while (2 * points * light.sky.open_samples <= samples)
            light.sky.open_samples *= 2;
    }
    if (use) {
        light.sky.chance = use->chance;
        light.sky.paths[0] = use->paths[0];
        light.sky.paths[1] = use->paths[1];
        light.sky.lobes = use->lobes && light.sky.control == LSF_SKY_CONTROL_SHARE;
    }
    return light;
}

void lsf_direct_chain_plan_lights(lsf_plan *plan, const lsf_pass_params *params,
                                  const lsf_state *state, const lsf_direct_chain_use *use)
{
    bool sky = plan->sky_lights > 0;
    if (state->light_count > 0)
        lsf_shadow_map_plan(plan, &params->shadow_map, state);
    else if (sky)
        lsf_plan_omit(plan, "shadow_map", "no punctual light");
    if (sky)
        lsf_sky_map_plan(plan, lsf_shadow_map_cascade_side(plan, &params->shadow_map));
    if (lsf_light_any(plan, state)) {
        lsf_direct_light_use light = light_use(plan, params, use);
        lsf_open_sky_plan(plan, &light.sky);
        lsf_direct_light_plan(plan, state->light_count, &light);
    } else {
        lsf_plan_omit(plan, "shadow_map", "no light but what surfaces emit");
        lsf_plan_omit(plan, "direct_light", "no light but what surfaces emit");
    }
}

void lsf_direct_chain_plan(lsf_plan *plan, const lsf_pass_params *params, const lsf_state *state,
                           const lsf_direct_chain_use *use)
{
    lsf_gbuffer_plan(plan);
    lsf_direct_chain_plan_lights(plan, params, state, use);
}

bool lsf_direct_chain_create(lsf_direct_chain *chain, lsf_context *context, const lsf_plan *plan,
                             const lsf_pass_params *params, const lsf_scene_gpu *scene,
                             const lsf_direct_chain_use *use, lsf_error *error)
{
    lsf_direct_light_use light = light_use(plan, params, use);
    chain->lit = lsf_plan_find(plan, "direct_light.radiance") != NULL;
    return lsf_gbuffer_create(&chain->gbuffer, context, plan, &params->gbuffer, scene, error) &&
           (!lsf_plan_find_pass(plan, "shadow_map") ||
            lsf_shadow_map_create(&chain->shadow_map, context, plan, error)) &&
           (!lsf_plan_find_pass(plan, "sky_map") ||
            lsf_sky_map_create(&chain->sky_map, context, plan, scene, error)) &&
           lsf_open_sky_create(&chain->open_sky, context, plan, &light.sky,
                               chain->gbuffer.outputs.seen.depth, error) &&
           (!chain->lit || lsf_direct_light_create(&chain->direct_light, context, plan, &light,
                                                   chain->gbuffer.outputs.seen.depth, error)) &&
           (!lsf_plan_find_pass(plan, "light_importance") ||
            lsf_light_importance_create(&chain->importance, context, plan, error));
}

void lsf_direct_chain_begin(lsf_direct_chain *chain, const lsf_iteration *iteration)
{
    lsf_gbuffer_run(&chain->gbuffer, iteration);
    if (chain->lit)
        lsf_direct_light_clear(&chain->direct_light);
}

void lsf_direct_chain_light(lsf_direct_chain *chain, const lsf_iteration *iteration, uint32_t light)
{
    lsf_shadow_map_run(&chain->shadow_map, iteration, light);
    lsf_direct_light_inputs inputs = {
        .seen = &chain->gbuffer.outputs.seen,
        .shadow = &chain->shadow_map.outputs.shadow,
        .lobe_angle = chain->gbuffer.lobe_angle,
    };
    lsf_direct_light_run(&chain->direct_light, iteration, &inputs);
    lsf_light_importance_run(&chain->importance, iteration, light, chain->direct_light.radiance);
}

void lsf_direct_chain_sky_begin(lsf_direct_chain *chain, const lsf_iteration *iteration,
                                const lsf_voxels *voxels)
{
    lsf_open_sky_run(&chain->open_sky, iteration, &chain->gbuffer.outputs.seen,
                     chain->direct_light.control, voxels);
    lsf_sky_map_begin(&chain->sky_map, iteration);
}

bool lsf_direct_chain_sky_next(lsf_direct_chain *chain, const lsf_iteration *iteration)
{
    const lsf_sky_map_outputs *maps = &chain->sky_map.outputs;
    if (!lsf_iteration_goes_on(iteration) || !lsf_sky_map_next(&chain->sky_map, iteration))
        return false;
    lsf_direct_light_inputs inputs = {.seen = &chain->gbuffer.outputs.seen,
                                      .shadow = &maps->shadow,
                                      .open = chain->open_sky.timer ? &chain->open_sky.light : NULL,
                                      .lobes = chain->open_sky.lobes,
                                      .narrow = chain->open_sky.narrow,
                                      .first = maps->first,
                                      .directions = maps->count};
    lsf_direct_light_run(&chain->direct_light, iteration, &inputs);
    return true;
}

void lsf_direct_chain_lights(lsf_direct_chain *chain, const lsf_iteration *iteration)
{
    uint32_t lights = iteration->state->light_count;
    for (uint32_t i = 0; i < lights && lsf_iteration_goes_on(iteration); i++)
        lsf_direct_chain_light(chain, iteration, i);
    if (!chain->sky_map.timer)
        return;
    lsf_direct_chain_sky_begin(chain, iteration, NULL);
    while (lsf_direct_chain_sky_next(chain, iteration))
        ;
}

void lsf_direct_chain_run(lsf_direct_chain *chain, const lsf_iteration *iteration)
{
    lsf_direct_chain_begin(chain, iteration);
    lsf_direct_chain_lights(chain, iteration);
}

lsf_light_parts lsf_direct_chain_parts(const lsf_direct_chain *chain)
{
    return (lsf_light_parts){.gbuffer = &chain->gbuffer.outputs,
                             .direct = chain->direct_light.radiance,
                             .sky = chain->direct_light.sky};
}

void lsf_direct_chain_destroy(lsf_direct_chain *chain)
{
    lsf_light_importance_destroy(&chain->importance);
    lsf_direct_light_destroy(&chain->direct_light);
    lsf_shadow_map_destroy(&chain->shadow_map);
    lsf_sky_map_destroy(&chain->sky_map);
    lsf_open_sky_destroy(&chain->open_sky);
    lsf_gbuffer_destroy(&chain->gbuffer);
}

uint32_t lsf_direct_chain_report(lsf_direct_chain *chain, lsf_pass_report *reports)
{
    uint32_t count = 0;
    reports[count++] = (lsf_pass_report){chain->gbuffer.timer, LSF_DRAW_COUNTS,
                                         lsf_draw_count_names, chain->gbuffer.counts};
    const lsf_pass_report candidates[] = {
        {chain->shadow_map.timer, LSF_DRAW_COUNTS, lsf_draw_count_names, chain->shadow_map.counts},
        {.timer = chain->direct_light.timer},
        {.timer = chain->importance.timer},
        {.timer = chain->open_sky.timer},
        {chain->sky_map.timer, LSF_DRAW_COUNTS, lsf_draw_count_names, chain->sky_map.counts},
        {.timer = chain->direct_light.sky_timer},
    };
    for (size_t i = 0; i < LSF_COUNT(candidates); i++)
        if (candidates[i].timer)
            reports[count++] = candidates[i];
    return count;
}
