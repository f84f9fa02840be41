#include "scene/geometry.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/base.h"

void lsf_geometry_begin(lsf_geometry *geometry, lsf_scene *scene)
{
    lsf_vertices *v = &scene->vertices;
    *geometry = (lsf_geometry){.streams = {
                                   [LSF_STREAM_POSITION] = {true, &v->position, 3, 0, {0, 0, 0, 0}},
                                   [LSF_STREAM_NORMAL] = {true, &v->normal, 3, 0, {0, 0, 1, 0}},
                                   [LSF_STREAM_TANGENT] = {false, &v->tangent, 4, 0, {1, 0, 0, 1}},
                                   [LSF_STREAM_UV0] = {false, &v->uv0, 2, 0, {0, 0, 0, 0}},
                                   [LSF_STREAM_UV1] = {false, &v->uv1, 2, 0, {0, 0, 0, 0}},
                                   [LSF_STREAM_COLOR] = {false, &v->color, 4, 0, {1, 1, 1, 1}},
                               }};
}

float *lsf_stream_grow(lsf_stream *stream, uint64_t first, uint64_t count)
{
    void *grown = *stream->array;
    if (!lsf_grow(&grown, &stream->capacity, (first + count) * stream->width, sizeof(float)))
        return NULL;
    *stream->array = grown;
    return *stream->array + first * stream->width;
}

bool lsf_stream_append(lsf_stream *stream, uint64_t first, uint64_t count, const float *values)
{
    if (!stream->present || count == 0)
        return true;
    float *out = lsf_stream_grow(stream, first, count);
    if (!out)
        return false;
    size_t bytes = stream->width * sizeof *out;
    if (values)
        memcpy(out, values, count * bytes);
    for (uint64_t i = 0; !values && i < count; i++)
        memcpy(out + i * stream->width, stream->otherwise, bytes);
    return true;
}

uint32_t *lsf_geometry_grow_indices(lsf_geometry *geometry, lsf_scene *scene, uint64_t count)
{
    void *grown = scene->indices;
    if (!lsf_grow(&grown, &geometry->index_capacity, scene->index_count + count, sizeof(uint32_t)))
        return NULL;
    scene->indices = grown;
    scene->index_count += count;
    return scene->indices + scene->index_count - count;
}

static void find_bounds(const lsf_scene *scene, lsf_primitive *primitive)
{
    for (int c = 0; c < 3; c++) {
        primitive->bounds_min[c] = FLT_MAX;
        primitive->bounds_max[c] = -FLT_MAX;
    }
    for (uint64_t i = 0; i < primitive->index_count; i++) {
        const float *p =
            scene->vertices.position + 3 * (size_t)scene->indices[primitive->first_index + i];
        for (int c = 0; c < 3; c++) {
            primitive->bounds_min[c] = fminf(primitive->bounds_min[c], p[c]);
            primitive->bounds_max[c] = fmaxf(primitive->bounds_max[c], p[c]);
        }
    }
}

bool lsf_geometry_append_triangles(lsf_geometry *geometry, lsf_scene *scene,
                                   const uint32_t *triangles, uint32_t index_count,
                                   lsf_primitive *primitive)
{
    primitive->first_index = scene->index_count;
    primitive->index_count = index_count;
    if (index_count > 0) {
        uint32_t *indices = lsf_geometry_grow_indices(geometry, scene, index_count);
        if (!indices)
            return false;
        for (uint32_t i = 0; i < index_count; i++)
            indices[i] = (uint32_t)(primitive->first_vertex + triangles[i]);
    }
    find_bounds(scene, primitive);
    return true;
}
