/* Runs of a primitive's triangles with their bounds: where the primitive's bounds reach into a
 * region, the runs outside it are not drawn. */
#ifndef LSF_FRAME_CLUSTERS_H
#define LSF_FRAME_CLUSTERS_H

#include "scene/state.h"

/* A convex region: what lies wholly on the negative side of a plane is not drawn. planes[i]:
 * normal and offset, n.p + w >= 0 inside, normalised space. */
typedef struct lsf_draw_region {
    uint32_t plane_count;
    float planes[6][4];
} lsf_draw_region;

typedef struct lsf_clusters {
    uint64_t *first;    /* first run of each primitive, and one past the last */
    float (*bounds)[6]; /* object space: least and greatest corner */
} lsf_clusters;

/* False without memory. It must be finished in either case. */
bool lsf_clusters_init(lsf_clusters *clusters, const lsf_scene *scene);
/* Bounds the runs of a primitive anew after its vertices were deformed. */
void lsf_clusters_update(lsf_clusters *clusters, const lsf_scene *scene,
                         const lsf_vertices *vertices, uint32_t primitive);
void lsf_clusters_finish(lsf_clusters *clusters);

/* Whether an instance's bounds reach into the region. */
bool lsf_clusters_inside(const lsf_draw_region *region, const lsf_instance_state *instance);

/* A walk over the runs of an instance's indices that reach into a region. */
typedef struct lsf_cluster_walk {
    const float (*bounds)[6];
    uint32_t cluster, cluster_count, index_count;
    lsf_draw_region region; /* object space */
    uint32_t first, count;  /* the run: indices, from the primitive's first on */
} lsf_cluster_walk;

/* With `region` NULL all indices are in one run. */
lsf_cluster_walk lsf_clusters_walk(const lsf_clusters *clusters, const lsf_scene *scene,
                                   const lsf_instance_state *instance,
                                   const lsf_draw_region *region);
/* Sets the next run; false after the last. */
bool lsf_clusters_next(lsf_cluster_walk *walk);

#endif
