#include "scene/property.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/base.h"
#include "scene/checks.h"
#include "scene/material.h"

#define MATERIAL(name, member, width, least, most, surface)                                        \
    {                                                                                              \
        LSF_KIND_MATERIAL, name, offsetof(lsf_material, member), width, least, most, surface       \
    }
#define LIGHT(name, member, width, most)                                                           \
    {                                                                                              \
        LSF_KIND_LIGHT, name, offsetof(lsf_light, member), width, 0.0f, most, false                \
    }
#define CAMERA(name, member, least, most)                                                          \
    {                                                                                              \
        LSF_KIND_CAMERA, name, offsetof(lsf_camera, member), 1, least, most, false                 \
    }
#define EXTENSION(name, property) "extensions/KHR_materials_" name "/" property

static const lsf_property properties[] = {
    MATERIAL("pbrMetallicRoughness/baseColorFactor", base_color, 4, 0.0f, 1.0f, false),
    MATERIAL("pbrMetallicRoughness/metallicFactor", metallic, 1, 0.0f, 1.0f, true),
    MATERIAL("pbrMetallicRoughness/roughnessFactor", roughness, 1, 0.0f, 1.0f, true),
    MATERIAL("alphaCutoff", alpha_cutoff, 1, 0.0f, FLT_MAX, false),
    MATERIAL("emissiveFactor", emissive_factor, 3, 0.0f, FLT_MAX, false),
    MATERIAL(EXTENSION("emissive_strength", "emissiveStrength"), emissive_strength, 1, 0.0f,
             FLT_MAX, false),
    MATERIAL("normalTexture/scale", normal_scale, 1, -FLT_MAX, FLT_MAX, true),
    MATERIAL(EXTENSION("ior", "ior"), ior, 1, 0.0f, 1e6f, true),
    MATERIAL(EXTENSION("transmission", "transmissionFactor"), transmission, 1, 0.0f, 1.0f, true),
    MATERIAL(EXTENSION("volume", "attenuationDistance"), attenuation_distance, 1, FLT_MIN, FLT_MAX,
             true),
    MATERIAL(EXTENSION("volume", "attenuationColor"), attenuation_color, 3, 0.0f, 1.0f, true),
    MATERIAL(EXTENSION("specular", "specularFactor"), specular, 1, 0.0f, 1.0f, true),
    MATERIAL(EXTENSION("specular", "specularColorFactor"), specular_color, 3, 0.0f, FLT_MAX, true),
    MATERIAL(EXTENSION("sheen", "sheenColorFactor"), sheen_color, 3, 0.0f, 1.0f, true),
    MATERIAL(EXTENSION("sheen", "sheenRoughnessFactor"), sheen_roughness, 1, 0.0f, 1.0f, true),
    MATERIAL(EXTENSION("clearcoat", "clearcoatFactor"), coat, 1, 0.0f, 1.0f, true),
    MATERIAL(EXTENSION("clearcoat", "clearcoatRoughnessFactor"), coat_roughness, 1, 0.0f, 1.0f,
             true),
    MATERIAL(EXTENSION("clearcoat", "clearcoatNormalTexture/scale"), coat_normal_scale, 1, -FLT_MAX,
             FLT_MAX, true),
    MATERIAL(EXTENSION("anisotropy", "anisotropyStrength"), anisotropy_strength, 1, 0.0f, 1.0f,
             true),
    MATERIAL(EXTENSION("anisotropy", "anisotropyRotation"), anisotropy_rotation, 1, -FLT_MAX,
             FLT_MAX, true),
    LIGHT("color", color, 3, FLT_MAX),
    LIGHT("intensity", strength, 1, FLT_MAX),
    LIGHT("range", range, 1, FLT_MAX),
    LIGHT("spot/innerConeAngle", inner_cone, 1, (float)M_PI_2),
    LIGHT("spot/outerConeAngle", outer_cone, 1, (float)M_PI_2),
    CAMERA("perspective/yfov", fov_y, 1e-6f, 3.14159f),
    CAMERA("perspective/znear", near_plane, FLT_MIN, FLT_MAX),
    CAMERA("orthographic/xmag", x_magnification, FLT_MIN, FLT_MAX),
    CAMERA("orthographic/ymag", y_magnification, FLT_MIN, FLT_MAX),
    CAMERA("orthographic/znear", near_plane, 0.0f, FLT_MAX),
};

static const lsf_property transforms[] = {
    {LSF_KIND_MATERIAL, "offset", offsetof(lsf_texture_slot, offset), 2, -FLT_MAX, FLT_MAX, false},
    {LSF_KIND_MATERIAL, "rotation", offsetof(lsf_texture_slot, rotation), 1, -FLT_MAX, FLT_MAX,
     false},
    {LSF_KIND_MATERIAL, "scale", offsetof(lsf_texture_slot, scale), 2, -FLT_MAX, FLT_MAX, false},
};

