/* The surface of a scene at one instant: its vertices as skins and morph targets have moved
 * them, in the object space of their instances, and the transforms from there to the scene.
 * Where nothing is deformed it is the scene's own. */
#ifndef LSF_SCENE_POSE_H
#define LSF_SCENE_POSE_H

#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lsf_pose {
    lsf_vertices vertices; /* positions, normals and tangents of their own, or the scene's */
    const lsf_primitive *primitives; /* with the bounds of these vertices; infinite for a
                                      * primitive that cannot be placed */
    float *values; /* what vertices follow: for each joint a 3x4 matrix by rows, from its mesh to
                    * its skin's frame; then all weights of morph targets */
    double (*frames)[16]; /* for each skin, column-major, from the frame that it deforms in to
                           * the scene */
    /* The arrays that it owns where something is deformed. */
    float *positions, *normals, *tangents;
    lsf_primitive *bounded;
    float *old_values; /* of the last update */
    double *weights;   /* scratch */
    bool posed;        /* there was one */
} lsf_pose;

/* Deforms the vertices whose values have changed. `worlds`: transforms of the nodes at that
 * time. `pose` must be zeroed before the first call, and is bound to one scene. False without
 * memory. */
bool lsf_pose_update(lsf_pose *pose, const lsf_scene *scene, double time, const double *worlds);
void lsf_pose_finish(lsf_pose *pose);

/* The transform of an instance to the scene, column-major. */
const double *lsf_pose_world(const lsf_pose *pose, const lsf_scene *scene, const double *worlds,
                             uint32_t instance);

/* The number of values; and whether two poses have the same values for a deformer. */
uint64_t lsf_pose_value_count(const lsf_scene *scene);
bool lsf_pose_is_same(const lsf_scene *scene, uint32_t deformer, const float *a, const float *b);

#ifdef __cplusplus
}
#endif
#endif
