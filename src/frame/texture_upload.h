/* The scene's textures and environment on the GPU: formats, mipmaps, samplers. */
#ifndef LSF_FRAME_TEXTURE_UPLOAD_H
#define LSF_FRAME_TEXTURE_UPLOAD_H

#include "frame/scene_gpu.h"

void lsf_texture_upload_plan(lsf_plan *plan, const lsf_scene *scene);
bool lsf_texture_upload_create(lsf_scene_gpu *gpu, const lsf_plan *plan, lsf_error *error);
/* Follows edits of the environment's radiance. */
void lsf_texture_upload_update(lsf_scene_gpu *gpu);
void lsf_texture_upload_destroy(lsf_scene_gpu *gpu);
/* The sampler object for a scene texture's wrap modes and filter; `point`: the nearest texel of the
 * nearest level instead. */
GLuint lsf_texture_upload_sampler(const lsf_scene_gpu *gpu, uint32_t texture, bool point);
/* Shifts the mipmap level of every sampler; see lsf_texture_lod_bias. */
void lsf_texture_upload_set_lod_bias(const lsf_scene_gpu *gpu, float bias);

#endif
