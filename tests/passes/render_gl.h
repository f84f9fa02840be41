/* Rendering by GL in tests. Every context fails on GL errors. */
#ifndef LSF_TESTS_PASSES_RENDER_GL_H
#define LSF_TESTS_PASSES_RENDER_GL_H

#include <lightsheaf/lightsheaf.h>

#include "../gl/gl_test.h"
#include "../scene/build_scene.h"

/* Renders on a context of `backend`; skips the test where there is none. */
lsf_image *render_gl(lsf_backend backend, const lsf_scene *scene, const lsf_render_params *params);

/* The same on a context that stays, and keeps its compiled programs. */
lsf_image *render_gl_in(lsf_context *context, const lsf_scene *scene,
                        const lsf_render_params *params);

/* A square picture of `size` pixels a side that looks from `eye` at `target`. */
lsf_image *render_gl_from(const lsf_scene *scene, lsf_render_params params, uint32_t size,
                          lsf_float3 eye, lsf_float3 target);

/* A square picture that looks at the scene of build_corner. */
lsf_render_params corner_params(lsf_render_params params, uint32_t size);
lsf_image *render_corner(const lsf_scene *scene, lsf_render_params params, uint32_t size);

/* R, G, B of a picture of one pixel that looks from `eye` at `target` through a needle. */
void render_gl_point(const lsf_scene *scene, lsf_float3 eye, lsf_float3 target, uint32_t samples,
                     float rgb[3]);

/* Means of three channels from `first` on. None of their values is negative. */
void mean_rgb(const lsf_image *image, uint32_t first, double rgb[3]);

/* Prints each of three channels and asserts that it is within that part of what is expected. */
void assert_seen(const char *what, const double found[3], const double expected[3],
                 double tolerance);

void assert_same_pixels(const lsf_image *image, const lsf_image *expected);
/* Every value is `scale` times the expected one, to the bit. */
void assert_scaled_pixels(const lsf_image *image, const lsf_image *expected, float scale);
/* The same bits with 0, 1 and 8 threads of the rasteriser as with its own choice. */
void assert_same_for_any_threads(const lsf_scene *scene, const lsf_render_params *params);

/* Renders 1 x 1 pixel of an empty scene, and 7 x 13 of a flat triangle, of one that the camera lies
 * in and of one that the light lies in, all under a uniform environment of radiance `environment`:
 * all is finite. */
void assert_finite_extremes(lsf_render_params params, float environment);

/* finish_scene and the requirements. */
void finish_gl_scene(lsf_scene *scene);

#endif
