#include <lightsheaf/build.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "scene/checks.h"
#include "scene/complete.h"
#include "scene/draft.h"
#include "scene/environment.h"
#include "scene/material.h"

/* The same limit as for files (io.h). */
#define IMAGE_MAX_SIZE 65535u

/* --- the draft --- */

lsf_scene *lsf_draft_create(const char *name, lsf_default_light default_light)
{
    lsf_scene *scene = lsf_alloc(1, sizeof *scene);
    if (!scene)
        return NULL;
    scene->path = strdup(name ? name : "scene");
    scene->draft = lsf_alloc(1, sizeof *scene->draft);
    if (!scene->path || !scene->draft) {
        lsf_scene_destroy(scene);
        return NULL;
    }
    scene->draft->default_light = default_light;
    lsf_geometry_begin(&scene->draft->geometry, scene);
    return scene;
}

bool lsf_draft_given(const lsf_scene *scene, lsf_error *error)
{
    if (!lsf_given(scene, "scene", error))
        return false;
    if (!scene->draft)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "the scene is whole: things are added to one that lsf_scene_create "
                             "made, until it is committed");
    return !scene->draft->failed ||
           lsf_error_set(error, LSF_ERROR_USAGE,
                         "the scene could not be committed: it can only be destroyed");
}

bool lsf_draft_grow(void *array, uint64_t *capacity, uint32_t count, size_t size, lsf_error *error)
{
    void *grown;
    memcpy(&grown, array, sizeof grown);
    bool enough = count < UINT32_MAX - 1 && lsf_grow(&grown, capacity, (uint64_t)count + 1, size);
    memcpy(array, &grown, sizeof grown);
    return enough ||
           lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for one more than %u", count);
}

char *lsf_draft_name(const char *name, lsf_error *error)
{
    char *copy = strdup(name ? name : "");
    if (copy)
        lsf_make_printable(copy);
    else
        lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    return copy;
}

/* Whether an index that may be LSF_NONE names one of `count`. */
static bool refers(const char *what, uint32_t index, const char *to, uint32_t named, uint32_t count,
                   lsf_error *error)
{
    return named < count || named == LSF_NONE ||
           lsf_error_set(error, LSF_ERROR_USAGE,
                         "%s %u: %s %u does not exist; the scene has %u so far", what, index, to,
                         named, count);
}

/* --- textures --- */

static bool check_texels(uint32_t index, const lsf_scene_texture_desc *desc, lsf_error *error)
{
    const float *values = desc->texels;
    uint64_t count = (uint64_t)desc->width * desc->height * desc->channels;
    for (uint64_t i = 0; desc->type == LSF_TEXEL_F32 && i < count; i++)
        if (!(values[i] >= 0.0f && values[i] <= FLT_MAX))
            return lsf_error_set(
                error, LSF_ERROR_USAGE,
                "texture %u: channel %u of texel %llu is %g; it must be finite and at least 0",
                index, (unsigned)(i % desc->channels), (unsigned long long)(i / desc->channels),
                (double)values[i]);
    return true;
}

static bool check_texture(uint32_t index, const lsf_scene_texture_desc *desc, lsf_error *error)
{
    if (desc->width - 1 >= IMAGE_MAX_SIZE || desc->height - 1 >= IMAGE_MAX_SIZE)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "texture %u: it has %u x %u texels; both must lie between 1 and %u",
                             index, desc->width, desc->height, IMAGE_MAX_SIZE);
    if (desc->channels < 1 || desc->channels > 4 || desc->type > LSF_TEXEL_F32 ||
        desc->wrap_s > LSF_WRAP_MIRROR || desc->wrap_t > LSF_WRAP_MIRROR)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "texture %u: there is no such thing as %u channels of type %d with "
                             "wraps %d and %d",
                             index, desc->channels, (int)desc->type, (int)desc->wrap_s,
                             (int)desc->wrap_t);
    if (desc->srgb && desc->type == LSF_TEXEL_F32)
        return lsf_error_set(error, LSF_ERROR_USAGE, "texture %u: floats are linear, not sRGB",
                             index);
    return lsf_given(desc->texels, "lsf_scene_texture_desc.texels", error) &&
           check_texels(index, desc, error);
}

