#include "frame/scene_gpu.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "frame/lobes.h"
#include "frame/scene_dynamic.h"
#include "frame/texture_upload.h"
#include "shared/brdf.h"
#include "shared/scene_data.h"

typedef struct lsf_instance_data instance_data;
typedef struct lsf_material_data material_data;

const char *const lsf_draw_count_names[LSF_DRAW_COUNTS] = {"instances_drawn", "instances_culled",
                                                           "triangles"};

static bool any_texture(const lsf_plan *plan)
{
    const lsf_requirements *r = &plan->requirements;
    return r->base_color_textured || r->metallic_roughness_textured || r->normal_mapped ||
           r->emissive_textured || r->anisotropy_textured || r->specular_textured ||
           r->specular_color_textured || r->coat_textured || r->coat_roughness_textured ||
           r->coat_normal_mapped || r->sheen_color_textured || r->sheen_roughness_textured ||
           (plan->transmission && r->transmission_textured);
}

/* Whether alpha may discard fragments. */
static bool cuts_out(const lsf_requirements *r)
{
    return r->masked || r->blended;
}

void lsf_scene_gpu_plan(lsf_plan *plan, const lsf_scene *scene)
{
    const lsf_requirements *r = &plan->requirements;
    uint64_t vertices = scene->vertices.count;
    if (scene->instance_count == 0 || scene->index_count == 0) {
        lsf_plan_omit(plan, "scene.positions", "the scene has no triangles");
    } else {
        lsf_plan_buffer_add(plan, "scene.positions", vertices * 12, "3 floats a vertex");
        lsf_plan_buffer_add(plan, "scene.normals", vertices * 12, "3 floats a vertex");
        lsf_plan_buffer_add(plan, "scene.indices", scene->index_count * 4, "32 bits each");
        lsf_plan_buffer_add(plan, "scene.instances", scene->instance_count * sizeof(instance_data),
                            "transforms and material of %u instance%s", scene->instance_count,
                            lsf_plural(scene->instance_count));
        lsf_plan_buffer_add(plan, "scene.materials", scene->material_count * sizeof(material_data),
                            "%u material%s", scene->material_count,
                            lsf_plural(scene->material_count));
        if (lsf_scene_gpu_has_lobes(r))
            lsf_plan_buffer_add(
                plan, "scene.lobes", scene->material_count * sizeof(struct lsf_lobe_data),
                "some reflection is tinted or weighed, or some material is coated or has a sheen");
        else
            lsf_plan_omit(plan, "scene.lobes",
                          "no reflection is tinted or weighed, and nothing is coated");
        if (r->normal_mapped || r->anisotropic || r->coat_normal_mapped)
            lsf_plan_buffer_add(plan, "scene.tangents", vertices * 16, "%s",
                                r->normal_mapped || r->coat_normal_mapped ? "normal maps"
                                                                          : "anisotropy");
        else
            lsf_plan_omit(plan, "scene.tangents", "no normal map and no anisotropy");
        if (any_texture(plan))
            lsf_plan_buffer_add(plan, "scene.uv0", vertices * 8, "textures");
        else
            lsf_plan_omit(plan, "scene.uv0", "no textures");
        if (r->second_uv)
            lsf_plan_buffer_add(plan, "scene.uv1", vertices * 8, "a texture reads TEXCOORD_1");
        if (r->vertex_colored)
            lsf_plan_buffer_add(plan, "scene.colors", vertices * 16, "vertex colours");
        if (lsf_plan_measures_motion(plan))
            lsf_plan_buffer_add(plan, "scene.previous_transforms",
                                (uint64_t)scene->instance_count * 48, "motion is asked for");
        if (lsf_plan_measures_motion(plan) && (r->skinned || r->morphed))
            lsf_plan_buffer_add(plan, "scene.previous_positions", vertices * 12,
                                "motion is asked for, and vertices are deformed");
    }
    lsf_texture_upload_plan(plan, scene);
}

