/* One ray-bundle behind a G-buffer, outside of any technique. */
#ifndef LSF_TESTS_PASSES_BUNDLE_RIG_H
#define LSF_TESTS_PASSES_BUNDLE_RIG_H

#include "passes/gbuffer.h"
#include "passes/ray_bundle.h"
#include "passes/ray_bundle_parts.h"
#include "render_gl.h"
#include "techniques/setup.h"

typedef struct bundle_rig {
    lsf_context *context;
    lsf_setup setup;
    lsf_scene_gpu scene;
    lsf_iteration iteration;
    lsf_gbuffer gbuffer;
    lsf_ray_bundle *bundle;
    struct lsf_bundle_data data; /* as the GPU has it */
    uint32_t width, height;
    float *depth;             /* of the G-buffer */
    uint32_t *surface, *hits; /* 4 and 2 words a pixel */
} bundle_rig;

/* Draws G-buffer and a bundle along `direction`, searches it from every pixel, and reads back. */
void bundle_rig_run(bundle_rig *rig, const lsf_scene *scene, const lsf_render_params *params,
                    const lsf_ray_bundle_params *bundle, lsf_float3 direction, bool distances_only);
void bundle_rig_finish(bundle_rig *rig);

/* The visible point of a pixel; false where nothing is seen. */
bool bundle_rig_origin(const bundle_rig *rig, uint32_t x, uint32_t y, lsf_float3 *position,
                       lsf_float3 *normal);
/* Distance of a pixel's hit; infinity: none. */
float bundle_rig_distance(const bundle_rig *rig, uint32_t x, uint32_t y, uint32_t *node);
/* What a hit is told apart by: its distance, and its surface. */
void bundle_rig_hit_words(const bundle_rig *rig, const uint32_t *surfaces, uint32_t pixel,
                          uint32_t words[4]);
/* A whole array of slot 0, to be freed. */
uint32_t *bundle_rig_array(const bundle_rig *rig, int array);

#endif
