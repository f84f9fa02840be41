/* A scene that is being built. */
#ifndef LSF_SCENE_DRAFT_H
#define LSF_SCENE_DRAFT_H

#include "scene/geometry.h"

typedef struct lsf_draft {
    lsf_default_light default_light;
    bool failed; /* to be committed */
    lsf_geometry geometry;
    lsf_frame_repairs repairs;
    uint64_t primitive_capacity, mesh_capacity, node_capacity, material_capacity, image_capacity,
        texture_capacity, light_capacity, camera_capacity;
} lsf_draft;

/* An empty scene that is being built. NULL without memory. */
lsf_scene *lsf_draft_create(const char *name, lsf_default_light default_light);
/* Whether things may be added: the scene exists and has not been committed. */
bool lsf_draft_given(const lsf_scene *scene, lsf_error *error);
/* Makes space for one more element in an array of the scene, whose address it takes; false, with
 * an error, without memory. */
bool lsf_draft_grow(void *array, uint64_t *capacity, uint32_t count, size_t size, lsf_error *error);
/* A copy of `text` that can be printed; of NULL a copy of "". NULL, with an error, without
 * memory. */
char *lsf_draft_name(const char *name, lsf_error *error);

#endif
