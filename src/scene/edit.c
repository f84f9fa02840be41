#include <lightsheaf/edit.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/base.h"
#include "scene/hierarchy.h"
#include "scene/light_range.h"
#include "scene/scene.h"

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
    if (!lsf_given(scene, "scene", error) || !lsf_given(matrix, "matrix", error))
        return false;
    if (!exists(scene, LSF_KIND_NODE, node, error))
        return false;
    lsf_node_matrix(&scene->nodes[node], matrix);
    return true;
}

bool lsf_scene_set_node(lsf_scene *scene, uint32_t node, const double matrix[16], lsf_error *error)
{
    if (!lsf_given(scene, "scene", error) || !lsf_given(matrix, "matrix", error))
        return false;
    if (!exists(scene, LSF_KIND_NODE, node, error))
        return false;
    for (int i = 0; i < 16; i++)
        if (!isfinite(matrix[i]) || (i % 4 == 3 && matrix[i] != (i == 15 ? 1.0 : 0.0)))
            return lsf_error_set(error, LSF_ERROR_USAGE,
                                 "node %u: entry %d of the matrix is %g; it must be finite, and "
                                 "its last row 0, 0, 0, 1",
                                 node, i, matrix[i]);
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

/* Whether a value of `what` number `index` lies between two bounds. */
static bool within(const char *what, uint32_t index, const char *name, float value, double least,
                   double most, lsf_error *error)
{
    return ((double)value >= least && (double)value <= most) ||
           lsf_error_set(error, LSF_ERROR_USAGE, "%s %u: %s is %g; it must lie between %g and %g",
                         what, index, name, (double)value, least, most);
}

/* Light is none at all, or as bright as floats keep apart from none (light_range.h). `unit`: what a
 * normalised unit of it is in the scene's. */
static bool bright(const char *what, uint32_t index, const char *name, const float light[3],
                   double unit, lsf_error *error)
{
    for (int i = 0; i < 3; i++)
        if (!within(what, index, name, light[i], 0.0, LSF_LIGHT_BRIGHTEST * unit, error))
            return false;
    return true;
}

static void store_light(float out[3], const float light[3], double unit)
{
    float largest = fmaxf(light[0], fmaxf(light[1], light[2]));
    for (int i = 0; i < 3; i++)
        out[i] = (double)largest < LSF_LIGHT_DIMMEST * unit ? 0.0f : light[i];
}

static bool update_requirements(lsf_scene *scene, lsf_error *error)
{
    return lsf_scene_update_requirements(scene) ||
           lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for an edit of %u materials",
                         scene->material_count);
}

bool lsf_scene_get_light(const lsf_scene *scene, uint32_t light, lsf_light_desc *desc,
                         lsf_error *error)
{
    if (!lsf_given(scene, "scene", error) || !lsf_given(desc, "desc", error))
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
    if (!lsf_given(scene, "scene", error) || !lsf_given(desc, "desc", error))
        return false;
    if (!exists(scene, LSF_KIND_LIGHT, light, error))
        return false;
    if (desc->type > LSF_LIGHT_DIRECTIONAL)
        return lsf_error_set(error, LSF_ERROR_USAGE, "light %u: there is no type %d", light,
                             (int)desc->type);
    double scale = desc->type == LSF_LIGHT_DIRECTIONAL ? 1.0 : scene->requirements.scale;
    double unit = 1.0 / (scale * scale);
    if (!bright("light", light, "intensity", desc->intensity, fmin(unit, (double)FLT_MAX), error) ||
        !within("light", light, "range", desc->range, 0.0, INFINITY, error))
        return false;
    if (desc->type == LSF_LIGHT_SPOT &&
        (!within("light", light, "outer_cone", desc->outer_cone, 0.0, M_PI_2 + 1e-6, error) ||
         !within("light", light, "inner_cone", desc->inner_cone, 0.0, desc->outer_cone, error)))
        return false;
    lsf_light *l = &scene->lights[light];
    l->type = desc->type;
    store_light(l->intensity, desc->intensity, unit);
    l->range = desc->range;
    l->inner_cone = desc->inner_cone;
    l->outer_cone = desc->outer_cone;
    scene->edits.lights++;
    return update_requirements(scene, error);
}

bool lsf_scene_get_material(const lsf_scene *scene, uint32_t material, lsf_material_desc *desc,
                            lsf_error *error)
{
    if (!lsf_given(scene, "scene", error) || !lsf_given(desc, "desc", error))
        return false;
    if (!exists(scene, LSF_KIND_MATERIAL, material, error))
        return false;
    const lsf_material *m = &scene->materials[material];
    *desc = (lsf_material_desc){.metallic = m->metallic,
                                .roughness = m->roughness,
                                .alpha_mode = m->alpha_mode,
                                .alpha_cutoff = m->alpha_cutoff,
                                .double_sided = m->double_sided,
                                .ior = m->ior,
                                .transmission = m->transmission,
                                .coat = m->coat,
                                .coat_roughness = m->coat_roughness};
    memcpy(desc->base_color, m->base_color, sizeof desc->base_color);
    memcpy(desc->emission, m->emission, sizeof desc->emission);
    return true;
}

static bool check_material(uint32_t index, const lsf_material_desc *desc, lsf_error *error)
{
    const struct {
        const char *name;
        float value;
    } shares[] = {
        {"base_color", desc->base_color[0]},
        {"base_color", desc->base_color[1]},
        {"base_color", desc->base_color[2]},
        {"base_color", desc->base_color[3]},
        {"metallic", desc->metallic},
        {"roughness", desc->roughness},
        {"transmission", desc->transmission},
        {"coat", desc->coat},
        {"coat_roughness", desc->coat_roughness},
    };
    for (size_t i = 0; i < LSF_COUNT(shares); i++)
        if (!within("material", index, shares[i].name, shares[i].value, 0.0, 1.0, error))
            return false;
    if (desc->alpha_mode > LSF_ALPHA_BLEND)
        return lsf_error_set(error, LSF_ERROR_USAGE, "material %u: there is no alpha mode %d",
                             index, (int)desc->alpha_mode);
    return bright("material", index, "emission", desc->emission, 1.0, error) &&
           within("material", index, "alpha_cutoff", desc->alpha_cutoff, 0.0, INFINITY, error) &&
           (desc->ior == 0.0f || within("material", index, "ior", desc->ior, 1.0, 1e6, error));
}

bool lsf_scene_set_material(lsf_scene *scene, uint32_t material, const lsf_material_desc *desc,
                            lsf_error *error)
{
    if (!lsf_given(scene, "scene", error) || !lsf_given(desc, "desc", error))
        return false;
    if (!exists(scene, LSF_KIND_MATERIAL, material, error) ||
        !check_material(material, desc, error))
        return false;
    lsf_material *m = &scene->materials[material];
    memcpy(m->base_color, desc->base_color, sizeof m->base_color);
    store_light(m->emission, desc->emission, 1.0);
    m->metallic = desc->metallic;
    m->roughness = desc->roughness;
    m->alpha_mode = desc->alpha_mode;
    m->alpha_cutoff = desc->alpha_cutoff;
    m->double_sided = desc->double_sided;
    m->ior = desc->ior;
    m->transmission = desc->transmission;
    m->coat = desc->coat;
    m->coat_roughness = desc->coat_roughness;
    scene->edits.materials++;
    return update_requirements(scene, error);
}
