/* What media and narrow lobes show to the eye, for techniques whose own light is not in voxels:
 * these are lit for it, and paths bounce between them. */
#ifndef LSF_TECHNIQUES_SPECULAR_PATH_CHAIN_H
#define LSF_TECHNIQUES_SPECULAR_PATH_CHAIN_H

#include "techniques/voxel_chain.h"

/* Whether there are media or narrow lobes, and voxels to trace. */
bool lsf_specular_path_chain_needed(const lsf_plan *plan, const lsf_pass_params *params);
/* The voxels that paths need. */
lsf_voxel_chain_use lsf_specular_path_chain_voxels(const lsf_plan *plan,
                                                   const lsf_pass_params *params,
                                                   const lsf_state *state);
/* Of `use`, lobes, mirrors, lamps and bounces are filled in. */
void lsf_specular_path_chain_plan(lsf_plan *plan, const lsf_pass_params *params,
                                  const lsf_state *state, const lsf_specular_path_use *use);

#endif
