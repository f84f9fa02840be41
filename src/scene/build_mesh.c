#include <lightsheaf/build.h>

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "scene/draft.h"
#include "scene/material.h"

/* --- checks --- */

/* Names the part in messages. */
typedef struct location {
    uint32_t mesh, part;
    lsf_error *error;
} location;

static bool check_values(const location *at, const char *name, const float *values, uint32_t width,
                         uint32_t count, float least)
{
    for (uint64_t i = 0; values && i < (uint64_t)width * count; i++)
        if (!(values[i] >= least && values[i] <= FLT_MAX))
            return lsf_error_set(at->error, LSF_ERROR_USAGE,
                                 "mesh %u, part %u: %s of vertex %llu are %g in component %u; they "
                                 "must be finite%s",
                                 at->mesh, at->part, name, (unsigned long long)(i / width),
                                 (double)values[i], (unsigned)(i % width),
                                 least == 0.0f ? " and at least 0" : "");
    return true;
}

static bool check_indices(const location *at, const lsf_mesh_part *part)
{
    uint32_t corners = part->indices ? part->index_count : part->vertex_count;
    if (!part->indices && part->index_count > 0)
        return lsf_given(part->indices, "lsf_mesh_part.indices", at->error);
    if (part->vertex_count == 0 || corners % 3 != 0)
        return lsf_error_set(at->error, LSF_ERROR_USAGE,
                             "mesh %u, part %u: %u vertices and %u corners of triangles; there "
                             "must be vertices, and three corners to a triangle",
                             at->mesh, at->part, part->vertex_count, corners);
    for (uint32_t i = 0; part->indices && i < part->index_count; i++)
        if (part->indices[i] >= part->vertex_count)
            return lsf_error_set(at->error, LSF_ERROR_USAGE,
                                 "mesh %u, part %u: index %u is %u, and there are %u vertices",
                                 at->mesh, at->part, i, part->indices[i], part->vertex_count);
    return true;
}

static bool check_part(const lsf_scene *scene, const location *at, const lsf_mesh_part *part)
{
    uint32_t count = part->vertex_count;
    if (part->material >= scene->material_count && part->material != LSF_NONE)
        return lsf_error_set(
            at->error, LSF_ERROR_USAGE,
            "mesh %u, part %u: material %u does not exist; the scene has %u so far", at->mesh,
            at->part, part->material, scene->material_count);
    return lsf_given(part->positions, "lsf_mesh_part.positions", at->error) &&
           check_indices(at, part) &&
           check_values(at, "positions", part->positions, 3, count, -FLT_MAX) &&
           check_values(at, "normals", part->normals, 3, count, -FLT_MAX) &&
           check_values(at, "tangents", part->tangents, 4, count, -FLT_MAX) &&
           check_values(at, "texture coordinates 0", part->uvs[0], 2, count, -FLT_MAX) &&
           check_values(at, "texture coordinates 1", part->uvs[1], 2, count, -FLT_MAX) &&
           check_values(at, "colors", part->colors, 4, count, 0.0f);
}

/* --- vertices --- */

/* A part while its vertices are added to the scene's. */
typedef struct growth {
    lsf_scene *scene;
    lsf_geometry *geometry;
    lsf_frame_repairs *repairs;
    const lsf_mesh_part *part;
    const lsf_material *material;
    bool flat;
    uint64_t first, count; /* range of the scene's vertices */
    uint32_t corner_count;
    uint32_t *triangles; /* indices relative to `first` */
} growth;

/* The stream is present from now on; vertices that were added before get the default. */
static bool open_stream(growth *g, lsf_stream_kind kind, bool wanted)
{
    lsf_stream *stream = &g->geometry->streams[kind];
    if (stream->present || !wanted)
        return true;
    stream->present = true;
    return lsf_stream_append(stream, 0, g->first, NULL);
}

static bool open_streams(growth *g)
{
    return open_stream(g, LSF_STREAM_TANGENT, g->material->has_tangents) &&
           open_stream(g, LSF_STREAM_UV0, lsf_material_wants_uv(g->material, 0)) &&
           open_stream(g, LSF_STREAM_UV1, lsf_material_wants_uv(g->material, 1)) &&
           open_stream(g, LSF_STREAM_COLOR, g->part->colors != NULL);
}

static uint32_t corner(const lsf_mesh_part *part, uint64_t index)
{
    return part->indices ? part->indices[index] : (uint32_t)index;
}

/* Copies the part's vertices, or for a flat part one for each corner. */
static bool copy_vertices(growth *g)
{
    const lsf_mesh_part *part = g->part;
    const float *values[LSF_STREAM_COUNT] = {part->positions,
                                             g->flat ? NULL : part->normals,
                                             g->flat ? NULL : part->tangents,
                                             part->uvs[0],
                                             part->uvs[1],
                                             part->colors};
    for (int s = 0; s < LSF_STREAM_COUNT; s++) {
        lsf_stream *stream = &g->geometry->streams[s];
        if (!lsf_stream_append(stream, g->first, g->count, g->flat ? NULL : values[s]))
            return false;
        for (uint64_t i = 0; g->flat && stream->present && values[s] && i < g->count; i++)
            memcpy(*stream->array + (g->first + i) * stream->width,
                   values[s] + (size_t)corner(part, i) * stream->width,
                   stream->width * sizeof(float));
    }
    for (uint32_t i = 0; i < g->corner_count; i++)
        g->triangles[i] = g->flat ? i : corner(part, i);
    return true;
}

static void repair_normals(growth *g)
{
    const lsf_vertices *v = &g->scene->vertices;
    float *positions = v->position + 3 * g->first, *normals = v->normal + 3 * g->first;
    if (g->flat)
        lsf_flat_normals(positions, g->count / 3, normals);
    else if (lsf_unit_normals(normals, g->count, g->repairs) > 0)
        lsf_replace_zero_normals(positions, g->count, g->triangles, g->corner_count, normals);
}

