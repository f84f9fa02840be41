/* Loads a file of gltf_folder.h's folder that has to be good. To be included behind cmocka.h and
 * that header. */
#ifndef LSF_TESTS_LOAD_GLTF_H
#define LSF_TESTS_LOAD_GLTF_H

#include <lightsheaf/scene.h>

#include "gltf_folder.h"

static lsf_scene *load(const char *name)
{
    char *path = lsf_format("%s/%s", gltf_folder, name);
    lsf_error error = {0};
    lsf_scene *scene = lsf_scene_load(path, NULL, &error);
    if (!scene)
        print_error("%s\n", error.message);
    free(path);
    assert_non_null(scene);
    return scene;
}

#endif
