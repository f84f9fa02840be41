/* The passes that techniques begin with: the G-buffer, and the light of punctual lights on it. */
#ifndef LSF_TECHNIQUES_DIRECT_CHAIN_H
#define LSF_TECHNIQUES_DIRECT_CHAIN_H

#include "passes/direct_light.h"
#include "passes/gbuffer.h"
#include "passes/light_importance.h"
#include "passes/open_sky.h"
#include "passes/shadow_map.h"
#include "passes/sky_map.h"
#include "techniques/technique.h"

typedef struct lsf_direct_chain {
    lsf_gbuffer gbuffer;
    lsf_shadow_map shadow_map;
    lsf_sky_map sky_map;
    lsf_open_sky open_sky;
    lsf_direct_light direct_light;
    lsf_light_importance importance; /* empty unless the plan has it */
    bool lit;                        /* there are lights, punctual or of the environment */
} lsf_direct_chain;

/* The ways in which a technique finds the environment besides this chain; NULL: none. */
typedef struct lsf_direct_chain_use {
    lsf_sky_chance chance;
    float paths[2]; /* as in lsf_direct_light_use */
    bool lobes;     /* as in lsf_sky_use */
} lsf_direct_chain_use;

void lsf_direct_chain_plan(lsf_plan *plan, const lsf_pass_params *params, const lsf_state *state,
                           const lsf_direct_chain_use *use);
/* The same without the G-buffer, for a technique that has other passes between. */
void lsf_direct_chain_plan_lights(lsf_plan *plan, const lsf_pass_params *params,
                                  const lsf_state *state, const lsf_direct_chain_use *use);
bool lsf_direct_chain_create(lsf_direct_chain *chain, lsf_context *context, const lsf_plan *plan,
                             const lsf_pass_params *params, const lsf_scene_gpu *scene,
                             const lsf_direct_chain_use *use, lsf_error *error);
void lsf_direct_chain_run(lsf_direct_chain *chain, const lsf_iteration *iteration);
/* The same in parts, for a technique that has a use of its own for each punctual light's map:
 * the G-buffer; then each such light; then the environment, where the plan has sky_map. */
void lsf_direct_chain_begin(lsf_direct_chain *chain, const lsf_iteration *iteration);
void lsf_direct_chain_light(lsf_direct_chain *chain, const lsf_iteration *iteration,
                            uint32_t light);
/* `voxels`: of this iteration, where narrow lobes ask them; else NULL. */
void lsf_direct_chain_sky_begin(lsf_direct_chain *chain, const lsf_iteration *iteration,
                                const lsf_voxels *voxels);
/* Light of the next batch of directions, whose maps are then in sky_map.outputs; false when there
 * is none. */
bool lsf_direct_chain_sky_next(lsf_direct_chain *chain, const lsf_iteration *iteration);
/* All parts in order. */
void lsf_direct_chain_lights(lsf_direct_chain *chain, const lsf_iteration *iteration);
/* The light that it found, to which others add. */
lsf_light_parts lsf_direct_chain_parts(const lsf_direct_chain *chain);
void lsf_direct_chain_destroy(lsf_direct_chain *chain);
/* Reports as lsf_technique's report does. */
uint32_t lsf_direct_chain_report(lsf_direct_chain *chain, lsf_pass_report *reports);

#endif
