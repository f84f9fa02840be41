#include "techniques/sparse_chain.h"

bool lsf_sparse_chain_is_plain(const lsf_plan *plan, const lsf_pass_params *params,
                               uint32_t interleave)
{
    return !lsf_sparse_grid_is_sparse(plan) && interleave == 1 && !params->sparse.outliers &&
           !lsf_blur_wanted(&params->blur);
}

void lsf_sparse_chain_plan_split(lsf_plan *plan, const lsf_pass_params *params, uint32_t interleave)
{
    lsf_sparse_plan_split(plan, &params->sparse, interleave);
}

void lsf_sparse_chain_plan_finish(lsf_plan *plan, const lsf_pass_params *params,
                                  uint32_t interleave)
{
    lsf_sparse_plan_gather(plan, &params->sparse, interleave);
    lsf_blur_plan(plan, &params->blur);
    lsf_blur_remark(plan, &params->blur);
    lsf_sparse_plan_upsample(plan, &params->sparse, interleave);
}

bool lsf_sparse_chain_create(lsf_sparse_chain *chain, lsf_context *context, const lsf_plan *plan,
                             const lsf_pass_params *params, lsf_error *error)
{
    return lsf_sparse_create(&chain->sparse, context, plan, &params->sparse, error) &&
           (!lsf_blur_wanted(&params->blur) ||
            lsf_blur_create(&chain->blur, context, plan, &params->blur, error));
}

const lsf_surface_maps *lsf_sparse_chain_split(lsf_sparse_chain *chain,
                                               const lsf_iteration *iteration,
                                               const lsf_surface_maps *seen)
{
    if (!chain->sparse.split_program)
        return seen;
    lsf_sparse_split(&chain->sparse, iteration, seen);
    return &chain->sparse.split;
}

lsf_split_light lsf_sparse_chain_finish(lsf_sparse_chain *chain, const lsf_iteration *iteration,
                                        const lsf_surface_maps *seen,
                                        const lsf_split_light *gathered)
{
    lsf_sparse *sparse = &chain->sparse;
    const lsf_split_light *light = gathered;
    if (sparse->gather_program) {
        lsf_sparse_gather(sparse, iteration, seen, light);
        light = &sparse->gathered;
    }
    if (chain->blur.program) {
        const lsf_blur_inputs noisy = {.seen = seen, .light = light};
        lsf_blur_run(&chain->blur, iteration, &noisy);
        light = &chain->blur.light;
    }
    if (sparse->upsample_program) {
        lsf_sparse_upsample(sparse, iteration, seen, light);
        light = &sparse->light;
    }
    return *light;
}

void lsf_sparse_chain_destroy(lsf_sparse_chain *chain)
{
    lsf_blur_destroy(&chain->blur);
    lsf_sparse_destroy(&chain->sparse);
}

uint32_t lsf_sparse_chain_report_split(lsf_sparse_chain *chain, lsf_pass_report *reports)
{
    uint32_t count = 0;
    if (chain->sparse.fit_timer)
        reports[count++] =
            (lsf_pass_report){chain->sparse.fit_timer, LSF_SPARSE_COUNTS, lsf_sparse_count_names,
                              lsf_sparse_counts(&chain->sparse)};
    if (chain->sparse.split_timer)
        reports[count++] = (lsf_pass_report){.timer = chain->sparse.split_timer};
    return count;
}

uint32_t lsf_sparse_chain_report_finish(lsf_sparse_chain *chain, lsf_pass_report *reports)
{
    uint32_t count = 0;
    lsf_timer *const timers[] = {chain->sparse.gather_timer, chain->blur.timer,
                                 chain->sparse.upsample_timer};
    for (size_t i = 0; i < sizeof timers / sizeof timers[0]; i++)
        if (timers[i])
            reports[count++] = (lsf_pass_report){.timer = timers[i]};
    return count;
}