void lsf_scene_gpu_material_switches(lsf_plan *plan, bool specular_params, bool emission)
{
    const lsf_requirements *r = &plan->requirements;
    const struct {
        const char *name;
        bool on;
        const char *why;
    } switches[] = {
        {"LSF_TEXTURED", any_texture(plan), "some material has a texture"},
        {"LSF_SECOND_UV", r->second_uv, "some texture reads TEXCOORD_1"},
        {"LSF_VERTEX_COLOR", r->vertex_colored, "some primitive has colours"},
        {"LSF_TANGENT", r->normal_mapped || r->anisotropic || r->coat_normal_mapped,
         "there are normal maps or anisotropy"},
        {"LSF_BASE_COLOR_TEXTURE", r->base_color_textured, "some base colour is a texture"},
        {"LSF_NORMAL_TEXTURE", r->normal_mapped, "some material has a normal map"},
        {"LSF_MASK", cuts_out(r), "some material is alpha-masked or blended"},
        {"LSF_BLEND", r->blended, "some material is blended"},
        {"LSF_SPECULAR_PARAMS", specular_params, "roughness or metallic vary"},
        {"LSF_METALLIC_ROUGHNESS_TEXTURE", specular_params && r->metallic_roughness_textured,
         "some roughness or metallic is a texture"},
        {"LSF_ANISOTROPY", specular_params && r->anisotropic, "some material is anisotropic"},
        {"LSF_ANISOTROPY_TEXTURE", specular_params && r->anisotropy_textured,
         "some anisotropy is a texture"},
        {"LSF_SPECULAR_TINT", specular_params && r->specular_varied,
         "some reflection is tinted or weighed"},
        {"LSF_SPECULAR_TEXTURE", specular_params && r->specular_textured,
         "some weight is a texture"},
        {"LSF_SPECULAR_COLOR_TEXTURE", specular_params && r->specular_color_textured,
         "some tint is a texture"},
        {"LSF_LOBES", specular_params && lsf_scene_gpu_has_lobes(r),
         "some material has a lobe that few have"},
        {"LSF_SHEEN_COLOR_TEXTURE", specular_params && r->sheen_color_textured,
         "some sheen is a texture"},
        {"LSF_SHEEN_ROUGHNESS_TEXTURE", specular_params && r->sheen_roughness_textured,
         "some sheen's roughness is a texture"},
        {"LSF_COAT_TEXTURE", specular_params && r->coat_textured, "some coat is a texture"},
        {"LSF_COAT_ROUGHNESS_TEXTURE", specular_params && r->coat_roughness_textured,
         "some coat's roughness is a texture"},
        {"LSF_COAT_NORMAL_TEXTURE", specular_params && r->coat_normal_mapped,
         "some coat has a normal map"},
        {"LSF_TRANSMISSION", plan->transmission, "light passes materials that transmit"},
        {"LSF_STRAIGHT", plan->straight, "it goes straight on"},
        {"LSF_TRANSMISSION_TEXTURE", plan->transmission && r->transmission_textured,
         "some transmission is a texture"},
        {"LSF_EMISSION", emission, "some material emits or is unlit"},
        {"LSF_EMISSIVE_TEXTURE", emission && r->emissive_textured, "some emission is a texture"},
    };
    for (size_t i = 0; i < LSF_COUNT(switches); i++)
        lsf_plan_switch_add(plan, switches[i].name, switches[i].on, "%s", switches[i].why);
    lsf_scene_gpu_scatter_switch(plan);
    lsf_scene_gpu_word_switches(plan, specular_params);
}

void lsf_scene_gpu_mask_switches(lsf_plan *plan)
{
    const lsf_requirements *r = &plan->requirements;
    lsf_plan_switch_add(plan, "LSF_MASK", cuts_out(r), "some material is alpha-masked or blended");
    lsf_plan_switch_add(plan, "LSF_BLEND", r->blended, "some material is blended");
    lsf_plan_switch_add(plan, "LSF_TEXTURED", cuts_out(r) && r->base_color_textured,
                        "masks are textures");
    lsf_plan_switch_add(plan, "LSF_SECOND_UV", cuts_out(r) && r->second_uv,
                        "some texture reads TEXCOORD_1");
    lsf_plan_switch_add(plan, "LSF_VERTEX_COLOR", cuts_out(r) && r->vertex_colored,
                        "masked primitives have vertex colours");
}

void lsf_scene_gpu_environment_switches(lsf_plan *plan, const char *why)
{
    const lsf_requirements *r = &plan->requirements;
    lsf_plan_switch_add(plan, "LSF_ENVIRONMENT", r->environment, "%s", why);
    lsf_plan_switch_add(plan, "LSF_ENVIRONMENT_MAP", r->environment_map,
                        "the environment is a map");
}

