/* A scene without one of its features, beside the scene itself. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "scene/material.h"
#include "scene/scene.h"

static void drop(lsf_texture_slot *slot)
{
    slot->texture = LSF_NONE;
}

/* --- of materials --- */

static void without_emission(lsf_material *m)
{
    memset(m->emission, 0, sizeof m->emission);
    memset(m->emissive_factor, 0, sizeof m->emissive_factor);
    drop(&m->emissive_texture);
}

static void without_unlit(lsf_material *m)
{
    m->unlit = false;
}

static void without_masks(lsf_material *m)
{
    if (m->alpha_mode == LSF_ALPHA_MASK)
        m->alpha_mode = LSF_ALPHA_OPAQUE;
}

static void without_blending(lsf_material *m)
{
    if (m->alpha_mode == LSF_ALPHA_BLEND)
        m->alpha_mode = LSF_ALPHA_OPAQUE;
}

static void without_anisotropy(lsf_material *m)
{
    m->anisotropy_strength = 0.0f;
    drop(&m->anisotropy_texture);
}

static void without_coats(lsf_material *m)
{
    m->coat = 0.0f;
    drop(&m->coat_texture);
    drop(&m->coat_roughness_texture);
    drop(&m->coat_normal_texture);
}

static void without_sheens(lsf_material *m)
{
    memset(m->sheen_color, 0, sizeof m->sheen_color);
    drop(&m->sheen_color_texture);
    drop(&m->sheen_roughness_texture);
}

static void without_roughness_metallic(lsf_material *m)
{
    m->roughness = 1.0f;
    m->metallic = 0.0f;
    drop(&m->metallic_roughness_texture);
    without_anisotropy(m);
    without_coats(m);
    without_sheens(m);
}

static void without_normal_maps(lsf_material *m)
{
    drop(&m->normal_texture);
    drop(&m->coat_normal_texture);
}

static void without_tinted_reflection(lsf_material *m)
{
    m->ior = 1.5f;
    m->specular = 1.0f;
    for (int c = 0; c < 3; c++)
        m->specular_color[c] = 1.0f;
    drop(&m->specular_texture);
    drop(&m->specular_color_texture);
}

static void without_transmission(lsf_material *m)
{
    m->transmission = 0.0f;
    drop(&m->transmission_texture);
}

static void without_textures(lsf_material *m)
{
    for (uint32_t use = 0; use < LSF_SLOT_COUNT; use++)
        drop(lsf_material_slot(m, use));
}

/* --- of the rest --- */

static void without_vertex_colors(lsf_scene *scene)
{
    scene->vertices.color = NULL;
    scene->requirements.vertex_colored = false;
}

static void without_lights(lsf_scene *scene)
{
    for (uint32_t i = 0; i < scene->node_count; i++)
        scene->nodes[i].light = LSF_NONE;
    scene->key_light.present = scene->default_lamp.present = false;
}

/* What is left shines as brightly as the map on average over its texels, each by its solid angle.
 */
static void without_environment_map(lsf_scene *scene)
{
    lsf_environment *e = &scene->environment;
    double sums[3] = {0}, weights = 0.0;
    for (uint32_t y = 0; y < e->height; y++) {
        double weight = sin(M_PI * (y + 0.5) / e->height);
        for (uint32_t x = 0; x < e->width; x++)
            for (int c = 0; c < 3; c++)
                sums[c] += weight * (double)e->texels[3 * ((size_t)y * e->width + x) + (size_t)c];
        weights += weight * e->width;
    }
    for (int c = 0; c < 3; c++)
        e->radiance[c] = (float)(sums[c] / weights);
    e->width = e->height = 0;
    e->texels = NULL;
}

static void without_environment(lsf_scene *scene)
{
    memset(&scene->environment, 0, sizeof scene->environment);
}

static void without_motion(lsf_scene *scene)
{
    scene->channel_count = scene->animated_count = scene->animated_width = 0;
    scene->edits.nodes = scene->edits.movable = 0;
    for (uint32_t i = 0; i < scene->node_count; i++)
        scene->nodes[i].edited = false;
}

static const struct feature_row {
    const char *name;
    void (*of_material)(lsf_material *material);
    void (*of_scene)(lsf_scene *scene);
} rows[LSF_FEATURE_COUNT] = {
    [LSF_FEATURE_EMISSION] = {"emission", without_emission, NULL},
    [LSF_FEATURE_UNLIT] = {"unlit materials", without_unlit, NULL},
    [LSF_FEATURE_MASKS] = {"alpha masks", without_masks, NULL},
    [LSF_FEATURE_BLENDING] = {"blending", without_blending, NULL},
    [LSF_FEATURE_ROUGHNESS_METALLIC] = {"roughness/metallic", without_roughness_metallic, NULL},
    [LSF_FEATURE_NORMAL_MAPS] = {"normal maps", without_normal_maps, NULL},
    [LSF_FEATURE_ANISOTROPY] = {"anisotropy", without_anisotropy, NULL},
    [LSF_FEATURE_TINTED_REFLECTION] = {"tinted reflection", without_tinted_reflection, NULL},
    [LSF_FEATURE_COATS] = {"coats", without_coats, NULL},
    [LSF_FEATURE_SHEENS] = {"sheens", without_sheens, NULL},
    [LSF_FEATURE_TRANSMISSION] = {"transmission", without_transmission, NULL},
    [LSF_FEATURE_TEXTURES] = {"textures", without_textures, NULL},
    [LSF_FEATURE_VERTEX_COLORS] = {"vertex colours", NULL, without_vertex_colors},
    [LSF_FEATURE_LIGHTS] = {"lights", NULL, without_lights},
    [LSF_FEATURE_ENVIRONMENT_MAP] = {"environment map", NULL, without_environment_map},
    [LSF_FEATURE_ENVIRONMENT] = {"environment", NULL, without_environment},
    [LSF_FEATURE_MOTION] = {"motion", NULL, without_motion},
};

