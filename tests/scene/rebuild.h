/* A scene built by the public functions that is like another one. */
#ifndef LSF_TESTS_SCENE_REBUILD_H
#define LSF_TESTS_SCENE_REBUILD_H

#include "scene/scene.h"

/* One of the project's own, by the name of its file. */
lsf_scene *load_default_scene(const char *name);

/* Rebuilds and commits; of what stands still. */
lsf_scene *rebuild(const lsf_scene *scene);

#endif
