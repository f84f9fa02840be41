#include "scene/material.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/base.h"
#include "scene/checks.h"

static const size_t slot_offsets[LSF_SLOT_COUNT] = {
    [LSF_TEXTURE_BASE_COLOR] = offsetof(lsf_material, base_color_texture),
    [LSF_TEXTURE_METALLIC_ROUGHNESS] = offsetof(lsf_material, metallic_roughness_texture),
    [LSF_TEXTURE_NORMAL] = offsetof(lsf_material, normal_texture),
    [LSF_TEXTURE_EMISSION] = offsetof(lsf_material, emissive_texture),
    [LSF_TEXTURE_ANISOTROPY] = offsetof(lsf_material, anisotropy_texture),
    [LSF_TEXTURE_TRANSMISSION] = offsetof(lsf_material, transmission_texture),
    [LSF_TEXTURE_SPECULAR] = offsetof(lsf_material, specular_texture),
    [LSF_TEXTURE_SPECULAR_COLOR] = offsetof(lsf_material, specular_color_texture),
    [LSF_TEXTURE_COAT] = offsetof(lsf_material, coat_texture),
    [LSF_TEXTURE_COAT_ROUGHNESS] = offsetof(lsf_material, coat_roughness_texture),
    [LSF_TEXTURE_COAT_NORMAL] = offsetof(lsf_material, coat_normal_texture),
    [LSF_TEXTURE_SHEEN_COLOR] = offsetof(lsf_material, sheen_color_texture),
    [LSF_TEXTURE_SHEEN_ROUGHNESS] = offsetof(lsf_material, sheen_roughness_texture),
    [LSF_TEXTURE_OCCLUSION] = offsetof(lsf_material, occlusion_texture),
};

lsf_texture_slot *lsf_material_slot(lsf_material *material, uint32_t use)
{
    return (lsf_texture_slot *)((char *)material + slot_offsets[use]);
}

void lsf_texture_slot_set_transform(lsf_texture_slot *slot, const double offset[2], double rotation,
                                    const double scale[2])
{
    double c = cos(rotation), s = sin(rotation);
    const double rows[2][3] = {{c * scale[0], s * scale[1], offset[0]},
                               {0.0 - s * scale[0], c * scale[1], offset[1]}};
    for (int i = 0; i < 6; i++)
        slot->transform[i] = (float)rows[i / 3][i % 3];
    slot->rotation = (float)rotation;
    for (int i = 0; i < 2; i++) {
        slot->offset[i] = (float)offset[i];
        slot->scale[i] = (float)scale[i];
    }
}

lsf_material lsf_default_material(bool diffuse_only)
{
    static const lsf_material_desc desc = {LSF_MATERIAL_DESC_DEFAULTS};
    lsf_material material = {.ior = desc.ior};
    lsf_material_set(&material, &desc, false);
    if (diffuse_only) {
        material.metallic = 0.0f;
        material.roughness = 1.0f;
    }
    for (uint32_t use = 0; use < LSF_SLOT_COUNT; use++)
        *lsf_material_slot(&material, use) = (lsf_texture_slot){
            .texture = LSF_NONE, .transform = {1, 0, 0, 0, 1, 0}, .scale = {1, 1}};
    return material;
}

/* --- the vertex streams that materials need --- */

bool lsf_material_wants_tangents(const lsf_material *material)
{
    return material->normal_texture.texture != LSF_NONE || material->anisotropy_strength > 0.0f ||
           material->coat_normal_texture.texture != LSF_NONE;
}

bool lsf_material_reads_uv(const lsf_material *material, uint32_t set)
{
    for (uint32_t use = 0; use < LSF_SLOT_COUNT; use++) {
        const lsf_texture_slot *slot = lsf_material_slot((lsf_material *)material, use);
        if (slot->texture != LSF_NONE && slot->uv_set == set)
            return true;
    }
    return false;
}

uint32_t lsf_material_tangent_uv_set(const lsf_material *material)
{
    return material->normal_texture.texture != LSF_NONE       ? material->normal_texture.uv_set
           : material->anisotropy_texture.texture != LSF_NONE ? material->anisotropy_texture.uv_set
           : material->coat_normal_texture.texture != LSF_NONE
               ? material->coat_normal_texture.uv_set
               : 0;
}

bool lsf_material_wants_uv(const lsf_material *material, uint32_t set)
{
    return lsf_material_reads_uv(material, set) ||
           (lsf_material_wants_tangents(material) && lsf_material_tangent_uv_set(material) == set);
}

/* --- checks of what a program sets --- */