uint32_t lsf_scene_add_texture(lsf_scene *scene, const lsf_scene_texture_desc *desc,
                               lsf_error *error)
{
    if (!lsf_draft_given(scene, error) || !lsf_given(desc, "desc", error) ||
        !check_texture(scene->texture_count, desc, error))
        return LSF_NONE;
    static const size_t texel_bytes[] = {1, 2, 4};
    lsf_draft *draft = scene->draft;
    uint64_t bytes =
        (uint64_t)desc->width * desc->height * desc->channels * texel_bytes[desc->type];
    char *name = lsf_draft_name(desc->name, error);
    void *texels = lsf_alloc(bytes, 1);
    if (!texels)
        lsf_error_set(error, LSF_ERROR_RENDER, "texture %u: out of memory for %llu bytes",
                      scene->texture_count, (unsigned long long)bytes);
    if (!name || !texels ||
        !lsf_draft_grow(&scene->images, &draft->image_capacity, scene->image_count,
                        sizeof *scene->images, error) ||
        !lsf_draft_grow(&scene->textures, &draft->texture_capacity, scene->texture_count,
                        sizeof *scene->textures, error)) {
        free(name);
        free(texels);
        return LSF_NONE;
    }
    memcpy(texels, desc->texels, bytes);
    scene->images[scene->image_count] = (lsf_texture_image){.name = name,
                                                            .width = desc->width,
                                                            .height = desc->height,
                                                            .channels = desc->channels,
                                                            .type = desc->type,
                                                            .texels = texels};
    scene->textures[scene->texture_count] = (lsf_texture){.image = scene->image_count++,
                                                          .wrap_s = desc->wrap_s,
                                                          .wrap_t = desc->wrap_t,
                                                          .nearest = desc->nearest,
                                                          .srgb = desc->srgb};
    return scene->texture_count++;
}

/* --- materials --- */

static bool set_slot(const lsf_scene *scene, lsf_material *material,
                     const lsf_material_texture *texture, lsf_error *error)
{
    uint32_t index = scene->material_count;
    if (texture->use >= LSF_TEXTURE_USE_COUNT)
        return lsf_error_set(error, LSF_ERROR_USAGE, "material %u: no texture has the use %d",
                             index, (int)texture->use);
    lsf_texture_slot *slot = lsf_material_slot(material, texture->use);
    if (slot->texture != LSF_NONE)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "material %u: two textures are of the same use, %d", index,
                             (int)texture->use);
    if (texture->texture >= scene->texture_count)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "material %u: texture %u does not exist; the scene has %u so far",
                             index, texture->texture, scene->texture_count);
    if (texture->uv_set > 1)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "material %u: a texture reads set %u of texture coordinates, and "
                             "there are 0 and 1",
                             index, texture->uv_set);
    for (int i = 0; i < 6; i++)
        if (!isfinite(texture->transform[i]))
            return lsf_error_set(error, LSF_ERROR_USAGE,
                                 "material %u: a texture's transform must be finite", index);
    *slot = (lsf_texture_slot){.texture = texture->texture, .uv_set = texture->uv_set};
    memcpy(slot->transform, texture->transform, sizeof slot->transform);
    return true;
}

/* Where materials are diffuse only, textures of other lobes are left out, as for files. */
static bool is_kept(const lsf_scene *scene, lsf_texture_use use)
{
    return !scene->diffuse_only || use == LSF_TEXTURE_BASE_COLOR || use == LSF_TEXTURE_EMISSION;
}

uint32_t lsf_scene_add_material(lsf_scene *scene, const char *name, const lsf_material_desc *desc,
                                const lsf_material_texture *textures, uint32_t texture_count,
                                lsf_error *error)
{
    if (!lsf_draft_given(scene, error) || !lsf_given(desc, "desc", error) ||
        (texture_count > 0 && !lsf_given(textures, "textures", error)) ||
        !lsf_check_material(scene->material_count, desc, error))
        return LSF_NONE;
    lsf_material material = lsf_default_material(scene->diffuse_only), checked = material;
    lsf_material_set(&material, desc, scene->diffuse_only);
    for (uint32_t i = 0; i < texture_count; i++)
        if (!set_slot(scene, &checked, &textures[i], error) ||
            (is_kept(scene, textures[i].use) && !set_slot(scene, &material, &textures[i], error)))
            return LSF_NONE;
    material.has_tangents = lsf_material_wants_tangents(&material);
    material.name = lsf_draft_name(name, error);
    if (!material.name || !lsf_draft_grow(&scene->materials, &scene->draft->material_capacity,
                                          scene->material_count, sizeof material, error)) {
        free(material.name);
        return LSF_NONE;
    }
    scene->materials[scene->material_count] = material;
    return scene->material_count++;
}