static bool reads_textures(const lsf_requirements *r)
{
    return r->base_color_textured || r->metallic_roughness_textured || r->emissive_textured ||
           r->anisotropy_textured || r->transmission_textured || r->specular_textured ||
           r->specular_color_textured || r->sheen_color_textured || r->sheen_roughness_textured ||
           r->coat_textured || r->coat_roughness_textured || r->coat_normal_mapped ||
           r->normal_mapped;
}

static bool asks_for(const lsf_requirements *r, lsf_feature feature)
{
    switch (feature) {
    case LSF_FEATURE_EMISSION:
        return r->emissive;
    case LSF_FEATURE_UNLIT:
        return r->unlit;
    case LSF_FEATURE_MASKS:
        return r->masked;
    case LSF_FEATURE_BLENDING:
        return r->blended;
    case LSF_FEATURE_ROUGHNESS_METALLIC:
        return r->glossy;
    case LSF_FEATURE_NORMAL_MAPS:
        return r->normal_mapped || r->coat_normal_mapped;
    case LSF_FEATURE_ANISOTROPY:
        return r->anisotropic;
    case LSF_FEATURE_TINTED_REFLECTION:
        return r->variable_ior;
    case LSF_FEATURE_COATS:
        return r->coated;
    case LSF_FEATURE_SHEENS:
        return r->sheened;
    case LSF_FEATURE_TRANSMISSION:
        return r->transmissive;
    case LSF_FEATURE_TEXTURES:
        return reads_textures(r);
    case LSF_FEATURE_VERTEX_COLORS:
        return r->vertex_colored;
    case LSF_FEATURE_LIGHTS:
        return r->point_lights + r->spot_lights + r->directional_lights > 0;
    case LSF_FEATURE_ENVIRONMENT_MAP:
        return r->environment_map;
    case LSF_FEATURE_ENVIRONMENT:
        return r->environment;
    case LSF_FEATURE_MOTION:
        return r->moving;
    case LSF_FEATURE_COUNT:
        break;
    }
    return false;
}

const char *lsf_feature_name(lsf_feature feature)
{
    return (unsigned)feature < LSF_FEATURE_COUNT ? rows[feature].name : NULL;
}

bool lsf_scene_has(const lsf_scene *scene, lsf_feature feature)
{
    return scene && asks_for(&scene->requirements, feature);
}

void lsf_scene_without_destroy(lsf_scene *scene)
{
    for (uint32_t i = 0; i < scene->note_count; i++)
        free(scene->notes[i]);
    free(scene->notes);
    free(scene->materials);
    free(scene->nodes);
    free(scene);
}

static void *copy_of(const void *array, uint64_t count, size_t size)
{
    void *copy = lsf_alloc(count, size);
    if (copy && count)
        memcpy(copy, array, count * size);
    return copy;
}

lsf_scene *lsf_scene_without(const lsf_scene *scene, lsf_feature feature, lsf_error *error)
{
    if (!lsf_given(scene, "scene", error))
        return NULL;
    if (scene->draft || (unsigned)feature >= LSF_FEATURE_COUNT) {
        lsf_error_set(error, LSF_ERROR_USAGE,
                      "a whole scene is asked for, and one of its features");
        return NULL;
    }
    lsf_scene *copy = copy_of(scene, 1, sizeof *scene);
    if (copy) {
        copy->borrows = true;
        copy->notes = NULL;
        copy->note_count = 0;
        copy->materials =
            copy_of(scene->materials, scene->material_count, sizeof *scene->materials);
        copy->nodes = copy_of(scene->nodes, scene->node_count, sizeof *scene->nodes);
    }
    bool good = copy && copy->materials && copy->nodes;
    for (uint32_t i = 0; good && rows[feature].of_material && i < copy->material_count; i++)
        rows[feature].of_material(&copy->materials[i]);
    if (good && rows[feature].of_scene)
        rows[feature].of_scene(copy);
    good = (good && lsf_scene_update_requirements(copy)) ||
           lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    if (good && lsf_scene_has(copy, feature))
        good = lsf_error_set(error, LSF_ERROR_USAGE,
                             "the scene cannot do without its %s: an animation brings them back",
                             rows[feature].name);
    if (!good && copy)
        lsf_scene_without_destroy(copy);
    return good ? copy : NULL;
}