void lsf_scene_gpu_plan_triangles(lsf_plan *plan)
{
    const lsf_requirements *r = &plan->requirements;
    uint64_t bytes = r->triangles * 9 * sizeof(float);
    if (lsf_plan_find(plan, "scene.triangles"))
        return;
    if (r->triangles == 0)
        lsf_plan_omit(plan, "scene.triangles", "the scene has no triangles");
    else if (bytes > LSF_STORAGE_BLOCK_BYTES)
        lsf_plan_omit(plan, "scene.triangles", "a block of %.0f MB is more than every shader reads",
                      (double)bytes * 1e-6);
    else
        lsf_plan_buffer_add(plan, "scene.triangles", bytes, "corners in normalised space");
}

struct lsf_texture_slot_data lsf_scene_gpu_slot(const lsf_texture_slot *slot)
{
    const float *t = slot->transform;
    return (struct lsf_texture_slot_data){
        {t[0], t[1], t[2], slot->texture != LSF_NONE ? 1.0f : 0.0f},
        {t[3], t[4], t[5], (float)slot->uv_set}};
}

struct lsf_material_data lsf_scene_gpu_material(const lsf_scene *scene, const lsf_material *m,
                                                uint32_t material)
{
    float absorption[3];
    lsf_scene_absorption(scene, m, absorption);
    return (material_data){
        .base_color = {m->base_color[0], m->base_color[1], m->base_color[2], m->base_color[3]},
        .emission = {m->emission[0], m->emission[1], m->emission[2],
                     m->alpha_mode == LSF_ALPHA_MASK    ? m->alpha_cutoff
                     : m->alpha_mode == LSF_ALPHA_BLEND ? LSF_ALPHA_BLENDED
                                                        : LSF_ALPHA_ALL},
        .surface = {m->metallic, m->roughness, m->normal_scale, lsf_f0_from_ior(m->ior)},
        .anisotropy = {m->anisotropy_strength, cosf(m->anisotropy_rotation),
                       sinf(m->anisotropy_rotation), m->transmission},
        .flags = {m->double_sided, m->unlit, m->volume && m->transmission > 0.0f, (float)material},
        .absorption = {absorption[0], absorption[1], absorption[2], m->open},
        .base_color_slot = lsf_scene_gpu_slot(&m->base_color_texture),
        .metallic_roughness_slot = lsf_scene_gpu_slot(&m->metallic_roughness_texture),
        .normal_slot = lsf_scene_gpu_slot(&m->normal_texture),
        .emissive_slot = lsf_scene_gpu_slot(&m->emissive_texture),
        .anisotropy_slot = lsf_scene_gpu_slot(&m->anisotropy_texture),
        .transmission_slot = lsf_scene_gpu_slot(&m->transmission_texture)};
}

static void add_attribute(GLuint array, GLuint location, GLuint buffer, GLint components)
{
    if (!buffer)
        return;
    glVertexArrayVertexBuffer(array, location, buffer, 0, components * (GLsizei)sizeof(float));
    glVertexArrayAttribFormat(array, location, components, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array, location, location);
    glEnableVertexArrayAttrib(array, location);
}

/* Three rows of four floats that advance once per instance. */
static void add_instance_rows(GLuint array, GLuint location, GLuint buffer, size_t stride,
                              size_t offset)
{
    glVertexArrayVertexBuffer(array, location, buffer, (GLintptr)offset, (GLsizei)stride);
    glVertexArrayBindingDivisor(array, location, 1);
    for (GLuint row = 0; row < 3; row++) {
        glVertexArrayAttribFormat(array, location + row, 4, GL_FLOAT, GL_FALSE,
                                  row * 4 * (GLuint)sizeof(float));
        glVertexArrayAttribBinding(array, location + row, location);
        glEnableVertexArrayAttrib(array, location + row);
    }
}

