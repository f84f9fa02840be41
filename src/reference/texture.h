/* Texture look-ups: bilinear between texel centres, without mipmaps, decoded to linear before
 * they are blended. */
#ifndef LSF_REFERENCE_TEXTURE_H
#define LSF_REFERENCE_TEXTURE_H

#include "scene/scene.h"

typedef struct lsf_reference_texel {
    float r, g, b, a;
} lsf_reference_texel;

/* The slot's texture at `uv` (before the slot's transform). Grey images give r = g = b; images
 * without alpha give a = 1. The slot must have a texture. */
lsf_reference_texel lsf_reference_texture_sample(const lsf_scene *scene,
                                                 const lsf_texture_slot *slot, const float uv[2]);

#endif
