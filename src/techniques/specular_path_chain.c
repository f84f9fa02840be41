#include "techniques/specular_path_chain.h"

bool lsf_specular_path_chain_needed(const lsf_plan *plan, const lsf_pass_params *params)
{
    return lsf_voxel_chain_has_voxels(plan) &&
           (lsf_specular_path_media(plan, &params->specular_path) ||
            lsf_specular_path_lobes(plan, &params->specular_path));
}

/* A path goes on from each voxel by one ray. */
lsf_voxel_chain_use lsf_specular_path_chain_voxels(const lsf_plan *plan,
                                                   const lsf_pass_params *params,
                                                   const lsf_state *state)
{
    return (lsf_voxel_chain_use){
        .sides = LSF_VOXEL_SIDES_SURFACE,
        .levels = 1,
        .lamps = plan->bounces > 0 && lsf_voxel_lamps(plan, state),
        .direct = {.lobes = lsf_specular_path_lobes(plan, &params->specular_path)},
        .voxel_rays = 1.0f};
}

void lsf_specular_path_chain_plan(lsf_plan *plan, const lsf_pass_params *params,
                                  const lsf_state *state, const lsf_specular_path_use *use)
{
    lsf_specular_path_use all = *use;
    all.mirrors = lsf_voxel_mirrors(plan, state);
    all.lamps = lsf_specular_path_chain_voxels(plan, params, state).lamps;
    all.lobes = lsf_specular_path_lobes(plan, &params->specular_path);
    all.bounces = true;
    lsf_specular_path_plan(plan, &params->specular_path, &all);
}
