#include "rebuild.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/base.h"
#include "scene/material.h"

#include <lightsheaf/build.h>

static lsf_error error;

#define ADDED(call)                                                                                \
    do {                                                                                           \
        if ((call) == LSF_NONE)                                                                    \
            fail_msg("%s", error.message);                                                         \
    } while (0)

lsf_scene *load_default_scene(const char *name)
{
    const char *root = getenv("LSF_SOURCE_ROOT");
    char *path = lsf_format("%s/data/scenes/%s", root ? root : ".", name);
    lsf_scene *scene = lsf_scene_load(path, NULL, &error);
    if (!scene)
        fail_msg("%s", error.message);
    free(path);
    return scene;
}

static void add_textures(lsf_scene *built, const lsf_scene *scene)
{
    for (uint32_t i = 0; i < scene->texture_count; i++) {
        const lsf_texture *texture = &scene->textures[i];
        const lsf_texture_image *image = &scene->images[texture->image];
        ADDED(lsf_scene_add_texture(built,
                                    &(lsf_scene_texture_desc){.name = image->name,
                                                              .width = image->width,
                                                              .height = image->height,
                                                              .channels = image->channels,
                                                              .type = image->type,
                                                              .texels = image->texels,
                                                              .srgb = texture->srgb,
                                                              .wrap_s = texture->wrap_s,
                                                              .wrap_t = texture->wrap_t,
                                                              .nearest = texture->nearest},
                                    &error));
    }
}

static void add_materials(lsf_scene *built, const lsf_scene *scene)
{
    for (uint32_t i = 0; i + 1 < scene->material_count; i++) {
        lsf_material_desc desc;
        lsf_material_texture textures[LSF_TEXTURE_USE_COUNT];
        uint32_t count = 0;
        assert_true(lsf_scene_get_material(scene, i, &desc, &error));
        for (uint32_t use = 0; use < LSF_TEXTURE_USE_COUNT; use++) {
            const lsf_texture_slot *slot = lsf_material_slot(&scene->materials[i], use);
            lsf_material_texture *texture = &textures[count];
            if (slot->texture == LSF_NONE)
                continue;
            *texture = (lsf_material_texture){
                .use = (lsf_texture_use)use, .texture = slot->texture, .uv_set = slot->uv_set};
            memcpy(texture->transform, slot->transform, sizeof texture->transform);
            count++;
        }
        ADDED(lsf_scene_add_material(built, scene->materials[i].name, &desc, textures, count,
                                     &error));
    }
}

static void add_mesh(lsf_scene *built, const lsf_scene *scene, const lsf_mesh *mesh)
{
    const lsf_vertices *v = &scene->vertices;
    lsf_mesh_part parts[8];
    uint32_t *indices[8];
    assert_in_range(mesh->primitive_count, 0, 8);
    for (uint32_t p = 0; p < mesh->primitive_count; p++) {
        const lsf_primitive *primitive = &scene->primitives[mesh->first_primitive + p];
        uint64_t first = primitive->first_vertex;
        bool of_default = primitive->material + 1 == scene->material_count;
        indices[p] = lsf_alloc(primitive->index_count, sizeof(uint32_t));
        for (uint32_t i = 0; i < primitive->index_count; i++)
            indices[p][i] = (uint32_t)(scene->indices[primitive->first_index + i] - first);
        parts[p] = (lsf_mesh_part){
            .material = of_default ? LSF_NONE : primitive->material,
            .vertex_count = primitive->vertex_count,
            .positions = v->position + 3 * first,
            .normals = v->normal + 3 * first,
            .tangents = v->tangent ? v->tangent + 4 * first : NULL,
            .uvs = {v->uv0 ? v->uv0 + 2 * first : NULL, v->uv1 ? v->uv1 + 2 * first : NULL},
            .colors = v->color ? v->color + 4 * first : NULL,
            .index_count = primitive->index_count,
            .indices = indices[p]};
    }
    ADDED(lsf_scene_add_mesh(built, mesh->name, parts, mesh->primitive_count, &error));
    for (uint32_t p = 0; p < mesh->primitive_count; p++)
        free(indices[p]);
}

static void add_nodes(lsf_scene *built, const lsf_scene *scene)
{
    for (uint32_t i = 0; i < scene->light_count; i++) {
        lsf_light_desc desc;
        assert_true(lsf_scene_get_light(scene, i, &desc, &error));
        ADDED(lsf_scene_add_light(built, scene->lights[i].name, &desc, &error));
    }
    for (uint32_t i = 0; i < scene->node_count; i++) {
        const lsf_node *node = &scene->nodes[i];
        lsf_node_desc desc = {
            .name = node->name, .parent = node->parent, .mesh = node->mesh, .light = node->light};
        assert_true(lsf_scene_get_node(scene, i, desc.matrix, &error));
        ADDED(lsf_scene_add_node(built, &desc, &error));
    }
    for (uint32_t i = 0; i < scene->camera_count; i++) {
        const lsf_camera *camera = &scene->cameras[i];
        if (camera->frames_scene)
            continue; /* added by committing */
        ADDED(lsf_scene_add_camera(
            built,
            &(lsf_camera_desc){.name = camera->name,
                               .node = camera->node,
                               .fov_y = (float)((double)camera->fov_y * (180.0 / M_PI)),
                               .height =
                                   camera->orthographic ? 2.0f * camera->y_magnification : 0.0f,
                               .near_plane = camera->near_plane},
            &error));
    }
}

lsf_scene *rebuild(const lsf_scene *scene)
{
    lsf_scene *built = lsf_scene_create(NULL, &error);
    assert_non_null(built);
    add_textures(built, scene);
    add_materials(built, scene);
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        add_mesh(built, scene, &scene->meshes[i]);
    add_nodes(built, scene);
    if (!lsf_scene_commit(built, &error))
        fail_msg("%s", error.message);
    return built;
}
