/* The scene's textures and environment on the GPU: formats, mipmaps, samplers. */
#ifndef LSF_FRAME_TEXTURE_UPLOAD_H
#define LSF_FRAME_TEXTURE_UPLOAD_H

#include "frame/scene_gpu.h"

/* How a material reads a texture. */
typedef enum lsf_texture_filter {
    LSF_TEXTURE_MEAN,  /* the mean over a footprint, by mipmaps: colours and weights */
    LSF_TEXTURE_FINEST /* level 0: normals, roughness and directions, whose mean is another surface
                        */
} lsf_texture_filter;

#define LSF_MATERIAL_TEXTURES 13

typedef struct lsf_texture_read {
    GLuint unit;
    const lsf_texture_slot *slot;
    lsf_texture_filter filter;
} lsf_texture_read;

/* Fills in the textures that a material reads, and counts them; `transmission`: as in the plan. */
uint32_t lsf_texture_upload_read_by(const lsf_material *m, bool transmission,
                                    lsf_texture_read out[LSF_MATERIAL_TEXTURES]);
void lsf_texture_upload_plan(lsf_plan *plan, const lsf_scene *scene);
bool lsf_texture_upload_create(lsf_scene_gpu *gpu, const lsf_plan *plan, lsf_error *error);
/* Follows edits of the environment's radiance. */
void lsf_texture_upload_update(lsf_scene_gpu *gpu);
void lsf_texture_upload_destroy(lsf_scene_gpu *gpu);
/* The sampler object for a scene texture's wrap modes and filter; `point`: the nearest texel (of
 * the nearest level) instead. */
GLuint lsf_texture_upload_sampler(const lsf_scene_gpu *gpu, uint32_t texture,
                                  lsf_texture_filter filter, bool point);
/* Shifts the mipmap level of every sampler; see lsf_texture_lod_bias. */
void lsf_texture_upload_set_lod_bias(const lsf_scene_gpu *gpu, float bias);

#endif
