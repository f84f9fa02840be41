/* Materials, lights, cameras and the visibility of nodes at one instant, as animations have
 * changed them. Where nothing is animated, they are the scene's. */
#ifndef LSF_SCENE_ANIMATED_H
#define LSF_SCENE_ANIMATED_H

#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lsf_animated {
    const lsf_material *materials; /* as many as the scene has */
    const lsf_light *lights;
    const bool *hidden; /* for each node, whether it or an ancestor is hidden; NULL: none is */
    double *values;     /* values of all animated properties */
    /* The arrays that it owns where something is animated. */
    lsf_material *own_materials;
    lsf_light *own_lights;
    bool *own_hidden;
} lsf_animated;

/* `animated` must be zeroed before the first call, and goes with one scene. False without memory.
 */
bool lsf_animated_update(lsf_animated *animated, const lsf_scene *scene, double time);
void lsf_animated_finish(lsf_animated *animated);
/* Whether all things of a kind have those animated values, of which there are as many as in
 * lsf_animated. */
bool lsf_animated_has(const lsf_scene *scene, lsf_kind kind, const lsf_animated *animated,
                      const double *values);
/* Sets the animated properties of the camera of that number in the scene. */
void lsf_animated_set_camera(const lsf_scene *scene, uint32_t index, double time,
                             lsf_camera *camera);

/* The least and the greatest values that animations give to each property of materials and
 * lights. Where nothing is animated both are the scene's. */
typedef struct lsf_animated_range {
    lsf_material *materials[2];
    lsf_light *lights[2];
    bool owned;
} lsf_animated_range;

bool lsf_animated_find_range(lsf_animated_range *range, const lsf_scene *scene);
void lsf_animated_range_finish(lsf_animated_range *range);

#ifdef __cplusplus
}
#endif
#endif
