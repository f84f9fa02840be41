/* The scene's vertex streams for compute shaders that rasterise by themselves;
 * lib/triangle_fetch.glsl is the shader's side. */
#ifndef LSF_FRAME_TRIANGLE_FETCH_H
#define LSF_FRAME_TRIANGLE_FETCH_H

#include "frame/iteration.h"

typedef struct lsf_triangle_fetch {
    GLuint streams[7]; /* buffer textures */
} lsf_triangle_fetch;

bool lsf_triangle_fetch_create(lsf_triangle_fetch *fetch, lsf_context *context, lsf_error *error);
void lsf_triangle_fetch_bind(const lsf_triangle_fetch *fetch, const lsf_scene_gpu *scene);
/* Sets, for the program in use, the instance's transforms and material, and `count` of its
 * triangles from `first` on. */
void lsf_triangle_fetch_instance(const lsf_iteration *iteration, uint32_t instance, uint32_t first,
                                 uint32_t count);
void lsf_triangle_fetch_destroy(lsf_triangle_fetch *fetch);

#endif
