/* Ground truth: a CPU path tracer on Embree, in a module of its own that is loaded on first use. */
#ifndef LIGHTSHEAF_REFERENCE_H
#define LIGHTSHEAF_REFERENCE_H

#include <lightsheaf/image.h>
#include <lightsheaf/renderer.h>
#include <lightsheaf/scene.h>

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

typedef struct lsf_reference_result {
    uint32_t samples; /* per pixel and half; a few pixels have more when it ended early */
    uint64_t rays;    /* traced, closest-hit and occlusion together */
    double build_seconds, render_seconds;
} lsf_reference_result;

/* Path-traces the scene with `params` (technique and pass options are ignored): next-event
 * estimation to punctual lights, emissive triangles and the environment with multiple importance
 * sampling, GGX by visible normals, params->bounces indirect bounces. `half` 0 or 1 picks one of
 * two independent sample sets. Needs no GL. The caller destroys the image. LSF_ERROR_USAGE when
 * the module is not installed. Stops early, with the samples so far, when params->progress
 * returns false; without a whole sample the picture is black in parts. */
lsf_image *lsf_reference_render(const lsf_scene *scene, const lsf_render_params *params,
                                uint32_t half, lsf_reference_result *result, lsf_error *error);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
