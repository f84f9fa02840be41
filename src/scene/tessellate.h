/* Phong tessellation (Boubekeur and Alexa 2008, "Phong Tessellation") of a scene's triangles, once,
 * before anything is planned: whatever draws the scene then sees one and the same surface. */
#ifndef LSF_SCENE_TESSELLATE_H
#define LSF_SCENE_TESSELLATE_H

#include "scene/scene.h"

#define LSF_TESSELLATE_MAX_FACTOR 16

/* A copy of `scene` with each triangle split into factor^2 and bent towards its vertices' tangent
 * planes; `shape` 0: flat, 1: all the way. The triangles that share an edge share its points to the
 * bit, also where their normals differ. The copy owns its vertices, indices and primitives and
 * borrows the rest: `scene` must outlive it. LSF_ERROR_USAGE when the indices would overflow. */
lsf_scene *lsf_scene_tessellate(const lsf_scene *scene, uint32_t factor, float shape,
                                lsf_error *error);
void lsf_scene_tessellated_destroy(lsf_scene *tessellated); /* NULL allowed */

#endif
