/* Texture look-ups: bilinear between texel centres, without mipmaps, decoded to linear before
 * they are blended. */
#ifndef LSF_SCENE_TEXTURE_SAMPLE_H
#define LSF_SCENE_TEXTURE_SAMPLE_H

#include "scene/scene.h"

typedef struct lsf_texel {
    float r, g, b, a;
} lsf_texel;

/* The slot's texture at `uv` (before the slot's transform). Grey images give r = g = b; images
 * without alpha give a = 1. The slot must have a texture. */
lsf_texel lsf_texture_sample(const lsf_scene *scene, const lsf_texture_slot *slot,
                             const float uv[2]);

#endif