static GLuint create_array(const lsf_scene_gpu *gpu, const char *label, bool shading, bool masked)
{
    GLuint array;
    glCreateVertexArrays(1, &array);
    glObjectLabel(GL_VERTEX_ARRAY, array, -1, label);
    glVertexArrayElementBuffer(array, gpu->indices);
    add_attribute(array, LSF_ATTRIBUTE_POSITION, gpu->positions, 3);
    if (shading) {
        add_attribute(array, LSF_ATTRIBUTE_NORMAL, gpu->normals, 3);
        add_attribute(array, LSF_ATTRIBUTE_TANGENT, gpu->tangents, 4);
    }
    if (shading || masked) {
        add_attribute(array, LSF_ATTRIBUTE_UV0, gpu->uv0, 2);
        add_attribute(array, LSF_ATTRIBUTE_UV1, gpu->uv1, 2);
        add_attribute(array, LSF_ATTRIBUTE_COLOR, gpu->colors, 4);
    }
    add_instance_rows(array, LSF_ATTRIBUTE_TRANSFORM, gpu->instances, sizeof(instance_data),
                      offsetof(instance_data, transform_0));
    add_instance_rows(array, LSF_ATTRIBUTE_NORMAL_TRANSFORM, gpu->instances, sizeof(instance_data),
                      offsetof(instance_data, normal_0));
    if (shading && gpu->previous_transforms)
        add_instance_rows(array, LSF_ATTRIBUTE_PREVIOUS_TRANSFORM, gpu->previous_transforms,
                          12 * sizeof(float), 0);
    if (shading)
        add_attribute(array, LSF_ATTRIBUTE_PREVIOUS_POSITION, gpu->previous_positions, 3);
    return array;
}

/* Instances grouped by material, in a stable order (a counting sort). */
static bool order_draws(lsf_scene_gpu *gpu, const lsf_state *state, lsf_error *error)
{
    const lsf_scene *scene = gpu->scene;
    uint32_t *first = lsf_alloc((uint64_t)scene->material_count + 1, sizeof *first);
    gpu->draw_order = lsf_alloc(scene->instance_count, sizeof *gpu->draw_order);
    if (!first || !gpu->draw_order) {
        free(first);
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u draws",
                             scene->instance_count);
    }
    for (uint32_t i = 0; i < state->instance_count; i++)
        first[state->instances[i].material + 1]++;
    for (uint32_t m = 0; m < scene->material_count; m++)
        first[m + 1] += first[m];
    for (uint32_t i = 0; i < state->instance_count; i++)
        gpu->draw_order[first[state->instances[i].material]++] = i;
    gpu->draw_count = state->instance_count;
    free(first);
    return true;
}

static bool upload_streams(lsf_scene_gpu *gpu, const lsf_plan *plan, lsf_error *error)
{
    const lsf_vertices *v = &gpu->scene->vertices;
    const GLbitfield deformed = gpu->scene->deformer_count > 0 ? GL_DYNAMIC_STORAGE_BIT : 0;
    const struct {
        const char *name;
        const void *data;
        GLuint *buffer;
        GLbitfield flags;
    } streams[] = {
        {"scene.positions", v->position, &gpu->positions, deformed},
        {"scene.normals", v->normal, &gpu->normals, deformed},
        {"scene.tangents", v->tangent, &gpu->tangents, deformed},
        {"scene.uv0", v->uv0, &gpu->uv0, 0},
        {"scene.uv1", v->uv1, &gpu->uv1, 0},
        {"scene.colors", v->color, &gpu->colors, 0},
        {"scene.indices", gpu->scene->indices, &gpu->indices, 0},
    };
    for (size_t i = 0; i < LSF_COUNT(streams); i++)
        if (!lsf_plan_create_buffer_if_planned(plan, gpu->context, streams[i].name, streams[i].data,
                                               streams[i].flags, streams[i].buffer, error))
            return false;
    return true;
}

/* What two plans of the same scene may differ in, besides streams and textures. */
static bool create_followers(lsf_scene_gpu *gpu, const lsf_plan *plan, const lsf_state *state,
                             const lsf_state *previous, lsf_error *error)
{
    gpu->transmission = plan->transmission;
    gpu->straight = plan->straight;
    if (!gpu->positions)
        return true;
    if (!lsf_scene_dynamic_create(gpu, plan, error) ||
        !lsf_scene_gpu_create_lobes(gpu, plan, error))
        return false;
    gpu->shading_array = create_array(gpu, "scene.shading_array", true, false);
    gpu->position_array =
        create_array(gpu, "scene.position_array", false, cuts_out(&plan->requirements));
    lsf_scene_gpu_update(gpu, state, previous);
    return true;
}