/* --- what is placed --- */

uint32_t lsf_scene_add_light(lsf_scene *scene, const char *name, const lsf_light_desc *desc,
                             lsf_error *error)
{
    if (!lsf_draft_given(scene, error) || !lsf_given(desc, "desc", error) ||
        !lsf_check_light(scene->light_count, desc, FLT_MAX, error))
        return LSF_NONE;
    lsf_light light = {.name = lsf_draft_name(name, error)};
    if (!light.name || !lsf_draft_grow(&scene->lights, &scene->draft->light_capacity,
                                       scene->light_count, sizeof light, error)) {
        free(light.name);
        return LSF_NONE;
    }
    lsf_light_set(&light, desc, 0.0);
    scene->lights[scene->light_count] = light;
    return scene->light_count++;
}

uint32_t lsf_scene_add_node(lsf_scene *scene, const lsf_node_desc *desc, lsf_error *error)
{
    if (!lsf_draft_given(scene, error) || !lsf_given(desc, "desc", error))
        return LSF_NONE;
    uint32_t index = scene->node_count;
    if (!lsf_check_matrix(index, desc->matrix, error) ||
        !refers("node", index, "parent", desc->parent, scene->node_count, error) ||
        !refers("node", index, "mesh", desc->mesh, scene->mesh_count, error) ||
        !refers("node", index, "light", desc->light, scene->light_count, error))
        return LSF_NONE;
    lsf_node node = {.name = lsf_draft_name(desc->name, error),
                     .parent = desc->parent,
                     .mesh = desc->mesh,
                     .camera = LSF_NONE,
                     .light = desc->light,
                     .has_matrix = true,
                     .rotation = {0.0, 0.0, 0.0, 1.0},
                     .scale = {1.0, 1.0, 1.0}};
    memcpy(node.matrix, desc->matrix, sizeof node.matrix);
    if (!node.name ||
        !lsf_draft_grow(&scene->nodes, &scene->draft->node_capacity, index, sizeof node, error)) {
        free(node.name);
        return LSF_NONE;
    }
    scene->nodes[scene->node_count++] = node;
    return index;
}

static bool check_camera(const lsf_scene *scene, const lsf_camera_desc *desc, lsf_error *error)
{
    uint32_t index = scene->camera_count;
    if (desc->node >= scene->node_count || scene->nodes[desc->node].camera != LSF_NONE)
        return lsf_error_set(
            error, LSF_ERROR_USAGE, "camera %u: node %u %s; a camera stands on a node of its own",
            index, desc->node, desc->node < scene->node_count ? "carries one" : "does not exist");
    if (!(desc->height >= 0.0f && desc->height <= FLT_MAX) ||
        (desc->height == 0.0f && !(desc->fov_y > 0.0f && desc->fov_y < 180.0f)))
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "camera %u needs a fov_y between 0 and 180 degrees, or a height above "
                             "0: they are %g and %g",
                             index, (double)desc->fov_y, (double)desc->height);
    bool begins = desc->height > 0.0f ? desc->near_plane >= 0.0f : desc->near_plane > 0.0f;
    return (begins && desc->near_plane <= FLT_MAX) ||
           lsf_error_set(error, LSF_ERROR_USAGE, "camera %u: near_plane is %g; it must be above 0",
                         index, (double)desc->near_plane);
}

uint32_t lsf_scene_add_camera(lsf_scene *scene, const lsf_camera_desc *desc, lsf_error *error)
{
    if (!lsf_draft_given(scene, error) || !lsf_given(desc, "desc", error) ||
        !check_camera(scene, desc, error))
        return LSF_NONE;
    float half = desc->height > 0.0f ? 0.5f * desc->height : 1.0f;
    lsf_camera camera = {.name = lsf_draft_name(desc->name, error),
                         .node = desc->node,
                         .orthographic = desc->height > 0.0f,
                         .fov_y = (float)((double)desc->fov_y * (M_PI / 180.0)),
                         .x_magnification = half,
                         .y_magnification = half,
                         .near_plane = desc->near_plane};
    if (!camera.name || !lsf_draft_grow(&scene->cameras, &scene->draft->camera_capacity,
                                        scene->camera_count, sizeof camera, error)) {
        free(camera.name);
        return LSF_NONE;
    }
    scene->nodes[desc->node].camera = scene->camera_count;
    scene->cameras[scene->camera_count] = camera;
    return scene->camera_count++;
}

