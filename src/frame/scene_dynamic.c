#include "frame/scene_dynamic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "frame/lobes.h"
#include "frame/texture_upload.h"
#include "math/vector.h"

typedef struct lsf_instance_data instance_data;
typedef struct lsf_material_data material_data;

bool lsf_scene_gpu_follows(const char *resource)
{
    static const char *const names[] = {"scene.instances",
                                        "scene.previous_transforms",
                                        "scene.previous_positions",
                                        "scene.materials",
                                        "scene.lobes",
                                        "scene.triangles"};
    for (size_t i = 0; i < LSF_COUNT(names); i++)
        if (strcmp(names[i], resource) == 0)
            return true;
    return false;
}

bool lsf_scene_dynamic_create(lsf_scene_gpu *gpu, const lsf_plan *plan, lsf_error *error)
{
    const lsf_scene *scene = gpu->scene;
    const GLbitfield dynamic = GL_DYNAMIC_STORAGE_BIT;
    gpu->placed = lsf_alloc(scene->instance_count, sizeof *gpu->placed);
    if (lsf_plan_find(plan, "scene.previous_transforms"))
        gpu->placed_before = lsf_alloc(scene->instance_count, sizeof *gpu->placed_before);
    if (!gpu->placed || (!gpu->placed_before && lsf_plan_find(plan, "scene.previous_transforms")))
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u instances",
                             scene->instance_count);
    if (scene->deformer_count > 0) {
        uint64_t values = lsf_pose_value_count(scene);
        gpu->posed = lsf_alloc(values, sizeof *gpu->posed);
        gpu->posed_before = lsf_alloc(values, sizeof *gpu->posed_before);
        if (!gpu->posed || !gpu->posed_before)
            return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for joints and weights");
    }
    gpu->material_values = lsf_alloc(scene->animated_width, sizeof *gpu->material_values);
    gpu->drawn = lsf_alloc(scene->instance_count, sizeof *gpu->drawn);
    if (!gpu->material_values || !gpu->drawn)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for what is animated");
    gpu->anew = true;
    return lsf_plan_create_buffer_if_planned(plan, gpu->context, "scene.instances", NULL, dynamic,
                                             &gpu->instances, error) &&
           lsf_plan_create_buffer_if_planned(plan, gpu->context, "scene.previous_transforms", NULL,
                                             dynamic, &gpu->previous_transforms, error) &&
           lsf_plan_create_buffer_if_planned(plan, gpu->context, "scene.previous_positions",
                                             scene->vertices.position, dynamic,
                                             &gpu->previous_positions, error) &&
           lsf_plan_create_buffer_if_planned(plan, gpu->context, "scene.materials", NULL, dynamic,
                                             &gpu->materials, error) &&
           lsf_plan_create_buffer_if_planned(plan, gpu->context, "scene.triangles", NULL, dynamic,
                                             &gpu->triangles, error);
}

void lsf_scene_dynamic_destroy(lsf_scene_gpu *gpu)
{
    lsf_buffer_destroy(gpu->context, &gpu->instances);
    lsf_buffer_destroy(gpu->context, &gpu->previous_transforms);
    lsf_buffer_destroy(gpu->context, &gpu->previous_positions);
    lsf_buffer_destroy(gpu->context, &gpu->materials);
    lsf_buffer_destroy(gpu->context, &gpu->triangles);
    free(gpu->placed);
    free(gpu->placed_before);
    free(gpu->posed);
    free(gpu->posed_before);
    free(gpu->corners);
    free(gpu->material_values);
    free(gpu->drawn);
    gpu->material_values = NULL;
    gpu->drawn = NULL;
    gpu->posed = gpu->posed_before = NULL;
    gpu->placed = NULL;
    gpu->placed_before = NULL;
    gpu->corners = NULL;
}

static void update_materials(lsf_scene_gpu *gpu)
{
    for (uint32_t i = 0; i < gpu->scene->material_count; i++) {
        const material_data data = lsf_scene_gpu_material(gpu->scene, &gpu->surfaces[i], i);
        glNamedBufferSubData(gpu->materials, (GLintptr)(i * sizeof data), sizeof data, &data);
    }
    lsf_scene_gpu_update_lobes(gpu);
}

/* --- the table of triangles --- */

/* Whether the table holds the triangles of an instance. */
static bool is_listed(const lsf_scene_gpu *gpu, const lsf_instance_state *instance)
{
    const lsf_material *material = &gpu->surfaces[instance->material];
    return !instance->skipped && material->alpha_mode == LSF_ALPHA_OPAQUE &&
           !(gpu->straight && material->transmission > 0.0f);
}

