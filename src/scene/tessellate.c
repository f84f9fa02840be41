/* Phong tessellation projects the point with barycentric coordinates u, v, w onto the tangent
 * planes of the three vertices a, b, c and interpolates the projections (Boubekeur and Alexa 2008,
 * eq. 3). Written out, this is a quadratic Bezier triangle,
 *
 *     p* = u a + v b + w c + 2 u v d_ab + 2 v w d_bc + 2 w u d_ca,
 *     d_ab = (((b - a) . n_b) n_b - ((b - a) . n_a) n_a) / 2,
 *
 * which `shape` blends with the flat one: only the d are scaled. Each d belongs to an edge. Where
 * the triangles at an edge have different normals there (a rim, a crease), each would bend the edge
 * its own way and leave a gap; the mean of their d closes it, as the adjacent edge normals of
 * McDonald and Kilgard (2008) do for PN triangles. Vertices at one place are one vertex here, over
 * all primitives of a mesh. Flat triangles have equal normals at both ends of an edge: d is exactly
 * 0. */
#include "scene/tessellate.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/vector.h"
#include "scene/key_map.h"

#define MAX_POINTS ((LSF_TESSELLATE_MAX_FACTOR + 1) * (LSF_TESSELLATE_MAX_FACTOR + 2) / 2)

#define UNPLACED UINT64_MAX /* a deformer's vertices, yet */

static const struct {
    size_t offset; /* in lsf_vertices */
    uint32_t width;
} streams[] = {
    {offsetof(lsf_vertices, position), 3}, {offsetof(lsf_vertices, normal), 3},
    {offsetof(lsf_vertices, tangent), 4},  {offsetof(lsf_vertices, uv0), 2},
    {offsetof(lsf_vertices, uv1), 2},      {offsetof(lsf_vertices, color), 4},
};

/* What an edge between two places is bent by: the mean over its triangles. */
typedef struct edge_bend {
    double sum[3];
    uint32_t count;
} edge_bend;

typedef struct tessellation {
    const lsf_scene *source;
    lsf_scene *target;
    uint32_t factor;
    double shape;
    uint64_t capacity[LSF_COUNT(streams)]; /* vertices */
    /* Of the mesh at work: places, and bends between two of them. */
    lsf_key_map positions, edges;
    edge_bend *bends;
    uint64_t bend_count, bend_capacity;
    /* Of the primitive at work: new vertices at old ones, and the first new one inside the edge
     * between two old ones. */
    lsf_key_map corners, sides;
} tessellation;

/* A new vertex: old ones with their weights. Those of an edge have two. */
typedef struct blend {
    uint32_t corner[3];
    double weight[3]; /* of the second and third: weight[0] follows */
} blend;

static float *stream_of(const lsf_vertices *vertices, size_t stream)
{
    return *(float *const *)((const char *)vertices + streams[stream].offset);
}

static const float *position_of(const tessellation *t, uint32_t vertex)
{
    return t->source->vertices.position + 3 * (size_t)vertex;
}

/* --- bends of edges */

static bool find_position(tessellation *t, uint32_t vertex, uint32_t *position)
{
    lsf_key key;
    for (int c = 0; c < 3; c++) {
        float x = position_of(t, vertex)[c] + 0.0f; /* -0 and 0 are one place */
        memcpy(&key.word[c], &x, sizeof x);
    }
    return lsf_key_map_find(&t->positions, key, (uint32_t)t->positions.count, position);
}

static bool find_bend(tessellation *t, uint32_t a, uint32_t b, edge_bend **bend)
{
    uint32_t from, to, index;
    void *bends = t->bends;
    if (!lsf_grow(&bends, &t->bend_capacity, t->bend_count + 1, sizeof *t->bends))
        return false;
    t->bends = bends;
    if (!find_position(t, a, &from) || !find_position(t, b, &to))
        return false;
    lsf_key key = {{from < to ? from : to, from < to ? to : from, 0}};
    if (!lsf_key_map_find(&t->edges, key, (uint32_t)t->bend_count, &index))
        return false;
    if (index == t->bend_count)
        t->bends[t->bend_count++] = (edge_bend){0};
    *bend = &t->bends[index];
    return true;
}

