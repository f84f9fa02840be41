#include <lightsheaf/edit.h>

#include <string.h>

#include "base/base.h"
#include "scene/checks.h"
#include "scene/hierarchy.h"
#include "scene/material.h"

static const char *const kind_names[] = {"node", "light", "material", "camera"};

uint32_t lsf_scene_count(const lsf_scene *scene, lsf_kind kind)
{
    if (!scene)
        return 0;
    switch (kind) {
    case LSF_KIND_NODE:
        return scene->node_count;
    case LSF_KIND_LIGHT:
        return scene->light_count;
    case LSF_KIND_MATERIAL:
        return scene->material_count;
    case LSF_KIND_CAMERA:
        return scene->camera_count;
    }
    return 0;
}

const char *lsf_scene_name(const lsf_scene *scene, lsf_kind kind, uint32_t index)
{
    if (!scene)
        return NULL;
    if (index >= lsf_scene_count(scene, kind))
        return NULL;
    const char *name = kind == LSF_KIND_NODE       ? scene->nodes[index].name
                       : kind == LSF_KIND_LIGHT    ? scene->lights[index].name
                       : kind == LSF_KIND_MATERIAL ? scene->materials[index].name
                                                   : scene->cameras[index].name;
    return name ? name : "";
}

uint32_t lsf_scene_find(const lsf_scene *scene, lsf_kind kind, const char *name)
{
    if (!scene || !name)
        return LSF_NOT_FOUND;
    for (uint32_t i = 0; i < lsf_scene_count(scene, kind); i++)
        if (strcmp(lsf_scene_name(scene, kind, i), name) == 0)
            return i;
    return LSF_NOT_FOUND;
}

static bool exists(const lsf_scene *scene, lsf_kind kind, uint32_t index, lsf_error *error)
{
    uint32_t count = lsf_scene_count(scene, kind);
    return index < count ||
           lsf_error_set(error, LSF_ERROR_USAGE, "%s %u does not exist: the scene has %u",
                         kind_names[kind], index, count);
}

/* --- nodes --- */

bool lsf_scene_get_node(const lsf_scene *scene, uint32_t node, double matrix[16], lsf_error *error)
{
    if (!lsf_scene_given(scene, error) || !lsf_given(matrix, "matrix", error))
        return false;
    if (!exists(scene, LSF_KIND_NODE, node, error))
        return false;
    lsf_node_matrix(&scene->nodes[node], matrix);
    return true;
}

bool lsf_scene_set_node(lsf_scene *scene, uint32_t node, const double matrix[16], lsf_error *error)
{
    if (!lsf_scene_given(scene, error) || !lsf_given(matrix, "matrix", error))
        return false;
    if (!exists(scene, LSF_KIND_NODE, node, error))
        return false;
    if (!lsf_check_matrix(node, matrix, error))
        return false;
    lsf_node *edited = &scene->nodes[node];
    memcpy(edited->matrix, matrix, sizeof edited->matrix);
    edited->has_matrix = true;
    scene->edits.nodes++;
    if (edited->edited)
        return true;
    edited->edited = true;
    scene->edits.movable++;
    return lsf_scene_update_requirements(scene) ||
           lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for an edit of node %u", node);
}

/* --- lights and materials --- */

static bool update_requirements(lsf_scene *scene, lsf_error *error)
{
    return lsf_scene_update_requirements(scene) ||
           lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for an edit of %u materials",
                         scene->material_count);
}

bool lsf_scene_get_light(const lsf_scene *scene, uint32_t light, lsf_light_desc *desc,
                         lsf_error *error)
{
    if (!lsf_scene_given(scene, error) || !lsf_given(desc, "desc", error))
        return false;
    if (!exists(scene, LSF_KIND_LIGHT, light, error))
        return false;
    const lsf_light *l = &scene->lights[light];
    *desc = (lsf_light_desc){.type = l->type,
                             .intensity = {l->intensity[0], l->intensity[1], l->intensity[2]},
                             .range = l->range,
                             .inner_cone = l->inner_cone,
                             .outer_cone = l->outer_cone};
    return true;
}

bool lsf_scene_set_light(lsf_scene *scene, uint32_t light, const lsf_light_desc *desc,
                         lsf_error *error)
{
    if (!lsf_scene_given(scene, error) || !lsf_given(desc, "desc", error))
        return false;
    if (!exists(scene, LSF_KIND_LIGHT, light, error))
        return false;
    double scale = scene->requirements.scale, unit = 1.0 / (scale * scale);
    if (!lsf_check_light(light, desc, unit, error))
        return false;
    lsf_light_set(&scene->lights[light], desc, unit);
    scene->lights[light].edited = true;
    scene->edits.lights++;
    return update_requirements(scene, error);
}

bool lsf_scene_get_material(const lsf_scene *scene, uint32_t material, lsf_material_desc *desc,
                            lsf_error *error)
{
    if (!lsf_scene_given(scene, error) || !lsf_given(desc, "desc", error))
        return false;
    if (!exists(scene, LSF_KIND_MATERIAL, material, error))
        return false;
    lsf_material_get(&scene->materials[material], desc);
    return true;
}

bool lsf_scene_set_material(lsf_scene *scene, uint32_t material, const lsf_material_desc *desc,
                            lsf_error *error)
{
    if (!lsf_scene_given(scene, error) || !lsf_given(desc, "desc", error))
        return false;
    if (!exists(scene, LSF_KIND_MATERIAL, material, error) ||
        !lsf_check_material(material, desc, error))
        return false;
    lsf_material *m = &scene->materials[material];
    if (desc->anisotropy > 0.0f && !m->has_tangents && !scene->diffuse_only)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "material %u: anisotropy is %g, and its surfaces have no tangents to "
                             "follow; load it with anisotropy or a normal map",
                             material, (double)desc->anisotropy);
    lsf_material_set(m, desc, scene->diffuse_only);
    m->edited = true;
    scene->edits.materials++;
    return update_requirements(scene, error);
}
