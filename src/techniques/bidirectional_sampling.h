/* How the bidirectional technique spends its samples, and the plan that follows. */
#ifndef LSF_TECHNIQUES_BIDIRECTIONAL_SAMPLING_H
#define LSF_TECHNIQUES_BIDIRECTIONAL_SAMPLING_H

#include "techniques/technique.h"

/* How samples are spent, decided from the scene and the options. */
typedef struct lsf_bidirectional_sampling {
    uint32_t bounces;                  /* bounces of the light of punctual lights */
    uint32_t vpl_count, emitter_count; /* VPLs of punctual lights, and on emissive surfaces */
    uint32_t bundle_count;
    uint32_t segments;   /* bundles along a path */
    uint32_t vertices;   /* number of these whose hits become vertices */
    bool vpl_light;      /* lights with maps, the environment's among them, light surfaces by
                          * VPLs */
    bool bundle_light;   /* the same lights light the hits of bundles */
    bool vpl_emitter;    /* emissive surfaces shine as VPLs */
    bool bundle_emitter; /* and into bundles */
    bool emission;       /* surfaces or the environment shine into bundles */
    bool sky_by_maps;    /* the environment lights visible points by its directions alone, which
                          * count on its light without shadows */
    bool whole_scene;
    bool split_direct;
    bool specular_paths; /* through voxels, from media and along narrow lobes */
    uint32_t interleave, tiles;
} lsf_bidirectional_sampling;

lsf_bidirectional_sampling lsf_bidirectional_sampling_choose(const lsf_plan *plan,
                                                             const lsf_pass_params *params,
                                                             const lsf_state *state);
lsf_ray_bundle_use lsf_bidirectional_bundle_use(const lsf_bidirectional_sampling *s);
/* The options, with the final number of VPLs. */
lsf_vpl_params lsf_bidirectional_vpl_params(const lsf_pass_params *params,
                                            const lsf_bidirectional_sampling *s);
void lsf_bidirectional_plan(lsf_plan *plan, const lsf_pass_params *params, const lsf_state *state);

#endif
