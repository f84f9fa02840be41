#include "techniques/refraction_chain.h"

bool lsf_refraction_chain_needed(const lsf_plan *plan, const lsf_pass_params *params)
{
    return lsf_voxel_chain_has_voxels(plan) && (lsf_refraction_needed(plan, &params->refraction) ||
                                                lsf_refraction_lobes(plan, &params->refraction));
}

/* A path goes on from each voxel by one ray. */
lsf_voxel_chain_use lsf_refraction_chain_voxels(const lsf_plan *plan, const lsf_state *state)
{
    return (lsf_voxel_chain_use){.sides = LSF_VOXEL_SIDES_SURFACE,
                                 .levels = 1,
                                 .lamps = plan->bounces > 0 && lsf_voxel_lamps(plan, state),
                                 .voxel_rays = 1.0f};
}

void lsf_refraction_chain_plan(lsf_plan *plan, const lsf_pass_params *params,
                               const lsf_state *state, const char *reads, uint32_t factor,
                               uint32_t interleave, bool split_direct)
{
    const lsf_refraction_use use = {.reads = reads,
                                    .mirrors = lsf_voxel_mirrors(plan, state),
                                    .lamps = lsf_refraction_chain_voxels(plan, state).lamps,
                                    .factor = factor,
                                    .interleave = interleave,
                                    .split_direct = split_direct,
                                    .lobes = lsf_refraction_lobes(plan, &params->refraction),
                                    .bounces = true};
    lsf_refraction_plan(plan, &params->refraction, &use);
}
