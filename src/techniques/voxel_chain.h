/* The passes that voxel techniques begin with: the G-buffer, the scene as voxels, and the light
 * of punctual lights on both, or on the G-buffer alone. */
#ifndef LSF_TECHNIQUES_VOXEL_CHAIN_H
#define LSF_TECHNIQUES_VOXEL_CHAIN_H

#include "frame/path_inputs.h"
#include "passes/voxel_light.h"
#include "passes/voxel_view.h"
#include "passes/voxelize.h"
#include "techniques/direct_chain.h"

typedef struct lsf_voxel_chain_use {
    uint32_t sides, levels;   /* of the voxels' radiance; 0 sides: voxels are not lit */
    bool lamps;               /* voxels of smooth metal keep one that they mirror */
    uint32_t bytes_per_voxel; /* memory of the technique beside them */
    lsf_direct_chain_use direct;
    float voxel_rays; /* number of rays from a voxel that find the environment by chance, drawn
                       * by the cosine */
} lsf_voxel_chain_use;

typedef struct lsf_voxel_chain {
    lsf_direct_chain direct;
    lsf_voxel_grid grid;
    lsf_voxelize *voxelize;   /* NULL: the scene has no triangles */
    const lsf_voxels *voxels; /* of the last run */
    bool lit;                 /* voxels are */
    lsf_voxel_light light;
    lsf_voxel_view view; /* where layers of voxels are asked for */
} lsf_voxel_chain;

/* Whether the scene has triangles to voxelise; without, the chain is the direct one. */
bool lsf_voxel_chain_has_voxels(const lsf_plan *plan);
/* The planned grid, for resources that the technique plans over it. */
lsf_voxel_grid lsf_voxel_chain_grid(const lsf_plan *plan, const lsf_pass_params *params,
                                    const lsf_state *state, const lsf_voxel_chain_use *use);
void lsf_voxel_chain_plan(lsf_plan *plan, const lsf_pass_params *params, const lsf_state *state,
                          const lsf_voxel_chain_use *use);
bool lsf_voxel_chain_create(lsf_voxel_chain *chain, lsf_context *context, const lsf_plan *plan,
                            const lsf_pass_params *params, const lsf_scene_gpu *scene,
                            const lsf_state *state, const lsf_voxel_chain_use *use,
                            lsf_error *error);
/* Updates as lsf_technique's update does. */
lsf_update lsf_voxel_chain_update(lsf_voxel_chain *chain, const lsf_pass_params *params,
                                  const lsf_iteration *iteration, const lsf_voxel_chain_use *use,
                                  const lsf_changes *changes);
void lsf_voxel_chain_run(lsf_voxel_chain *chain, const lsf_iteration *iteration);
/* The same in parts: G-buffer and voxels; emission of voxels, for techniques that use it alone;
 * then the punctual lights, on voxels only where asked for. */
void lsf_voxel_chain_begin(lsf_voxel_chain *chain, const lsf_iteration *iteration);
void lsf_voxel_chain_emit(lsf_voxel_chain *chain);
void lsf_voxel_chain_lights(lsf_voxel_chain *chain, const lsf_iteration *iteration, bool on_voxels);
/* What paths from the points `seen` read, after the light. */
lsf_path_inputs lsf_voxel_chain_paths(const lsf_voxel_chain *chain, const lsf_surface_maps *seen);
/* The layers of voxels, where asked for; to be called when the voxels' light is complete. */
lsf_voxel_view_outputs lsf_voxel_chain_view(lsf_voxel_chain *chain, const lsf_iteration *iteration);
void lsf_voxel_chain_destroy(lsf_voxel_chain *chain);
/* Reports as lsf_technique's report does. */
uint32_t lsf_voxel_chain_report(lsf_voxel_chain *chain, lsf_pass_report *reports);

#endif
