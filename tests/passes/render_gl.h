/* Rendering by GL in tests. Every context fails on GL errors. */
#ifndef LSF_TESTS_PASSES_RENDER_GL_H
#define LSF_TESTS_PASSES_RENDER_GL_H

#include <lightsheaf/lightsheaf.h>

#include "../gl/gl_test.h"
#include "../scene/build_scene.h"

/* Renders on a context of `backend`; skips the test where there is none. */
lsf_image *render_gl(lsf_backend backend, const lsf_scene *scene, const lsf_render_params *params);

/* R, G, B of a picture of one pixel that looks from `eye` at `target` through a needle. */
void render_gl_point(const lsf_scene *scene, lsf_float3 eye, lsf_float3 target, uint32_t samples,
                     float rgb[3]);

/* finish_scene and the requirements. */
void finish_gl_scene(lsf_scene *scene);

#endif
