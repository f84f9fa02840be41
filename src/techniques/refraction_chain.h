/* What media show to the eye, for techniques whose own light is not in voxels: these are lit for
 * it, and paths bounce between them. */
#ifndef LSF_TECHNIQUES_REFRACTION_CHAIN_H
#define LSF_TECHNIQUES_REFRACTION_CHAIN_H

#include "techniques/voxel_chain.h"

/* Whether there are media to refract, and voxels to trace. */
bool lsf_refraction_chain_needed(const lsf_plan *plan, const lsf_pass_params *params);
/* The voxels that paths need. */
lsf_voxel_chain_use lsf_refraction_chain_voxels(const lsf_plan *plan, const lsf_state *state);
/* `reads`: the specular light at the points, to which this is added, and voxels and their light, as
 * for lsf_plan_reads; `factor` and `interleave`
 * as in lsf_refraction_use. */
void lsf_refraction_chain_plan(lsf_plan *plan, const lsf_pass_params *params,
                               const lsf_state *state, const char *reads, uint32_t factor,
                               uint32_t interleave, bool split_direct);

#endif