static void destroy_followers(lsf_scene_gpu *gpu)
{
    lsf_scene_dynamic_destroy(gpu);
    lsf_buffer_destroy(gpu->context, &gpu->lobes);
    glDeleteTextures(1, &gpu->lobe_table);
    glDeleteVertexArrays(1, &gpu->shading_array);
    glDeleteVertexArrays(1, &gpu->position_array);
    gpu->lobe_table = gpu->shading_array = gpu->position_array = 0;
}

bool lsf_scene_gpu_create(lsf_scene_gpu *gpu, lsf_context *context, const lsf_plan *plan,
                          const lsf_scene *scene, const lsf_state *state, const lsf_state *previous,
                          lsf_error *error)
{
    memset(gpu, 0, sizeof *gpu);
    gpu->context = context;
    gpu->scene = scene;
    gpu->transmission = plan->transmission;
    if (!lsf_texture_upload_create(gpu, plan, error))
        return false;
    if (lsf_plan_find(plan, "scene.positions") &&
        (!upload_streams(gpu, plan, error) || !order_draws(gpu, state, error)))
        return false;
    if (gpu->positions && !lsf_clusters_init(&gpu->clusters, scene))
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the bounds of triangles");
    return create_followers(gpu, plan, state, previous, error);
}

/* Whether two plans list the same streams and textures of a scene. */
static bool same_streams(const lsf_plan *a, const lsf_plan *b)
{
    const lsf_plan *plans[2] = {a, b};
    for (int p = 0; p < 2; p++)
        for (uint64_t i = 0; i < plans[p]->resource_count; i++) {
            const lsf_plan_resource *mine = &plans[p]->resources[i];
            if (strncmp(mine->name, "scene.", 6) != 0 || lsf_scene_gpu_follows(mine->name))
                continue;
            const lsf_plan_resource *other = lsf_plan_find(plans[1 - p], mine->name);
            if (!other || other->bytes != mine->bytes)
                return false;
        }
    return true;
}

bool lsf_scene_gpu_replan(lsf_scene_gpu *gpu, const lsf_plan *old, const lsf_plan *plan,
                          const lsf_state *state, const lsf_state *previous, lsf_error *error)
{
    if (same_streams(old, plan)) {
        destroy_followers(gpu);
        return create_followers(gpu, plan, state, previous, error);
    }
    lsf_context *context = gpu->context;
    const lsf_scene *scene = gpu->scene;
    lsf_scene_gpu_destroy(gpu);
    return lsf_scene_gpu_create(gpu, context, plan, scene, state, previous, error);
}

void lsf_scene_gpu_destroy(lsf_scene_gpu *gpu)
{
    if (!gpu->context)
        return;
    destroy_followers(gpu);
    GLuint *buffers[] = {&gpu->positions, &gpu->normals, &gpu->tangents, &gpu->uv0,
                         &gpu->uv1,       &gpu->colors,  &gpu->indices};
    for (size_t i = 0; i < LSF_COUNT(buffers); i++)
        lsf_buffer_destroy(gpu->context, buffers[i]);
    lsf_texture_upload_destroy(gpu);
    free(gpu->draw_order);
    lsf_clusters_finish(&gpu->clusters);
    memset(gpu, 0, sizeof *gpu);
}

static bool shades(lsf_draw_mode mode)
{
    return mode == LSF_DRAW_SHADING || mode == LSF_DRAW_SEEN || mode == LSF_DRAW_POINTWISE ||
           mode == LSF_DRAW_TRANSMISSIVE || mode == LSF_DRAW_WALLS;
}

static void bind_material(const lsf_scene_gpu *gpu, const lsf_material *material,
                          lsf_draw_mode mode)
{
    bool point = mode == LSF_DRAW_POINTWISE;
    lsf_texture_read textures[LSF_MATERIAL_TEXTURES];
    uint32_t count = lsf_texture_upload_read_by(material, gpu->transmission, textures);
    for (uint32_t i = 0; i < count; i++) {
        const lsf_texture_read *t = &textures[i];
        bool cuts = t->unit == LSF_UNIT_BASE_COLOR && material->alpha_mode != LSF_ALPHA_OPAQUE;
        if (!shades(mode) && !cuts)
            continue;
        glBindTextureUnit(t->unit, gpu->textures[gpu->texture_of[t->slot->texture]]);
        glBindSampler(t->unit, lsf_texture_upload_sampler(gpu, t->slot->texture, t->filter, point));
    }
    if (shades(mode) && gpu->lobe_table)
        lsf_bind_texture(LSF_UNIT_LOBES, gpu->lobe_table);
}