bool lsf_check_material(uint32_t index, const lsf_material_desc *desc, lsf_error *error)
{
    const float *tint = desc->specular_color, *sheen = desc->sheen_color;
    const float *attenuation = desc->attenuation_color;
    const struct {
        const char *name;
        float value;
        double least, most;
    } values[] = {
        {"base_color", desc->base_color[0], 0.0, 1.0},
        {"base_color", desc->base_color[1], 0.0, 1.0},
        {"base_color", desc->base_color[2], 0.0, 1.0},
        {"base_color", desc->base_color[3], 0.0, 1.0},
        {"metallic", desc->metallic, 0.0, 1.0},
        {"roughness", desc->roughness, 0.0, 1.0},
        {"alpha_cutoff", desc->alpha_cutoff, 0.0, INFINITY},
        {"transmission", desc->transmission, 0.0, 1.0},
        {"coat", desc->coat, 0.0, 1.0},
        {"coat_roughness", desc->coat_roughness, 0.0, 1.0},
        {"coat_normal_scale", desc->coat_normal_scale, -FLT_MAX, FLT_MAX},
        {"normal_scale", desc->normal_scale, -FLT_MAX, FLT_MAX},
        {"specular", desc->specular, 0.0, 1.0},
        {"specular_color", tint[0], 0.0, FLT_MAX},
        {"specular_color", tint[1], 0.0, FLT_MAX},
        {"specular_color", tint[2], 0.0, FLT_MAX},
        {"sheen_color", sheen[0], 0.0, 1.0},
        {"sheen_color", sheen[1], 0.0, 1.0},
        {"sheen_color", sheen[2], 0.0, 1.0},
        {"sheen_roughness", desc->sheen_roughness, 0.0, 1.0},
        {"attenuation_distance", desc->attenuation_distance, FLT_MIN, INFINITY},
        {"attenuation_color", attenuation[0], 0.0, 1.0},
        {"attenuation_color", attenuation[1], 0.0, 1.0},
        {"attenuation_color", attenuation[2], 0.0, 1.0},
        {"anisotropy", desc->anisotropy, 0.0, 1.0},
        {"anisotropy_rotation", desc->anisotropy_rotation, -FLT_MAX, FLT_MAX},
    };
    for (size_t i = 0; i < LSF_COUNT(values); i++)
        if (!lsf_check_within("material", index, values[i].name, values[i].value, values[i].least,
                              values[i].most, error))
            return false;
    if (desc->alpha_mode > LSF_ALPHA_BLEND)
        return lsf_error_set(error, LSF_ERROR_USAGE, "material %u: there is no alpha mode %d",
                             index, (int)desc->alpha_mode);
    return lsf_check_bright("material", index, "emission", desc->emission, 1.0, error) &&
           (desc->ior == 0.0f ||
            lsf_check_within("material", index, "ior", desc->ior, 1.0, 1e6, error));
}

void lsf_material_set(lsf_material *m, const lsf_material_desc *desc, bool diffuse_only)
{
    memcpy(m->base_color, desc->base_color, sizeof m->base_color);
    lsf_store_light(m->emission, desc->emission, 1.0);
    m->alpha_mode = desc->alpha_mode;
    m->alpha_cutoff = desc->alpha_cutoff;
    m->double_sided = desc->double_sided;
    m->unlit = desc->unlit;
    if (diffuse_only)
        return;
    m->metallic = desc->metallic;
    m->roughness = desc->roughness;
    m->normal_scale = desc->normal_scale;
    m->ior = desc->ior;
    m->specular = desc->specular;
    memcpy(m->specular_color, desc->specular_color, sizeof m->specular_color);
    memcpy(m->sheen_color, desc->sheen_color, sizeof m->sheen_color);
    m->sheen_roughness = desc->sheen_roughness;
    m->coat = desc->coat;
    m->coat_roughness = desc->coat_roughness;
    m->coat_normal_scale = desc->coat_normal_scale;
    m->transmission = desc->transmission;
    m->volume = desc->volume;
    m->attenuation_distance = desc->attenuation_distance;
    memcpy(m->attenuation_color, desc->attenuation_color, sizeof m->attenuation_color);
    m->anisotropy_strength = desc->anisotropy;
    m->anisotropy_rotation = desc->anisotropy_rotation;
}

void lsf_material_get(const lsf_material *m, lsf_material_desc *desc)
{
    *desc = (lsf_material_desc){.metallic = m->metallic,
                                .roughness = m->roughness,
                                .normal_scale = m->normal_scale,
                                .alpha_mode = m->alpha_mode,
                                .alpha_cutoff = m->alpha_cutoff,
                                .double_sided = m->double_sided,
                                .unlit = m->unlit,
                                .ior = m->ior,
                                .specular = m->specular,
                                .sheen_roughness = m->sheen_roughness,
                                .coat = m->coat,
                                .coat_roughness = m->coat_roughness,
                                .coat_normal_scale = m->coat_normal_scale,
                                .transmission = m->transmission,
                                .volume = m->volume,
                                .attenuation_distance = m->attenuation_distance,
                                .anisotropy = m->anisotropy_strength,
                                .anisotropy_rotation = m->anisotropy_rotation};
    memcpy(desc->base_color, m->base_color, sizeof desc->base_color);
    memcpy(desc->emission, m->emission, sizeof desc->emission);
    memcpy(desc->specular_color, m->specular_color, sizeof desc->specular_color);
    memcpy(desc->sheen_color, m->sheen_color, sizeof desc->sheen_color);
    memcpy(desc->attenuation_color, m->attenuation_color, sizeof desc->attenuation_color);
}
