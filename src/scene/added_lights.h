/* Lights that the program that loads a scene adds to the scene's own. */
#ifndef LSF_SCENE_ADDED_LIGHTS_H
#define LSF_SCENE_ADDED_LIGHTS_H

#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Adds params->lights, with a node each, to a complete scene. LSF_ERROR_USAGE names a value that
 * is out of range. */
bool lsf_added_lights_place(lsf_scene *scene, const lsf_scene_params *params, lsf_error *error);

#ifdef __cplusplus
}
#endif
#endif