/* --- the environment --- */

static bool check_radiance(const float *values, uint64_t count, lsf_error *error)
{
    for (uint64_t i = 0; i < count; i++)
        if (!(values[i] >= 0.0f && values[i] <= FLT_MAX))
            return lsf_error_set(error, LSF_ERROR_USAGE,
                                 "environment: radiance %g must be finite and at least 0",
                                 (double)values[i]);
    return true;
}

bool lsf_scene_set_environment(lsf_scene *scene, const lsf_environment_desc *desc, lsf_error *error)
{
    if (!lsf_draft_given(scene, error) || !lsf_given(desc, "desc", error))
        return false;
    uint64_t values = desc->texels ? (uint64_t)3 * desc->width * desc->height : 0;
    if (desc->texels && (desc->width - 1 >= IMAGE_MAX_SIZE || desc->height - 1 >= IMAGE_MAX_SIZE))
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "environment: it has %u x %u texels; both must lie between 1 and %u",
                             desc->width, desc->height, IMAGE_MAX_SIZE);
    if (!isfinite(desc->rotation))
        return lsf_error_set(error, LSF_ERROR_USAGE, "environment: rotation %g must be finite",
                             (double)desc->rotation);
    if (!check_radiance(desc->radiance, 3, error) || !check_radiance(desc->texels, values, error))
        return false;
    lsf_environment environment = {.present = true};
    lsf_environment_rotate(&environment, desc->rotation);
    memcpy(environment.radiance, desc->radiance, sizeof environment.radiance);
    if (desc->texels) {
        environment.width = desc->width;
        environment.height = desc->height;
        environment.texels = lsf_alloc(values, sizeof *environment.texels);
        if (!environment.texels)
            return lsf_error_set(error, LSF_ERROR_RENDER, "environment: out of memory");
        memcpy(environment.texels, desc->texels, values * sizeof *environment.texels);
    }
    free(scene->environment.texels);
    scene->environment = environment;
    return true;
}

/* --- committing --- */

static bool add_default_material(lsf_scene *scene, lsf_error *error)
{
    lsf_material material = lsf_default_material(scene->diffuse_only);
    material.name = lsf_draft_name("default", error);
    if (!material.name || !lsf_draft_grow(&scene->materials, &scene->draft->material_capacity,
                                          scene->material_count, sizeof material, error)) {
        free(material.name);
        return false;
    }
    scene->materials[scene->material_count++] = material;
    for (uint32_t i = 0; i < scene->primitive_count; i++)
        if (scene->primitives[i].material == LSF_NONE)
            scene->primitives[i].material = scene->material_count - 1;
    return true;
}

static bool place_meshes(lsf_scene *scene, lsf_error *error)
{
    uint64_t count = 0;
    for (uint32_t i = 0; i < scene->node_count; i++)
        if (scene->nodes[i].mesh != LSF_NONE)
            count += scene->meshes[scene->nodes[i].mesh].primitive_count;
    scene->instances = count < UINT32_MAX ? lsf_alloc(count, sizeof *scene->instances) : NULL;
    if (!scene->instances)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %llu instances",
                             (unsigned long long)count);
    for (uint32_t i = 0; i < scene->node_count; i++) {
        const lsf_node *node = &scene->nodes[i];
        for (uint32_t p = 0;
             node->mesh != LSF_NONE && p < scene->meshes[node->mesh].primitive_count; p++)
            scene->instances[scene->instance_count++] =
                (lsf_instance){i, scene->meshes[node->mesh].first_primitive + p};
    }
    return true;
}

bool lsf_scene_commit(lsf_scene *scene, lsf_error *error)
{
    if (!lsf_draft_given(scene, error))
        return false;
    lsf_draft *draft = scene->draft;
    draft->failed = true;
    lsf_scene_note_frames(scene, &draft->repairs);
    if (!add_default_material(scene, error) || !place_meshes(scene, error))
        return false;
    lsf_error found;
    if (!lsf_scene_complete(scene, draft->default_light, &found))
        return lsf_error_set(error, LSF_ERROR_USAGE, "%s", found.message);
    free(draft);
    scene->draft = NULL;
    return true;
}
