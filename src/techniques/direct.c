/* Direct light of punctual sources and of the environment, by shadow maps. Emissive surfaces are
 * seen but light nothing. */
#include <stdlib.h>

#include "base/base.h"
#include "passes/compose.h"
#include "techniques/direct_chain.h"

typedef struct direct {
    lsf_direct_chain chain;
    lsf_compose compose;
    bool composed;
} direct;

/* The picture is the reflected light alone unless some surface or the environment emits. */
static bool needs_compose(const lsf_plan *plan, bool lit)
{
    const lsf_requirements *r = &plan->requirements;
    return r->emissive || r->unlit || r->environment || !lit || plan->straight || plan->sky_split ||
           !plan->background.environment || (plan->aovs & LSF_AOV_EMISSION);
}

static void plan_direct(lsf_plan *plan, const lsf_pass_params *params, const lsf_state *state)
{
    const lsf_requirements *r = &plan->requirements;
    bool lit = lsf_light_any(plan, state);
    lsf_direct_chain_plan(plan, params, state, NULL);
    if (!lit)
        lsf_log(LSF_LOG_WARNING, "no point, spot or directional light and no environment: the "
                                 "direct technique leaves every "
                                 "surface black except for its emission");
    if (needs_compose(plan, lit))
        lsf_compose_plan(plan, &(lsf_compose_use){.direct = lit});
    else
        lsf_plan_omit(plan, "compose", "reflected light is the whole picture");
    if (r->emissive)
        lsf_plan_remark(
            plan, "emissive surfaces are visible, but light others only with the other techniques");
    if (r->environment && plan->sky_lights == 0)
        lsf_plan_remark(plan,
                        "environment.directions=0: the environment is visible, but lights nothing");
    if (plan->aovs & (LSF_AOV_INDIRECT_DIFFUSE | LSF_AOV_INDIRECT_SPECULAR))
        lsf_plan_remark(plan, "the direct technique has no indirect light; its layers are black");
}

static bool create_direct(void **self, lsf_context *context, const lsf_plan *plan,
                          const lsf_pass_params *params, const lsf_scene_gpu *scene,
                          const lsf_state *state, lsf_error *error)
{
    (void)state;
    direct *d = *self = lsf_alloc(1, sizeof *d);
    if (!d)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    d->composed = lsf_plan_find_pass(plan, "compose") != NULL;
    return lsf_direct_chain_create(&d->chain, context, plan, params, scene, NULL, error) &&
           (!d->composed || lsf_compose_create(&d->compose, context, plan, error));
}

static void run_direct(void *self, const lsf_iteration *iteration, lsf_technique_outputs *outputs)
{
    direct *d = self;
    const lsf_light_parts parts = lsf_direct_chain_parts(&d->chain);
    d->chain.gbuffer.lobe_angle = lsf_iteration_sky_angle(iteration);
    lsf_direct_chain_run(&d->chain, iteration);
    if (d->composed)
        lsf_compose_run(&d->compose, iteration, &parts);
    *outputs = (lsf_technique_outputs){.parts = parts, .layers = d->compose.outputs};
    if (!d->composed)
        outputs->layers.picture = outputs->layers.direct = parts.direct;
}

static void destroy_direct(void *self)
{
    direct *d = self;
    if (!d)
        return;
    lsf_compose_destroy(&d->compose);
    lsf_direct_chain_destroy(&d->chain);
    free(d);
}

static uint32_t report_direct(void *self, lsf_pass_report reports[LSF_TECHNIQUE_MAX_PASSES])
{
    direct *d = self;
    uint32_t count = lsf_direct_chain_report(&d->chain, reports);
    if (d->composed)
        reports[count++] = (lsf_pass_report){.timer = d->compose.timer};
    return count;
}

const lsf_technique lsf_technique_direct = {
    .name = "direct",
    .help = "direct light of punctual sources and environments, by shadow maps",
    .plan = plan_direct,
    .create = create_direct,
    .run = run_direct,
    .destroy = destroy_direct,
    .report = report_direct,
};
