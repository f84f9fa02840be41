/* The last steps of making a scene, whether it comes from a file or from a program. */
#ifndef LSF_SCENE_COMPLETE_H
#define LSF_SCENE_COMPLETE_H

#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Checks transforms and light, computes the requirements, and adds a camera, where there is none,
 * and light as asked for. LSF_ERROR_FILE. */
bool lsf_scene_complete(lsf_scene *scene, lsf_default_light default_light, lsf_error *error);

#ifdef __cplusplus
}
#endif
#endif