/* Corners in normalised space. */
static void place_triangle(float corners[9], const lsf_scene *scene, const lsf_state *state,
                           const lsf_instance_state *instance, uint32_t triangle)
{
    const lsf_primitive *primitive = &scene->primitives[instance->primitive];
    const uint32_t *indices = scene->indices + primitive->first_index + 3 * (size_t)triangle;
    for (int corner = 0; corner < 3; corner++) {
        const float *v = state->pose.vertices.position + 3 * (size_t)indices[corner];
        const float *m = instance->transform;
        for (int row = 0; row < 3; row++, m += 4)
            corners[3 * corner + row] = m[0] * v[0] + m[1] * v[1] + m[2] * v[2] + m[3];
    }
}

/* Two classes for each power of two of a squared length, the longest first. */
static uint32_t length_class(float squared)
{
    uint32_t bits;
    memcpy(&bits, &squared, sizeof bits);
    return LSF_SCENE_GPU_LENGTHS - 1 - (bits >> 22);
}

/* The class of a triangle's longest edge. */
static uint32_t triangle_class(const float corners[9])
{
    float longest = 0.0f;
    for (int corner = 0; corner < 3; corner++) {
        lsf_float3 edge = lsf_f3_sub(lsf_f3_load(corners + 3 * corner),
                                     lsf_f3_load(corners + 3 * ((corner + 1) % 3)));
        longest = fmaxf(longest, lsf_f3_dot(edge, edge));
    }
    return length_class(longest);
}

uint32_t lsf_scene_gpu_triangles_from(const lsf_scene_gpu *gpu, float length)
{
    return gpu->triangles_to[length_class(length * length)];
}

/* Sorts by classes of length (a counting sort), within one in the order of instances. */
static void sort_triangles(lsf_scene_gpu *gpu, const lsf_state *state)
{
    memset(gpu->triangles_to, 0, sizeof gpu->triangles_to);
    gpu->triangle_count = 0;
    for (int placing = 0; placing < 2; placing++) {
        for (uint32_t i = 0; i < state->instance_count; i++) {
            const lsf_instance_state *instance = &state->instances[i];
            if (!is_listed(gpu, instance))
                continue;
            uint32_t count = gpu->scene->primitives[instance->primitive].index_count / 3;
            for (uint32_t k = 0; k < count; k++) {
                float corners[9];
                place_triangle(corners, gpu->scene, state, instance, k);
                uint32_t at = gpu->triangles_to[triangle_class(corners)]++;
                if (placing)
                    memcpy(gpu->corners[at], corners, sizeof corners);
            }
        }
        for (uint32_t c = 0; !placing && c < LSF_SCENE_GPU_LENGTHS; c++) {
            uint32_t count = gpu->triangles_to[c];
            gpu->triangles_to[c] = gpu->triangle_count;
            gpu->triangle_count += count;
        }
    }
}

/* A copy on the host is kept where each frame will need it. */
static void update_triangles(lsf_scene_gpu *gpu, const lsf_state *state)
{
    const lsf_requirements *r = &gpu->scene->requirements;
    lsf_error error;
    if (!gpu->corners)
        gpu->corners = lsf_alloc(r->triangles, sizeof *gpu->corners);
    if (!gpu->corners) {
        lsf_error_set(&error, LSF_ERROR_RENDER, "out of memory for %llu triangles",
                      (unsigned long long)r->triangles);
        lsf_context_fail(gpu->context, &error);
        return;
    }
    sort_triangles(gpu, state);
    glNamedBufferSubData(gpu->triangles, 0,
                         (GLsizeiptr)(gpu->triangle_count * sizeof *gpu->corners), gpu->corners);
    if (!r->moving) {
        free(gpu->corners);
        gpu->corners = NULL;
    }
}

/* --- instances --- */

static instance_data instance_data_of(const lsf_instance_state *instance, uint32_t index)
{
    const float *t = instance->transform, *n = instance->normal_transform;
    return (instance_data){{t[0], t[1], t[2], t[3]},
                           {t[4], t[5], t[6], t[7]},
                           {t[8], t[9], t[10], t[11]},
                           {n[0], n[1], n[2], (float)instance->material},
                           {n[3], n[4], n[5], instance->mirrored},
                           {n[6], n[7], n[8], (float)index}};
}

/* Whether some instance moved, appeared or disappeared. */
static bool update_instances(lsf_scene_gpu *gpu, const lsf_state *state)
{
    bool any = false;
    for (uint32_t i = 0; i < state->instance_count; i++) {
        const instance_data data = instance_data_of(&state->instances[i], i);
        bool drawn = !state->instances[i].skipped;
        any = any || gpu->drawn[i] != drawn;
        gpu->drawn[i] = drawn;
        if (!gpu->anew && memcmp(&data, &gpu->placed[i], sizeof data) == 0)
            continue;
        gpu->placed[i] = data;
        any = true;
        glNamedBufferSubData(gpu->instances, (GLintptr)(i * sizeof data), sizeof data, &data);
    }
    return any;
}