/* d_ab of the file's head. The same bits for d_ba. */
static void add_bend(const tessellation *t, edge_bend *bend, uint32_t a, uint32_t b)
{
    const float *p = position_of(t, a), *q = position_of(t, b);
    const float *n = t->source->vertices.normal + 3 * (size_t)a;
    const float *m = t->source->vertices.normal + 3 * (size_t)b;
    double height[2] = {0, 0};
    for (int c = 0; c < 3; c++) {
        height[0] += ((double)p[c] - (double)q[c]) * (double)n[c];
        height[1] += ((double)q[c] - (double)p[c]) * (double)m[c];
    }
    for (int c = 0; c < 3; c++)
        bend->sum[c] += 0.5 * (height[0] * (double)n[c] + height[1] * (double)m[c]);
    bend->count++;
}

static bool bend_edges(tessellation *t, const lsf_primitive *primitive)
{
    for (uint32_t i = 0; i < primitive->index_count; i++) {
        const uint32_t *index = t->source->indices + primitive->first_index + i;
        uint32_t a = index[0], b = i % 3 == 2 ? index[-2] : index[1];
        edge_bend *bend;
        if (!find_bend(t, a, b, &bend))
            return false;
        add_bend(t, bend, a, b);
    }
    return true;
}

/* --- new vertices */

static void add_bent(const tessellation *t, double point[3], const edge_bend *bend, double weights)
{
    for (int c = 0; c < 3; c++)
        point[c] += t->shape * 2.0 * weights * bend->sum[c] / bend->count;
}

/* Weighs differences from the first corner, so that what all corners share stays as it is. */
static double blend_value(const blend *at, const float *values, uint32_t width, uint32_t component)
{
    double first = (double)values[(size_t)at->corner[0] * width + component];
    double sum = first;
    for (int k = 1; k < 3; k++)
        sum += at->weight[k] * ((double)values[(size_t)at->corner[k] * width + component] - first);
    return sum;
}

/* A direction of unit length; that of the first corner where the interpolated one vanishes. */
static void store_direction(const blend *at, const float *values, uint32_t width, float *out)
{
    double v[3], square = 0.0;
    for (uint32_t c = 0; c < 3; c++) {
        v[c] = blend_value(at, values, width, c);
        square += v[c] * v[c];
    }
    const float *first = values + (size_t)at->corner[0] * width;
    for (uint32_t c = 0; c < 3; c++)
        out[c] = square > 0.0 ? (float)(v[c] / sqrt(square)) : first[c];
    if (width == 4) /* the bitangent's sign */
        out[3] = first[3];
}

static bool reserve(tessellation *t, uint64_t count)
{
    for (size_t s = 0; s < LSF_COUNT(streams); s++) {
        void *grown = stream_of(&t->target->vertices, s);
        if (!stream_of(&t->source->vertices, s))
            continue;
        if (!lsf_grow(&grown, &t->capacity[s], t->target->vertices.count + count,
                      streams[s].width * sizeof(float)))
            return false;
        *(float **)((char *)&t->target->vertices + streams[s].offset) = grown;
    }
    return true;
}

/* Appends a vertex with all its streams; there is room. */
static void add_vertex(tessellation *t, const blend *at, const double point[3])
{
    const lsf_vertices *from = &t->source->vertices;
    lsf_vertices *to = &t->target->vertices;
    size_t index = to->count++;
    for (uint32_t c = 0; c < 3; c++)
        to->position[3 * index + c] = (float)point[c];
    store_direction(at, from->normal, 3, to->normal + 3 * index);
    if (from->tangent)
        store_direction(at, from->tangent, 4, to->tangent + 4 * index);
    for (size_t s = 3; s < LSF_COUNT(streams); s++) {
        const float *values = stream_of(from, s);
        uint32_t width = streams[s].width;
        for (uint32_t c = 0; values && c < width; c++)
            stream_of(to, s)[width * index + c] = (float)blend_value(at, values, width, c);
    }
}

