/* The node hierarchy at one instant. */
#ifndef LSF_SCENE_HIERARCHY_H
#define LSF_SCENE_HIERARCHY_H

#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Samples the animations at `time` (seconds; clamped to each channel's keys) and multiplies the
 * transforms down the hierarchy. `matrices` gets 16 doubles a node, column-major, node space to
 * scene space. A long chain of large scales can overflow: check for finite results. */
void lsf_scene_world_matrices(const lsf_scene *scene, double time, double *matrices);

/* The weights of morph targets at that time: scene->weight_count of them. */
void lsf_scene_weights(const lsf_scene *scene, double time, double *weights);

/* The first and the last key of all animations, and the number of moments between them that
 * bounds over the whole animation are taken from: 1 where nothing is animated. */
uint32_t lsf_scene_moments(const lsf_scene *scene, double *first, double *last);
double lsf_moment(uint32_t index, uint32_t moments, double first, double last);

/* A node's own transform as the file or a program gives it, column-major, without animations. */
void lsf_node_matrix(const lsf_node *node, double matrix[16]);

/* Values at `time`, clamped to the keys; not for rotations, whose components are not
 * interpolated one by one. */
void lsf_curve_sample(const lsf_curve *curve, double time, double *value);

/* a * b for affine column-major matrices. */
void lsf_multiply_affine(const double a[16], const double b[16], double result[16]);

/* point' = matrix * (point, 1) for an affine column-major matrix. */
void lsf_transform_point(const double matrix[16], const double point[3], double result[3]);

#ifdef __cplusplus
}
#endif
#endif
