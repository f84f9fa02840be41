/* Direct light of punctual sources, by shadow maps. Emissive surfaces and the environment are seen
 * but light nothing. */
#include <stdlib.h>

#include "base/base.h"
#include "passes/compose.h"
#include "passes/direct_light.h"
#include "techniques/technique.h"

typedef struct direct {
    lsf_gbuffer gbuffer;
    lsf_shadow_map shadow_map;
    lsf_direct_light direct_light;
    lsf_compose compose;
    bool lit, composed;
} direct;

/* The reflected light alone is the picture unless something is seen by itself. */
static bool needs_compose(const lsf_plan *plan, bool lit)
{
    const lsf_requirements *r = &plan->requirements;
    return r->emissive || r->unlit || r->environment || !lit || (plan->aovs & LSF_AOV_EMISSION);
}

static void plan_direct(lsf_plan *plan, const lsf_pass_params *params, const lsf_state *state)
{
    const lsf_requirements *r = &plan->requirements;
    bool lit = state->light_count > 0;
    lsf_gbuffer_plan(plan);
    if (lit) {
        lsf_shadow_map_plan(plan, &params->shadow_map, state);
        lsf_direct_light_plan(plan, params->shadow_map.filter == LSF_SHADOW_FILTER_PCF);
    } else {
        lsf_plan_omit(plan, "shadow_map", "no punctual light");
        lsf_plan_omit(plan, "direct_light", "no punctual light");
        lsf_log(LSF_LOG_WARNING, "no point, spot or directional light: the direct technique leaves "
                                 "every surface black but for what it emits");
    }
    if (needs_compose(plan, lit))
        lsf_compose_plan(plan, lit);
    else
        lsf_plan_omit(plan, "compose", "reflected light is the whole picture");
    if (r->emissive)
        lsf_plan_remark(plan, "emissive surfaces are seen, but light other surfaces only with the "
                              "bidirectional technique");
    if (r->environment)
        lsf_plan_remark(plan, "the environment is seen, but lights surfaces only with the "
                              "bidirectional technique");
    if (r->transmissive)
        lsf_plan_remark(plan, "transmission is read, but shaded as opaque");
    if (plan->bounces > 1)
        lsf_plan_remark(plan, "the direct technique has no bounces; %u asked for", plan->bounces);
    if (plan->aovs & (LSF_AOV_INDIRECT_DIFFUSE | LSF_AOV_INDIRECT_SPECULAR))
        lsf_plan_remark(plan, "the direct technique has no indirect light; its layers are black");
}

static bool create_direct(void **self, lsf_context *context, const lsf_plan *plan,
                          const lsf_pass_params *params, const lsf_scene_gpu *scene,
                          lsf_error *error)
{
    direct *d = *self = lsf_alloc(1, sizeof *d);
    if (!d)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    d->lit = lsf_plan_find_pass(plan, "direct_light") != NULL;
    d->composed = lsf_plan_find_pass(plan, "compose") != NULL;
    return lsf_gbuffer_create(&d->gbuffer, context, plan, &params->gbuffer, scene, error) &&
           (!d->lit || (lsf_shadow_map_create(&d->shadow_map, context, plan, error) &&
                        lsf_direct_light_create(&d->direct_light, context, plan, error))) &&
           (!d->composed || lsf_compose_create(&d->compose, context, plan, error));
}

static void run_direct(void *self, const lsf_iteration *iteration, lsf_technique_outputs *outputs)
{
    direct *d = self;
    const lsf_gbuffer_outputs *gbuffer = &d->gbuffer.outputs;
    lsf_gbuffer_run(&d->gbuffer, iteration);
    if (d->lit)
        lsf_direct_light_clear(&d->direct_light);
    for (uint32_t i = 0; d->lit && i < iteration->state->light_count; i++) {
        lsf_shadow_map_run(&d->shadow_map, iteration, i);
        lsf_direct_light_inputs inputs = {
            .depth = gbuffer->depth,
            .surface = gbuffer->surface,
            .gloss = gbuffer->gloss,
            .shadow_depth = d->shadow_map.outputs.depth,
            .shadow_gradient = d->shadow_map.outputs.gradient,
        };
        lsf_direct_light_run(&d->direct_light, iteration, &inputs);
    }
    if (d->composed) {
        lsf_compose_inputs inputs = {.depth = gbuffer->depth,
                                     .emission = gbuffer->emission,
                                     .direct = d->direct_light.radiance};
        lsf_compose_run(&d->compose, iteration, &inputs);
    }
    *outputs = (lsf_technique_outputs){
        .picture = d->composed ? d->compose.radiance : d->direct_light.radiance,
        .depth = gbuffer->depth,
        .surface = gbuffer->surface,
        .emission = d->compose.seen,
        .direct = d->direct_light.radiance,
        .motion = gbuffer->motion,
    };
}

static void destroy_direct(void *self)
{
    direct *d = self;
    if (!d)
        return;
    lsf_compose_destroy(&d->compose);
    lsf_direct_light_destroy(&d->direct_light);
    lsf_shadow_map_destroy(&d->shadow_map);
    lsf_gbuffer_destroy(&d->gbuffer);
    free(d);
}

static uint32_t report_direct(void *self, lsf_pass_report reports[LSF_TECHNIQUE_MAX_PASSES])
{
    direct *d = self;
    uint32_t count = 0;
    reports[count++] = (lsf_pass_report){d->gbuffer.timer, LSF_DRAW_COUNTS, lsf_draw_count_names,
                                         d->gbuffer.counts};
    if (d->lit) {
        reports[count++] = (lsf_pass_report){d->shadow_map.timer, LSF_DRAW_COUNTS,
                                             lsf_draw_count_names, d->shadow_map.counts};
        reports[count++] = (lsf_pass_report){.timer = d->direct_light.timer};
    }
    if (d->composed)
        reports[count++] = (lsf_pass_report){.timer = d->compose.timer};
    return count;
}

const lsf_technique lsf_technique_direct = {
    .name = "direct",
    .help = "direct light of punctual sources, by shadow maps",
    .plan = plan_direct,
    .create = create_direct,
    .run = run_direct,
    .destroy = destroy_direct,
    .report = report_direct,
};
