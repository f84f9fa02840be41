/* Scenes made by hand, rendered by the path tracer's parts without the module loader. */
#ifndef LSF_TESTS_REFERENCE_RENDER_SCENE_H
#define LSF_TESTS_REFERENCE_RENDER_SCENE_H

#include <lightsheaf/reference.h>

#include "../scene/build_scene.h"

/* Renders with `threads` threads (0: all cores); fails the test on an error. */
lsf_image *render_scene(const lsf_scene *scene, const lsf_render_params *params, uint32_t half,
                        uint32_t threads);
/* Mean R, G, B of a picture of one pixel that looks from `eye` at `target` through a needle. */
void render_point(const lsf_scene *scene, lsf_float3 eye, lsf_float3 target, uint32_t samples,
                  uint32_t bounces, float rgb[3]);
/* Mean of the channels from `first` on over the picture. */
void image_mean(const lsf_image *image, int first, double mean[3]);

#endif
