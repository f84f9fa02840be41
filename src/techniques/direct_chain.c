#include "techniques/direct_chain.h"

static lsf_direct_light_use light_use(const lsf_pass_params *params,
                                      const lsf_direct_chain_use *use)
{
    lsf_direct_light_use light = {.shadow_pcf =
                                      params->shadow_map.filter == LSF_SHADOW_FILTER_PCF};
    if (use) {
        light.chance = use->chance;
        light.paths[0] = use->paths[0];
        light.paths[1] = use->paths[1];
    }
    return light;
}

void lsf_direct_chain_plan(lsf_plan *plan, const lsf_pass_params *params, const lsf_state *state,
                           const lsf_direct_chain_use *use)
{
    lsf_gbuffer_plan(plan);
    if (lsf_light_any(plan, state)) {
        lsf_shadow_map_plan(plan, &params->shadow_map, state);
        lsf_direct_light_use light = light_use(params, use);
        lsf_direct_light_plan(plan, &light);
    } else {
        lsf_plan_omit(plan, "shadow_map", "no light but what surfaces emit");
        lsf_plan_omit(plan, "direct_light", "no light but what surfaces emit");
    }
}

bool lsf_direct_chain_create(lsf_direct_chain *chain, lsf_context *context, const lsf_plan *plan,
                             const lsf_pass_params *params, const lsf_scene_gpu *scene,
                             const lsf_direct_chain_use *use, lsf_error *error)
{
    lsf_direct_light_use light = light_use(params, use);
    chain->lit = lsf_plan_find_pass(plan, "direct_light") != NULL;
    return lsf_gbuffer_create(&chain->gbuffer, context, plan, &params->gbuffer, scene, error) &&
           (!chain->lit || (lsf_shadow_map_create(&chain->shadow_map, context, plan, error) &&
                            lsf_direct_light_create(&chain->direct_light, context, plan, &light, error)));
}

void lsf_direct_chain_begin(lsf_direct_chain *chain, const lsf_iteration *iteration)
{
    lsf_gbuffer_run(&chain->gbuffer, iteration);
    if (chain->lit)
        lsf_direct_light_clear(&chain->direct_light);
}

void lsf_direct_chain_light(lsf_direct_chain *chain, const lsf_iteration *iteration, uint32_t light)
{
    const lsf_gbuffer_outputs *gbuffer = &chain->gbuffer.outputs;
    lsf_shadow_map_run(&chain->shadow_map, iteration, light);
    lsf_direct_light_inputs inputs = {
        .depth = gbuffer->depth,
        .surface = gbuffer->surface,
        .gloss = gbuffer->gloss,
        .shadow_depth = chain->shadow_map.outputs.depth,
        .shadow_gradient = chain->shadow_map.outputs.gradient,
        .shadow_tint = chain->shadow_map.outputs.tint,
    };
    lsf_direct_light_run(&chain->direct_light, iteration, &inputs);
}

void lsf_direct_chain_run(lsf_direct_chain *chain, const lsf_iteration *iteration)
{
    lsf_direct_chain_begin(chain, iteration);
    for (uint32_t i = 0; i < iteration->light_count && lsf_iteration_goes_on(iteration); i++)
        lsf_direct_chain_light(chain, iteration, i);
}

void lsf_direct_chain_destroy(lsf_direct_chain *chain)
{
    lsf_direct_light_destroy(&chain->direct_light);
    lsf_shadow_map_destroy(&chain->shadow_map);
    lsf_gbuffer_destroy(&chain->gbuffer);
}

uint32_t lsf_direct_chain_report(lsf_direct_chain *chain, lsf_pass_report *reports)
{
    uint32_t count = 0;
    reports[count++] = (lsf_pass_report){chain->gbuffer.timer, LSF_DRAW_COUNTS,
                                         lsf_draw_count_names, chain->gbuffer.counts};
    if (chain->lit) {
        reports[count++] = (lsf_pass_report){chain->shadow_map.timer, LSF_DRAW_COUNTS,
                                             lsf_draw_count_names, chain->shadow_map.counts};
        reports[count++] = (lsf_pass_report){.timer = chain->direct_light.timer};
    }
    return count;
}
