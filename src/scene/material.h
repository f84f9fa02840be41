/* Materials: glTF's default, their textures by use, the vertex streams that they need, and
 * checks of what a program sets. */
#ifndef LSF_SCENE_MATERIAL_H
#define LSF_SCENE_MATERIAL_H

#include <lightsheaf/build.h>

#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A use that files may give beside those of a program: it is not read, for occlusion is
 * computed. */
#define LSF_TEXTURE_OCCLUSION LSF_TEXTURE_USE_COUNT
#define LSF_SLOT_COUNT (LSF_TEXTURE_USE_COUNT + 1)

lsf_texture_slot *lsf_material_slot(lsf_material *material, uint32_t use);

/* Sets the transform T * R * S of KHR_texture_transform, where R turns the coordinates
 * counter-clockwise as seen in the image (v points down), as Khronos' TextureTransformTest shows.
 */
void lsf_texture_slot_set_transform(lsf_texture_slot *slot, const double offset[2], double rotation,
                                    const double scale[2]);

/* glTF's default material without a name; a Lambert one where materials are diffuse only. */
lsf_material lsf_default_material(bool diffuse_only);

bool lsf_material_wants_tangents(const lsf_material *material);
/* Whether some texture reads that set of coordinates. */
bool lsf_material_reads_uv(const lsf_material *material, uint32_t set);
/* Whether some texture reads it, or tangents are computed from it. */
bool lsf_material_wants_uv(const lsf_material *material, uint32_t set);
/* Tangents follow the texture coordinates of the map that is relative to them; anisotropy
 * without a map follows the first set. */
uint32_t lsf_material_tangent_uv_set(const lsf_material *material);

/* Checks a material; LSF_ERROR_USAGE names its number `index` and the value that is out of
 * range. */
bool lsf_check_material(uint32_t index, const lsf_material_desc *desc, lsf_error *error);
/* Takes over a description that was checked; where materials are diffuse only, without other
 * lobes. */
void lsf_material_set(lsf_material *material, const lsf_material_desc *desc, bool diffuse_only);
void lsf_material_get(const lsf_material *material, lsf_material_desc *desc);

#ifdef __cplusplus
}
#endif
#endif
