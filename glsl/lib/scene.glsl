/* Materials and their textures. */
#ifndef LSF_LIB_SCENE
#define LSF_LIB_SCENE

#include "shared/scene_data.h"

layout(std430, binding = LSF_BINDING_MATERIALS) readonly buffer lsf_material_block
{
    lsf_material_data materials[];
};

bool slot_used(lsf_texture_slot_data slot)
{
    return slot.row_0.w != 0.0;
}

/* Texture coordinates of both UV sets with their derivatives. Derivatives are taken once, before any branch or
 * discard, because afterwards the other pixels of a quad may hold no values. */
struct texture_coordinates {
    vec2 uv0, uv0_dx, uv0_dy;
    vec2 uv1, uv1_dx, uv1_dy;
};

vec4 slot_sample(sampler2D image, lsf_texture_slot_data slot, texture_coordinates coordinates)
{
    bool first = slot.row_1.w == 0.0;
    mat2x3 rows = mat2x3(slot.row_0.xyz, slot.row_1.xyz);
    vec2 uv = vec3(first ? coordinates.uv0 : coordinates.uv1, 1.0) * rows;
    vec2 dx = vec3(first ? coordinates.uv0_dx : coordinates.uv1_dx, 0.0) * rows;
    vec2 dy = vec3(first ? coordinates.uv0_dy : coordinates.uv1_dy, 0.0) * rows;
    return textureGrad(image, uv, dx, dy);
}

/* The same without a footprint: the finest level is read. */
vec4 slot_sample_finest(sampler2D image, lsf_texture_slot_data slot, vec2 uv0, vec2 uv1)
{
    return slot_sample(image, slot, texture_coordinates(uv0, vec2(0.0), vec2(0.0), uv1, vec2(0.0), vec2(0.0)));
}

#endif