static const lsf_property visible = {
    LSF_KIND_NODE, "extensions/KHR_node_visibility/visible", 0, 1, 0.0f, 1.0f, false};
const lsf_property *const lsf_property_visible = &visible;

/* Offsets of a material's textures. */
static const char *const slot_names[LSF_SLOT_COUNT] = {
    [LSF_TEXTURE_BASE_COLOR] = "pbrMetallicRoughness/baseColorTexture",
    [LSF_TEXTURE_METALLIC_ROUGHNESS] = "pbrMetallicRoughness/metallicRoughnessTexture",
    [LSF_TEXTURE_NORMAL] = "normalTexture",
    [LSF_TEXTURE_EMISSION] = "emissiveTexture",
    [LSF_TEXTURE_ANISOTROPY] = EXTENSION("anisotropy", "anisotropyTexture"),
    [LSF_TEXTURE_TRANSMISSION] = EXTENSION("transmission", "transmissionTexture"),
    [LSF_TEXTURE_SPECULAR] = EXTENSION("specular", "specularTexture"),
    [LSF_TEXTURE_SPECULAR_COLOR] = EXTENSION("specular", "specularColorTexture"),
    [LSF_TEXTURE_COAT] = EXTENSION("clearcoat", "clearcoatTexture"),
    [LSF_TEXTURE_COAT_ROUGHNESS] = EXTENSION("clearcoat", "clearcoatRoughnessTexture"),
    [LSF_TEXTURE_COAT_NORMAL] = EXTENSION("clearcoat", "clearcoatNormalTexture"),
    [LSF_TEXTURE_SHEEN_COLOR] = EXTENSION("sheen", "sheenColorTexture"),
    [LSF_TEXTURE_SHEEN_ROUGHNESS] = EXTENSION("sheen", "sheenRoughnessTexture"),
    [LSF_TEXTURE_OCCLUSION] = "occlusionTexture",
};

static const lsf_property *find_transform(const char *name, uint32_t *slot)
{
    static const char extension[] = "/extensions/KHR_texture_transform/";
    const char *at = strstr(name, extension);
    size_t length = at ? (size_t)(at - name) : 0;
    for (uint32_t use = 0; at && use < LSF_SLOT_COUNT; use++)
        if (strlen(slot_names[use]) == length && strncmp(slot_names[use], name, length) == 0)
            for (size_t i = 0; i < LSF_COUNT(transforms); i++)
                if (strcmp(transforms[i].name, at + sizeof extension - 1) == 0) {
                    *slot = use;
                    return &transforms[i];
                }
    return NULL;
}

const lsf_property *lsf_property_find(lsf_kind of, const char *name, uint32_t *slot)
{
    *slot = LSF_NONE;
    if (of == LSF_KIND_NODE)
        return strcmp(name, visible.name) == 0 ? &visible : NULL;
    for (size_t i = 0; i < LSF_COUNT(properties); i++)
        if (properties[i].of == of && strcmp(properties[i].name, name) == 0)
            return &properties[i];
    return of == LSF_KIND_MATERIAL ? find_transform(name, slot) : NULL;
}

static void place_slot(lsf_texture_slot *slot)
{
    const double offset[2] = {(double)slot->offset[0], (double)slot->offset[1]};
    const double scale[2] = {(double)slot->scale[0], (double)slot->scale[1]};
    lsf_texture_slot_set_transform(slot, offset, (double)slot->rotation, scale);
}

/* Sets the members that follow from a material's properties, as when files are read. */
static void complete_material(lsf_material *m, const lsf_property *property)
{
    if (m->ior > 0.0f && m->ior < 1.0f)
        m->ior = 1.0f;
    if (property->offset != offsetof(lsf_material, emissive_factor) &&
        property->offset != offsetof(lsf_material, emissive_strength))
        return;
    float emission[3];
    for (int c = 0; c < 3; c++)
        emission[c] = fminf(m->emissive_factor[c] * m->emissive_strength, FLT_MAX);
    lsf_store_light(m->emission, emission, 1.0);
}

static void complete_light(lsf_light *light)
{
    for (int c = 0; c < 3; c++)
        light->intensity[c] = fminf(light->color[c] * light->strength, FLT_MAX);
    light->inner_cone = fminf(light->inner_cone, light->outer_cone);
}

void lsf_property_set(const lsf_animated_value *animated, const double *values, void *thing)
{
    const lsf_property *property = animated->property;
    bool of_slot = animated->slot != LSF_NONE;
    lsf_texture_slot *slot = of_slot ? lsf_material_slot(thing, animated->slot) : NULL;
    float *out = (float *)((char *)(of_slot ? (void *)slot : thing) + property->offset);
    for (uint32_t i = 0; i < property->width; i++)
        out[i] = fminf(fmaxf((float)values[i], property->least), property->most);
    if (of_slot)
        place_slot(slot);
    else if (property->of == LSF_KIND_MATERIAL)
        complete_material(thing, property);
    else if (property->of == LSF_KIND_LIGHT)
        complete_light(thing);
}