static void upload_vertices(GLuint buffer, const float *stream, GLsizeiptr width, uint64_t first,
                            uint64_t count)
{
    GLsizeiptr bytes = width * (GLsizeiptr)sizeof *stream;
    if (buffer)
        glNamedBufferSubData(buffer, (GLintptr)first * bytes, (GLsizeiptr)count * bytes,
                             stream + first * (uint64_t)width);
}

/* Whether some vertex moved in its instance. */
static bool update_vertices(lsf_scene_gpu *gpu, const lsf_pose *pose)
{
    const lsf_scene *scene = gpu->scene;
    bool any = false;
    for (uint32_t i = 0; i < scene->primitive_count; i++) {
        uint32_t deformer = scene->primitives[i].deformer;
        if (deformer != LSF_NONE &&
            (gpu->anew || !lsf_pose_is_same(scene, deformer, pose->values, gpu->posed)))
            lsf_clusters_update(&gpu->clusters, scene, &pose->vertices, i);
    }
    for (uint32_t i = 0; i < scene->deformer_count; i++) {
        const lsf_deformer *d = &scene->deformers[i];
        uint64_t count = scene->shapes[d->shape].vertex_count;
        if (!gpu->anew && lsf_pose_is_same(scene, i, pose->values, gpu->posed))
            continue;
        any = true;
        upload_vertices(gpu->positions, pose->vertices.position, 3, d->first_vertex, count);
        upload_vertices(gpu->normals, pose->vertices.normal, 3, d->first_vertex, count);
        upload_vertices(gpu->tangents, pose->vertices.tangent, 4, d->first_vertex, count);
    }
    if (any)
        memcpy(gpu->posed, pose->values, lsf_pose_value_count(scene) * sizeof *gpu->posed);
    return any;
}

static void update_previous_vertices(lsf_scene_gpu *gpu, const lsf_pose *pose)
{
    const lsf_scene *scene = gpu->scene;
    for (uint32_t i = 0; gpu->previous_positions && i < scene->deformer_count; i++) {
        const lsf_deformer *d = &scene->deformers[i];
        if (gpu->anew || !lsf_pose_is_same(scene, i, pose->values, gpu->posed_before))
            upload_vertices(gpu->previous_positions, pose->vertices.position, 3, d->first_vertex,
                            scene->shapes[d->shape].vertex_count);
    }
    if (gpu->previous_positions)
        memcpy(gpu->posed_before, pose->values,
               lsf_pose_value_count(scene) * sizeof *gpu->posed_before);
}

static void update_previous(lsf_scene_gpu *gpu, const lsf_state *previous, bool anew)
{
    update_previous_vertices(gpu, &previous->pose);
    for (uint32_t i = 0; gpu->placed_before && i < previous->instance_count; i++) {
        const float *transform = previous->instances[i].transform;
        float *before = gpu->placed_before[i];
        if (!anew && memcmp(before, transform, sizeof gpu->placed_before[i]) == 0)
            continue;
        memcpy(before, transform, sizeof gpu->placed_before[i]);
        glNamedBufferSubData(gpu->previous_transforms, (GLintptr)(i * sizeof gpu->placed_before[i]),
                             sizeof gpu->placed_before[i], before);
    }
}

/* Whether materials differ from those that were uploaded, by an edit or an animation. */
static bool materials_changed(lsf_scene_gpu *gpu, const lsf_animated *animated)
{
    const lsf_scene *scene = gpu->scene;
    uint64_t edits = scene->edits.materials;
    bool changed = gpu->anew || gpu->material_edits != edits ||
                   !lsf_animated_has(scene, LSF_KIND_MATERIAL, animated, gpu->material_values);
    gpu->material_edits = edits;
    if (changed && animated->values)
        memcpy(gpu->material_values, animated->values,
               scene->animated_width * sizeof *gpu->material_values);
    return changed;
}

void lsf_scene_gpu_update(lsf_scene_gpu *gpu, const lsf_state *state, const lsf_state *previous)
{
    gpu->surfaces = state->animated.materials;
    lsf_texture_upload_update(gpu);
    if (!gpu->positions)
        return;
    bool edited = materials_changed(gpu, &state->animated);
    if (edited)
        update_materials(gpu);
    bool moved = update_instances(gpu, state);
    moved |= update_vertices(gpu, &state->pose);
    if (gpu->triangles && (moved || edited))
        update_triangles(gpu, state);
    if (previous)
        update_previous(gpu, previous, gpu->anew);
    gpu->anew = false;
}
