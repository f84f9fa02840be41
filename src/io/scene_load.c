/* A glTF file and an environment become a scene that can be rendered; an environment alone one to
 * which a program adds the rest. */
#include <lightsheaf/build.h>

#include "base/base.h"
#include "io/io.h"
#include "scene/added_lights.h"
#include "scene/complete.h"
#include "scene/draft.h"
#include "scene/environment.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rotates the environment that was given, and scales its radiance. */
static bool adjust_environment(lsf_environment *environment, const lsf_scene_params *params,
                               lsf_error *error)
{
    float rotation = params->environment_rotation, strength = params->environment_strength;
    bool adjusted = rotation != 0.0f || strength != 1.0f;
    if (adjusted && !environment->present)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "environment: rotation or strength was given without an environment; "
                             "give one");
    if (!isfinite(rotation) || !isfinite(strength) || strength < 0.0f)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "environment: rotation %g must be finite, strength %g finite and at "
                             "least 0",
                             (double)rotation, (double)strength);
    lsf_environment_rotate(environment, rotation);
    for (int c = 0; c < 3; c++)
        environment->radiance[c] *= strength;
    uint64_t values = (uint64_t)3 * environment->width * environment->height;
    for (uint64_t i = 0; strength != 1.0f && i < values; i++)
        environment->texels[i] = fminf(environment->texels[i] * strength, FLT_MAX);
    return true;
}

static bool load_environment(lsf_scene *scene, const lsf_scene_params *params, uint64_t memory_left,
                             lsf_error *error)
{
    const float *radiance = params->environment_radiance;
    if (params->environment_path && radiance)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "environment: a map and a uniform radiance were given; give one");
    if (radiance) {
        for (int c = 0; c < 3; c++) {
            if (!isfinite(radiance[c]) || radiance[c] < 0.0f)
                return lsf_error_set(error, LSF_ERROR_USAGE,
                                     "environment: radiance %g must be finite and at least 0",
                                     (double)radiance[c]);
            scene->environment.radiance[c] = radiance[c];
        }
        scene->environment.present = true;
    }
    if (!params->environment_path)
        return adjust_environment(&scene->environment, params, error);
    uint64_t repaired = 0;
    if (!lsf_environment_load(&scene->environment, params->environment_path, memory_left, &repaired,
                              error))
        return false;
    scene->environment.present = true;
    const uint32_t size[] = {scene->environment.width, scene->environment.height};
    lsf_scene_add_content(scene, size, sizeof size);
    lsf_scene_add_content(scene, scene->environment.texels,
                          sizeof(float) * 3 * size[0] * (size_t)size[1]);
    if (repaired > 0)
        lsf_scene_add_note(scene, "%s: %llu negative or non-finite values were set to 0",
                           params->environment_path, (unsigned long long)repaired);
    return adjust_environment(&scene->environment, params, error);
}

static const lsf_scene_params defaults = {LSF_SCENE_PARAMS_DEFAULTS};

static lsf_scene *load(const lsf_gltf_source *source, const lsf_scene_params *params,
                       lsf_error *error)
{
    const char *path = source->path;
    lsf_scene *scene = lsf_alloc(1, sizeof(*scene));
    if (!scene) {
        lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory", path);
        return NULL;
    }
    uint64_t memory_left;
    if (!lsf_gltf_load(scene, source, params, &memory_left, error) ||
        !load_environment(scene, params, memory_left, error) ||
        !lsf_scene_complete(scene, params->default_light, error) ||
        !lsf_added_lights_place(scene, params, error)) {
        lsf_scene_destroy(scene);
        return NULL;
    }
    return scene;
}

lsf_scene *lsf_scene_load(const char *path, const lsf_scene_params *params, lsf_error *error)
{
    if (!lsf_given(path, "path", error))
        return NULL;
    const lsf_gltf_source source = {.path = path};
    return load(&source, params ? params : &defaults, error);
}

lsf_scene *lsf_scene_load_memory(const void *data, size_t size, const char *folder,
                                 const lsf_scene_params *params, lsf_error *error)
{
    if (size > 0 && !lsf_given(data, "data", error))
        return NULL;
    if (!params)
        params = &defaults;
    const lsf_gltf_source source = {.path = params->name ? params->name : "memory",
                                    .data = data ? data : "", /* of no bytes */
                                    .size = data ? size : 0,
                                    .folder = folder};
    return load(&source, params, error);
}

lsf_scene *lsf_scene_create(const lsf_scene_params *params, lsf_error *error)
{
    if (!params)
        params = &defaults;
    lsf_scene *scene = lsf_draft_create(params->name, params->default_light);
    if (!scene) {
        lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for a scene");
        return NULL;
    }
    scene->diffuse_only = params->diffuse_only;
    scene->show_back_faces = params->show_back_faces;
    if (!load_environment(scene, params, params->memory_limit, error)) {
        lsf_scene_destroy(scene);
        return NULL;
    }
    scene->content[0] = scene->content[1] = 0; /* the map is not all that it will be made of */
    return scene;
}
