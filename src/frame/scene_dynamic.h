/* The part of the scene on the GPU that follows its state: instances, materials, triangles. The
 * rest is in scene_gpu.h. */
#ifndef LSF_FRAME_SCENE_DYNAMIC_H
#define LSF_FRAME_SCENE_DYNAMIC_H

#include "frame/scene_gpu.h"

/* Allocates the planned resources of it; lsf_scene_gpu_update fills them. */
bool lsf_scene_dynamic_create(lsf_scene_gpu *gpu, const lsf_plan *plan, lsf_error *error);
void lsf_scene_dynamic_destroy(lsf_scene_gpu *gpu);
/* Whether a planned resource of the scene belongs to that part. */
bool lsf_scene_gpu_follows(const char *resource);

#endif