/* An old vertex, to the bit. */
static void copy_vertex(tessellation *t, uint32_t vertex)
{
    size_t index = t->target->vertices.count++;
    for (size_t s = 0; s < LSF_COUNT(streams); s++) {
        const float *values = stream_of(&t->source->vertices, s);
        uint32_t width = streams[s].width;
        if (values)
            memcpy(stream_of(&t->target->vertices, s) + width * index,
                   values + (size_t)width * vertex, width * sizeof(float));
    }
}

/* The point `step` of `factor` steps from a to b. Seen from whichever triangle it is the same point
 * to the bit: the arithmetic starts at the end that comes first in space. */
static void find_edge_point(const tessellation *t, uint32_t a, uint32_t b, uint32_t step,
                            const edge_bend *bend, double point[3])
{
    const float *p = position_of(t, a), *q = position_of(t, b);
    bool before = q[0] != p[0] ? q[0] < p[0] : q[1] != p[1] ? q[1] < p[1] : q[2] < p[2];
    if (before) {
        const float *end = p;
        p = q;
        q = end;
        step = t->factor - step;
    }
    double along = (double)step / t->factor;
    for (int c = 0; c < 3; c++)
        point[c] = (double)p[c] + along * ((double)q[c] - (double)p[c]);
    add_bent(t, point, bend, along * (1.0 - along));
}

/* The new vertices of an edge, once for all triangles with these two old vertices; `first` is the
 * one next to the vertex of the lower index. */
static bool add_side(tessellation *t, uint32_t a, uint32_t b, uint32_t *first)
{
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    uint32_t fresh = (uint32_t)t->target->vertices.count;
    edge_bend *bend;
    if (!find_bend(t, low, high, &bend) ||
        !lsf_key_map_find(&t->sides, (lsf_key){{low, high, 0}}, fresh, first))
        return false;
    for (uint32_t step = 1; *first == fresh && step < t->factor; step++) {
        double point[3];
        blend at = {{low, high, low}, {0.0, (double)step / t->factor, 0.0}};
        find_edge_point(t, low, high, step, bend, point);
        add_vertex(t, &at, point);
    }
    return true;
}

static void add_inner(tessellation *t, const uint32_t corner[3], uint32_t i, uint32_t j)
{
    double v = (double)i / t->factor, w = (double)j / t->factor, u = 1.0 - v - w;
    blend at = {{corner[0], corner[1], corner[2]}, {u, v, w}};
    edge_bend *bend[3] = {0};
    double point[3];
    for (uint32_t c = 0; c < 3; c++)
        point[c] = blend_value(&at, t->source->vertices.position, 3, c);
    /* The edges are known: nothing is added, so nothing can fail. */
    for (int e = 0; e < 3; e++)
        if (find_bend(t, corner[e], corner[(e + 1) % 3], &bend[e]))
            add_bent(t, point, bend[e], at.weight[e] * at.weight[(e + 1) % 3]);
    add_vertex(t, &at, point);
}

/* --- triangles */

/* Points of a triangle's grid: i steps along a to b, j along a to c, row j after row. */
static uint32_t grid_at(const tessellation *t, uint32_t i, uint32_t j)
{
    return j * (t->factor + 1) - j * (j - 1) / 2 + i;
}

/* Puts the edge's inner vertices into the grid, from (i, j) on in steps (di, dj). */
static bool fill_side(tessellation *t, uint32_t *grid, uint32_t a, uint32_t b, uint32_t i,
                      uint32_t j, int di, int dj)
{
    uint32_t first;
    if (!add_side(t, a, b, &first))
        return false;
    for (uint32_t step = 1; step < t->factor; step++) {
        i += (uint32_t)di;
        j += (uint32_t)dj;
        grid[grid_at(t, i, j)] = first + (a < b ? step : t->factor - step) - 1;
    }
    return true;
}

