/* lsf_scene_load: a glTF file and an environment become a scene that can be rendered. */
#include "base/base.h"
#include "io/io.h"
#include "scene/default_light.h"
#include "scene/hierarchy.h"
#include "scene/light_range.h"
#include "scene/scene.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Coordinates beyond this, in scene units, could overflow a double on their way to the picture. */
#define COORDINATE_MAX 1e100

/* A three-quarter view from the front (glTF assets face +z), a little from above, through a lens
 * that does not exaggerate: 45 mm for a picture 24 mm high. */
static bool add_default_camera(lsf_scene *scene)
{
    static const double back[3] = {0.48, 0.36, 0.8}; /* unit */
    double right[3] = {back[2] / hypot(back[0], back[2]), 0.0, -back[0] / hypot(back[0], back[2])};
    double up[3] = {back[1] * right[2], back[2] * right[0] - back[0] * right[2],
                    -back[1] * right[0]};
    lsf_camera *camera = lsf_alloc(1, sizeof(*camera));
    if (!camera)
        return false;
    free(scene->cameras);
    scene->cameras = camera;
    scene->camera_count = 1;
    camera->name = strdup("default");
    camera->node = LSF_NONE;
    camera->frames_scene = true;
    camera->fov_y = (float)(2.0 * atan(12.0 / 45.0));
    camera->x_magnification = camera->y_magnification = 1.0f;
    for (int c = 0; c < 3; c++) {
        camera->matrix[c] = right[c];
        camera->matrix[4 + c] = up[c];
        camera->matrix[8 + c] = back[c];
    }
    camera->matrix[15] = 1.0;
    return camera->name != NULL;
}

/* Turns the environment that was given, and scales its radiance. */
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
    double turn = (double)rotation / 360.0;
    environment->turn = (float)(turn - floor(turn));
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
    if (repaired > 0)
        lsf_scene_add_note(scene, "%s: %llu negative or non-finite values were set to 0",
                           params->environment_path, (unsigned long long)repaired);
    return adjust_environment(&scene->environment, params, error);
}

static bool check_transforms(const lsf_scene *scene, lsf_error *error)
{
    double *matrices = lsf_alloc(scene->node_count, 16 * sizeof(double));
    if (!matrices)
        return lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory for %u nodes",
                             scene->path, scene->node_count);
    lsf_scene_world_matrices(scene, 0.0, matrices);
    bool good = true;
    for (uint64_t i = 0; good && i < (uint64_t)16 * scene->node_count; i++)
        if (!(fabs(matrices[i]) <= COORDINATE_MAX))
            good = lsf_error_set(error, LSF_ERROR_FILE,
                                 "%s: the transforms above node \"%s\" multiply to more than %g; "
                                 "use smaller scales",
                                 scene->path, scene->nodes[i / 16].name, COORDINATE_MAX);
    free(matrices);
    return good;
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
        !check_transforms(scene, error) || !load_environment(scene, params, memory_left, error) ||
        !lsf_bound_radiance(scene, error)) {
        lsf_scene_destroy(scene);
        return NULL;
    }
    lsf_scene_settle_alpha(scene);
    if (!lsf_scene_compute_requirements(scene)) {
        lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory", path);
        lsf_scene_destroy(scene);
        return NULL;
    }
    if (!lsf_bound_lights(scene, error)) {
        lsf_scene_destroy(scene);
        return NULL;
    }
    if (scene->camera_count == 0 && !add_default_camera(scene)) {
        lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory", path);
        lsf_scene_destroy(scene);
        return NULL;
    }
    if (!lsf_default_light_add(scene, params->default_light, error)) {
        lsf_scene_destroy(scene);
        return NULL;
    }
    if (scene->note_lost) {
        lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory", path);
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