static bool takes_part(const lsf_scene_gpu *gpu, const lsf_material *material, lsf_draw_mode mode)
{
    bool transmits = material->transmission > 0.0f;
    switch (mode) {
    case LSF_DRAW_OPAQUE:
        return !(gpu->straight && transmits);
    case LSF_DRAW_MASKED:
        return material->alpha_mode != LSF_ALPHA_OPAQUE && !(gpu->straight && transmits);
    case LSF_DRAW_BUT_WALLS:
        return !lsf_material_is_thin_wall(material);
    case LSF_DRAW_TRANSMISSIVE:
        return transmits;
    case LSF_DRAW_WALLS:
        return lsf_material_is_thin_wall(material);
    default:
        return true;
    }
}

void lsf_scene_gpu_draw(const lsf_scene_gpu *gpu, const lsf_state *state, lsf_draw_mode mode,
                        const lsf_draw_region *region, uint64_t *counts)
{
    uint32_t bound = LSF_NONE;
    glBindVertexArray(shades(mode) ? gpu->shading_array : gpu->position_array);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_MATERIALS, gpu->materials);
    for (uint32_t i = 0; i < gpu->draw_count; i++) {
        const lsf_instance_state *instance = &state->instances[gpu->draw_order[i]];
        if (!takes_part(gpu, &gpu->surfaces[instance->material], mode))
            continue;
        if (instance->skipped || (region && !lsf_clusters_inside(region, instance))) {
            counts[LSF_DRAW_CULLED]++;
            continue;
        }
        if (instance->material != bound)
            bind_material(gpu, &gpu->surfaces[bound = instance->material], mode);
        if (mode == LSF_DRAW_SEEN)
            lsf_cull_back(lsf_material_hides_back(gpu->scene, &gpu->surfaces[instance->material]),
                          instance->mirrored);
        const lsf_primitive *primitive = &gpu->scene->primitives[instance->primitive];
        counts[LSF_DRAW_INSTANCES]++;
        lsf_cluster_walk walk = lsf_clusters_walk(&gpu->clusters, gpu->scene, instance, region);
        while (lsf_clusters_next(&walk)) {
            counts[LSF_DRAW_TRIANGLES] += walk.count / 3;
            glDrawElementsInstancedBaseInstance(
                GL_TRIANGLES, (GLsizei)walk.count, GL_UNSIGNED_INT,
                (const void *)(uintptr_t)((primitive->first_index + walk.first) * 4), 1,
                gpu->draw_order[i]);
        }
    }
}

void lsf_scene_gpu_bind_environment(const lsf_scene_gpu *gpu)
{
    const lsf_environment *environment = &gpu->scene->environment;
    lsf_bind_texture(LSF_UNIT_ENVIRONMENT, gpu->environment);
    if (environment->present)
        glUniform4f(LSF_LOCATION_ENVIRONMENT, environment->radiance[0], environment->radiance[1],
                    environment->radiance[2], environment->u_offset);
}

void lsf_scene_gpu_bind_material(const lsf_scene_gpu *gpu, uint32_t material, lsf_draw_mode mode)
{
    bind_material(gpu, &gpu->surfaces[material], mode);
}

void lsf_scene_gpu_draw_listed(const lsf_scene_gpu *gpu, const lsf_state *state, GLuint buffer)
{
    const size_t command_bytes = 5 * sizeof(GLuint);
    uint32_t bound = LSF_NONE;
    glVertexArrayElementBuffer(gpu->shading_array, buffer);
    glBindVertexArray(gpu->shading_array);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_MATERIALS, gpu->materials);
    for (uint32_t i = 0; i < gpu->draw_count; i++) {
        const lsf_instance_state *instance = &state->instances[gpu->draw_order[i]];
        if (instance->skipped)
            continue;
        if (instance->material != bound)
            lsf_scene_gpu_bind_material(gpu, bound = instance->material, LSF_DRAW_POINTWISE);
        glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                               (const void *)(gpu->draw_order[i] * command_bytes));
    }
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    glVertexArrayElementBuffer(gpu->shading_array, gpu->indices);
}