static bool fill_grid(tessellation *t, const uint32_t corner[3], uint32_t *grid)
{
    uint32_t n = t->factor;
    const uint32_t at[3] = {grid_at(t, 0, 0), grid_at(t, n, 0), grid_at(t, 0, n)};
    if (!reserve(t, MAX_POINTS))
        return false;
    for (int k = 0; k < 3; k++) {
        uint32_t fresh = (uint32_t)t->target->vertices.count;
        if (!lsf_key_map_find(&t->corners, (lsf_key){{corner[k], 0, 0}}, fresh, &grid[at[k]]))
            return false;
        if (grid[at[k]] == fresh)
            copy_vertex(t, corner[k]);
    }
    if (!fill_side(t, grid, corner[0], corner[1], 0, 0, 1, 0) ||
        !fill_side(t, grid, corner[1], corner[2], n, 0, -1, 1) ||
        !fill_side(t, grid, corner[2], corner[0], 0, n, 0, -1))
        return false;
    for (uint32_t j = 1; j < n; j++)
        for (uint32_t i = 1; i + j < n; i++) {
            grid[grid_at(t, i, j)] = (uint32_t)t->target->vertices.count;
            add_inner(t, corner, i, j);
        }
    return true;
}

static void add_triangle(lsf_scene *target, uint32_t a, uint32_t b, uint32_t c)
{
    target->indices[target->index_count++] = a;
    target->indices[target->index_count++] = b;
    target->indices[target->index_count++] = c;
}

static bool split_triangle(tessellation *t, const uint32_t corner[3])
{
    uint32_t grid[MAX_POINTS];
    if (!fill_grid(t, corner, grid))
        return false;
    for (uint32_t j = 0; j < t->factor; j++)
        for (uint32_t i = 0; i + j < t->factor; i++) {
            uint32_t right = grid[grid_at(t, i + 1, j)], up = grid[grid_at(t, i, j + 1)];
            add_triangle(t->target, grid[grid_at(t, i, j)], right, up);
            if (i + j + 1 < t->factor)
                add_triangle(t->target, right, grid[grid_at(t, i + 1, j + 1)], up);
        }
    return true;
}

static bool split_primitive(tessellation *t, const lsf_primitive *source, lsf_primitive *target)
{
    const lsf_vertices *vertices = &t->target->vertices;
    target->first_index = t->target->index_count;
    target->first_vertex = vertices->count;
    lsf_key_map_clear(&t->corners);
    lsf_key_map_clear(&t->sides);
    for (uint32_t i = 0; i < source->index_count; i += 3)
        if (!split_triangle(t, t->source->indices + source->first_index + i))
            return false;
    target->index_count = (uint32_t)(t->target->index_count - target->first_index);
    target->vertex_count = (uint32_t)(vertices->count - target->first_vertex);
    for (uint64_t v = target->first_vertex; v < vertices->count; v++)
        for (int c = 0; c < 3; c++) {
            float x = vertices->position[3 * v + (uint64_t)c];
            target->bounds_min[c] = fminf(target->bounds_min[c], x);
            target->bounds_max[c] = fmaxf(target->bounds_max[c], x);
        }
    return true;
}

/* What deforms stays as it is: its vertices are not where they will be seen. Primitives of a
 * deformer may share vertices. */
static bool keep_primitive(tessellation *t, const lsf_primitive *source, lsf_primitive *target)
{
    lsf_deformer *deformer = &t->target->deformers[source->deformer];
    if (deformer->first_vertex == UNPLACED) {
        deformer->first_vertex = t->target->vertices.count;
        if (!reserve(t, source->vertex_count))
            return false;
        for (uint32_t i = 0; i < source->vertex_count; i++)
            copy_vertex(t, (uint32_t)(source->first_vertex + i));
    }
    target->first_vertex = deformer->first_vertex;
    target->first_index = t->target->index_count;
    for (uint32_t i = 0; i < source->index_count; i++)
        t->target->indices[t->target->index_count++] =
            (uint32_t)(t->source->indices[source->first_index + i] - source->first_vertex +
                       target->first_vertex);
    return true;
}

/* Primitives whose edges are one another's: those of a mesh. */
static bool split_group(tessellation *t, uint32_t first, uint32_t count)
{
    lsf_key_map_clear(&t->positions);
    lsf_key_map_clear(&t->edges);
    t->bend_count = 0;
    for (uint32_t p = first; p < first + count; p++)
        if (t->source->primitives[p].deformer == LSF_NONE &&
            !bend_edges(t, &t->source->primitives[p]))
            return false;
    for (uint32_t p = first; p < first + count; p++) {
        const lsf_primitive *from = &t->source->primitives[p];
        lsf_primitive *to = &t->target->primitives[p];
        if (!(from->deformer == LSF_NONE ? split_primitive : keep_primitive)(t, from, to))
            return false;
    }
    return true;
}

