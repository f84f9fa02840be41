#include "frame/clusters.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"

/* Triangles of a cluster. A draw costs about as much as setting up some hundred triangles. */
#define CLUSTER_TRIANGLES 256u
#define CLUSTER_INDICES (3u * CLUSTER_TRIANGLES)

/* Clusters that are outside only by rounding errors are kept; the error is relative to the terms
 * of a plane's equation. */
#define ROUNDING 1e-5f

static uint64_t cluster_count(const lsf_primitive *primitive)
{
    return ((uint64_t)primitive->index_count + CLUSTER_INDICES - 1) / CLUSTER_INDICES;
}

static void bound(float bounds[6], const lsf_scene *scene, const lsf_vertices *vertices,
                  const lsf_primitive *primitive, uint64_t first)
{
    uint64_t end = first + CLUSTER_INDICES;
    if (end > primitive->index_count)
        end = primitive->index_count;
    for (int axis = 0; axis < 3; axis++) {
        bounds[axis] = INFINITY;
        bounds[3 + axis] = -INFINITY;
    }
    for (uint64_t i = first; i < end; i++) {
        const float *p =
            vertices->position + 3 * (size_t)scene->indices[primitive->first_index + i];
        for (int axis = 0; axis < 3; axis++) {
            bounds[axis] = fminf(bounds[axis], p[axis]);
            bounds[3 + axis] = fmaxf(bounds[3 + axis], p[axis]);
        }
    }
}

bool lsf_clusters_init(lsf_clusters *clusters, const lsf_scene *scene)
{
    uint64_t total = 0;
    *clusters = (lsf_clusters){
        .first = lsf_alloc((uint64_t)scene->primitive_count + 1, sizeof *clusters->first)};
    if (!clusters->first)
        return false;
    for (uint32_t i = 0; i < scene->primitive_count; i++) {
        clusters->first[i] = total;
        total += cluster_count(&scene->primitives[i]);
    }
    clusters->first[scene->primitive_count] = total;
    clusters->bounds = lsf_alloc(total, sizeof *clusters->bounds);
    if (!clusters->bounds)
        return false;
    for (uint32_t i = 0; i < scene->primitive_count; i++)
        lsf_clusters_update(clusters, scene, &scene->vertices, i);
    return true;
}

void lsf_clusters_update(lsf_clusters *clusters, const lsf_scene *scene,
                         const lsf_vertices *vertices, uint32_t primitive)
{
    uint64_t first = clusters->first[primitive];
    for (uint64_t c = first; c < clusters->first[primitive + 1]; c++)
        bound(clusters->bounds[c], scene, vertices, &scene->primitives[primitive],
              (c - first) * CLUSTER_INDICES);
}

void lsf_clusters_finish(lsf_clusters *clusters)
{
    free(clusters->first);
    free(clusters->bounds);
    memset(clusters, 0, sizeof *clusters);
}

/* `rounding` is relative to the magnitudes of the terms. */
static bool box_inside(const lsf_draw_region *region, const float low[3], const float high[3],
                       float rounding)
{
    for (uint32_t i = 0; i < region->plane_count; i++) {
        const float *plane = region->planes[i];
        float farthest = plane[3], magnitude = fabsf(plane[3]);
        for (int axis = 0; axis < 3; axis++) {
            float term = plane[axis] * (plane[axis] > 0.0f ? high : low)[axis];
            farthest += term;
            magnitude += fabsf(term);
        }
        if (farthest < -rounding * magnitude)
            return false;
    }
    return true;
}

bool lsf_clusters_inside(const lsf_draw_region *region, const lsf_instance_state *instance)
{
    return box_inside(region, instance->bounds_min, instance->bounds_max, 0.0f);
}

/* Planes for points in object space: n.(M p + t) + w = (M^T n).p + n.t + w. */
static void to_object_space(lsf_draw_region *region, const float transform[12])
{
    for (uint32_t i = 0; i < region->plane_count; i++) {
        float *plane = region->planes[i];
        const float n[3] = {plane[0], plane[1], plane[2]};
        for (int axis = 0; axis < 4; axis++) {
            float sum = axis == 3 ? plane[3] : 0.0f;
            for (int row = 0; row < 3; row++)
                sum += n[row] * transform[4 * row + axis];
            plane[axis] = sum;
        }
    }
}

lsf_cluster_walk lsf_clusters_walk(const lsf_clusters *clusters, const lsf_scene *scene,
                                   const lsf_instance_state *instance,
                                   const lsf_draw_region *region)
{
    uint64_t first = clusters->first[instance->primitive];
    lsf_cluster_walk walk = {
        .bounds = (const float(*)[6])clusters->bounds + first,
        .cluster_count = (uint32_t)(clusters->first[instance->primitive + 1] - first),
        .index_count = scene->primitives[instance->primitive].index_count,
    };
    /* A primitive's only cluster has the primitive's bounds, which were tested already. */
    if (region && walk.cluster_count > 1) {
        walk.region = *region;
        to_object_space(&walk.region, instance->transform);
    }
    return walk;
}

static bool cluster_inside(const lsf_cluster_walk *walk, uint32_t cluster)
{
    return box_inside(&walk->region, walk->bounds[cluster], walk->bounds[cluster] + 3, ROUNDING);
}

bool lsf_clusters_next(lsf_cluster_walk *walk)
{
    uint32_t cluster = walk->cluster, last = walk->cluster_count;
    while (cluster < last && !cluster_inside(walk, cluster))
        cluster++;
    if (cluster == last)
        return false;
    walk->first = cluster * CLUSTER_INDICES;
    while (cluster < last && cluster_inside(walk, cluster))
        cluster++;
    uint32_t end = cluster == last ? walk->index_count : cluster * CLUSTER_INDICES;
    walk->count = end - walk->first;
    walk->cluster = cluster;
    return true;
}
