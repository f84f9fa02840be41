/* Materials: glTF's default, their textures by use, what they need of vertices, and what a program
 * may set of them. */
#ifndef LSF_SCENE_MATERIAL_H
#define LSF_SCENE_MATERIAL_H

#include <lightsheaf/build.h>

#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Beside the uses that a program may give: light that is occluded is computed. */
#define LSF_TEXTURE_OCCLUSION LSF_TEXTURE_USE_COUNT
#define LSF_SLOT_COUNT (LSF_TEXTURE_USE_COUNT + 1)

lsf_texture_slot *lsf_material_slot(lsf_material *material, uint32_t use);

/* Sets the transform T * R * S of KHR_texture_transform, where R turns the coordinates
 * counter-clockwise as seen in the image (v points down), as Khronos' TextureTransformTest shows.
 */
void lsf_texture_slot_place(lsf_texture_slot *slot, const double offset[2], double rotation,
                            const double scale[2]);

/* glTF's default, but for the name; of Lambert where materials are diffuse only. */
lsf_material lsf_default_material(bool diffuse_only);

bool lsf_material_wants_tangents(const lsf_material *material);
/* Whether some texture reads that set. */
bool lsf_material_reads_uv(const lsf_material *material, uint32_t set);
/* Whether some texture reads it, or tangents are made of it. */
bool lsf_material_wants_uv(const lsf_material *material, uint32_t set);
/* Tangents follow the texture coordinates of the map that is turned by them; anisotropy without any
 * map follows the first set. */
uint32_t lsf_material_tangent_uv_set(const lsf_material *material);

/* LSF_ERROR_USAGE names the value of material number `index` that is out of range. */
bool lsf_check_material(uint32_t index, const lsf_material_desc *desc, lsf_error *error);
/* Takes over what was checked: where materials are diffuse only, what such have. */
void lsf_material_set(lsf_material *material, const lsf_material_desc *desc, bool diffuse_only);
void lsf_material_get(const lsf_material *material, lsf_material_desc *desc);

#ifdef __cplusplus
}
#endif
#endif