/* Primitives of meshes come in the order of the meshes; a primitive of no mesh is alone. */
static bool split_all(tessellation *t)
{
    const lsf_scene *scene = t->source;
    uint32_t done = 0;
    for (uint32_t m = 0; m <= scene->mesh_count; m++) {
        bool last = m == scene->mesh_count;
        uint32_t first = last ? scene->primitive_count : scene->meshes[m].first_primitive;
        uint32_t count = last ? 0 : scene->meshes[m].primitive_count;
        for (; done < first && (last || count > 0); done++)
            if (!split_group(t, done, 1))
                return false;
        if (count > 0 && !split_group(t, first, count))
            return false;
        done += count;
    }
    return true;
}

/* --- the whole */

/* The largest index is that of an ordinary triangle list: 32 bits. */
static bool count_indices(const lsf_scene *scene, uint32_t factor, uint64_t *count,
                          lsf_error *error)
{
    uint64_t old = 0;
    for (uint32_t p = 0; p < scene->primitive_count; p++)
        old += scene->primitives[p].index_count;
    bool overflow = __builtin_mul_overflow(old, (uint64_t)factor * factor, count);
    if (!overflow && *count <= UINT32_MAX)
        return true;
    return lsf_error_set(error, LSF_ERROR_USAGE,
                         "tessellation.factor=%u: %llu triangles would become more than 32-bit "
                         "indices can name; choose a smaller factor",
                         factor, (unsigned long long)(old / 3));
}

static lsf_scene *create_copy(const lsf_scene *scene, uint64_t index_count)
{
    lsf_scene *copy = lsf_alloc(1, sizeof *copy);
    if (!copy)
        return NULL;
    *copy = *scene;
    copy->vertices = (lsf_vertices){0};
    copy->index_count = 0;
    copy->indices = lsf_alloc(index_count, sizeof *copy->indices);
    copy->primitives = lsf_alloc(scene->primitive_count, sizeof *copy->primitives);
    copy->deformers = lsf_alloc(scene->deformer_count, sizeof *copy->deformers);
    if (!copy->indices || !copy->primitives || !copy->deformers) {
        lsf_scene_tessellated_destroy(copy);
        return NULL;
    }
    memcpy(copy->primitives, scene->primitives, scene->primitive_count * sizeof *copy->primitives);
    for (uint32_t i = 0; i < scene->deformer_count; i++) {
        copy->deformers[i] = scene->deformers[i];
        copy->deformers[i].first_vertex = UNPLACED;
    }
    return copy;
}

lsf_scene *lsf_scene_tessellate(const lsf_scene *scene, uint32_t factor, float shape,
                                lsf_error *error)
{
    uint64_t index_count;
    if (!count_indices(scene, factor, &index_count, error))
        return NULL;
    tessellation t = {.source = scene, .factor = factor, .shape = (double)shape};
    t.target = create_copy(scene, index_count);
    bool done = t.target && split_all(&t) && lsf_scene_compute_requirements(t.target);
    lsf_key_map_finish(&t.positions);
    lsf_key_map_finish(&t.edges);
    lsf_key_map_finish(&t.corners);
    lsf_key_map_finish(&t.sides);
    free(t.bends);
    if (!done) {
        lsf_error_set(error, LSF_ERROR_RENDER,
                      "tessellation.factor=%u: no memory left for %llu triangles", factor,
                      (unsigned long long)(index_count / 3));
        lsf_scene_tessellated_destroy(t.target);
        return NULL;
    }
    return t.target;
}

void lsf_scene_tessellated_destroy(lsf_scene *tessellated)
{
    if (!tessellated)
        return;
    for (size_t s = 0; s < LSF_COUNT(streams); s++)
        free(stream_of(&tessellated->vertices, s));
    free(tessellated->indices);
    free(tessellated->primitives);
    free(tessellated->deformers);
    free(tessellated);
}