/* Appends copies of vertices whose numbers are relative to the first. */
static bool repeat_vertices(growth *g, const uint32_t *from, uint64_t count)
{
    for (int s = 0; s < LSF_STREAM_COUNT; s++) {
        lsf_stream *stream = &g->geometry->streams[s];
        if (!stream->present || count == 0)
            continue;
        float *out = lsf_stream_grow(stream, g->first + g->count, count);
        if (!out)
            return false;
        const float *in = *stream->array + g->first * stream->width;
        for (uint64_t i = 0; i < count; i++)
            memcpy(out + i * stream->width, in + (size_t)from[i] * stream->width,
                   stream->width * sizeof(float));
    }
    g->count += count;
    return true;
}

static bool make_tangents(growth *g)
{
    const lsf_vertices *v = &g->scene->vertices;
    uint32_t set = lsf_material_tangent_uv_set(g->material);
    bool mapped = g->part->uvs[set] != NULL;
    if (mapped) {
        const float *uvs = (set == 0 ? v->uv0 : v->uv1) + 2 * g->first;
        uint32_t *copied;
        uint64_t copied_count;
        if (!lsf_split_mirrored(uvs, g->count, g->triangles, g->corner_count, &copied,
                                &copied_count))
            return false;
        bool enough = repeat_vertices(g, copied, copied_count);
        free(copied);
        if (!enough)
            return false;
    } else {
        g->repairs->tangents_without_uv++;
    }
    lsf_make_tangents(v->position + 3 * g->first, v->normal + 3 * g->first,
                      mapped ? (set == 0 ? v->uv0 : v->uv1) + 2 * g->first : NULL, g->count,
                      g->triangles, g->corner_count, v->tangent + 4 * g->first);
    return true;
}

/* Repairs tangents that are given, and makes those that are not. */
static bool complete_frames(growth *g)
{
    const lsf_vertices *v = &g->scene->vertices;
    float *normals = v->normal + 3 * g->first;
    float *given = v->tangent && !g->flat && g->part->tangents ? v->tangent + 4 * g->first : NULL;
    if (given)
        lsf_unit_tangents(normals, given, g->count, g->repairs);
    if (!lsf_turn_normals(v->position + 3 * g->first, g->count, g->triangles, g->corner_count,
                          normals, given, g->repairs))
        return false;
    return given || !g->material->has_tangents || make_tangents(g);
}

static bool append_primitive(growth *g)
{
    lsf_scene *scene = g->scene;
    lsf_primitive primitive = {.first_vertex = g->first,
                               .vertex_count = (uint32_t)g->count,
                               .material = g->part->material,
                               .deformer = LSF_NONE};
    void *primitives = scene->primitives;
    bool enough = g->first + g->count <= UINT32_MAX &&
                  lsf_grow(&primitives, &scene->draft->primitive_capacity,
                           (uint64_t)scene->primitive_count + 1, sizeof primitive);
    scene->primitives = primitives;
    if (!enough || !lsf_geometry_append_triangles(g->geometry, scene, g->triangles, g->corner_count,
                                                  &primitive))
        return false;
    scene->vertices.count = g->first + g->count;
    scene->primitives[scene->primitive_count++] = primitive;
    return true;
}

/* False without memory, or with more vertices than an index can name. */
static bool append_part(lsf_scene *scene, const lsf_mesh_part *part)
{
    const lsf_material otherwise = lsf_default_material(scene->diffuse_only);
    uint32_t corners = part->indices ? part->index_count : part->vertex_count;
    growth g = {.scene = scene,
                .geometry = &scene->draft->geometry,
                .repairs = &scene->draft->repairs,
                .part = part,
                .material =
                    part->material == LSF_NONE ? &otherwise : &scene->materials[part->material],
                .flat = !part->normals,
                .first = scene->vertices.count,
                .count = part->normals ? part->vertex_count : corners,
                .corner_count = corners,
                .triangles = lsf_alloc(corners, sizeof *g.triangles)};
    bool good = g.triangles && open_streams(&g) && copy_vertices(&g);
    if (good)
        repair_normals(&g);
    good = good && complete_frames(&g) && append_primitive(&g);
    free(g.triangles);
    return good;
}

uint32_t lsf_scene_add_mesh(lsf_scene *scene, const char *name, const lsf_mesh_part *parts,
                            uint32_t part_count, lsf_error *error)
{
    if (!lsf_draft_given(scene, error) || !lsf_given(parts, "parts", error))
        return LSF_NONE;
    for (uint32_t i = 0; i < part_count; i++) {
        const location at = {scene->mesh_count, i, error};
        if (!check_part(scene, &at, &parts[i]))
            return LSF_NONE;
    }
    lsf_mesh mesh = {.name = lsf_draft_name(name, error),
                     .first_primitive = scene->primitive_count,
                     .primitive_count = part_count};
    if (!mesh.name || !lsf_draft_grow(&scene->meshes, &scene->draft->mesh_capacity,
                                      scene->mesh_count, sizeof mesh, error)) {
        free(mesh.name);
        return LSF_NONE;
    }
    for (uint32_t i = 0; i < part_count; i++)
        if (!append_part(scene, &parts[i])) {
            free(mesh.name);
            lsf_error_set(error, LSF_ERROR_RENDER,
                          "mesh %u, part %u: out of memory, or more than 4294967295 vertices",
                          scene->mesh_count, i);
            return LSF_NONE;
        }
    scene->meshes[scene->mesh_count] = mesh;
    return scene->mesh_count++;
}
