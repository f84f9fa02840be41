/* Edits of the environment: how it is turned and how strong it is. */
#include <lightsheaf/edit.h>

#include <math.h>
#include <string.h>

#include "base/base.h"
#include "scene/checks.h"
#include "scene/environment.h"
#include "scene/light_range.h"

static bool has_environment(const lsf_scene *scene, lsf_error *error)
{
    return lsf_scene_given(scene, error) &&
           (scene->environment.present ||
            lsf_error_set(error, LSF_ERROR_USAGE,
                          "environment: the scene has none to rotate or scale"));
}

bool lsf_scene_get_environment(const lsf_scene *scene, float *rotation, float *strength,
                               lsf_error *error)
{
    if (!has_environment(scene, error) || !lsf_given(rotation, "rotation", error) ||
        !lsf_given(strength, "strength", error))
        return false;
    *rotation = scene->environment.rotation;
    *strength = scene->environment.given ? scene->environment.strength : 1.0f;
    return true;
}

bool lsf_scene_set_environment_rotation(lsf_scene *scene, float degrees, lsf_error *error)
{
    if (!has_environment(scene, error))
        return false;
    if (!isfinite(degrees))
        return lsf_error_set(error, LSF_ERROR_USAGE, "environment: rotation %g must be finite",
                             (double)degrees);
    lsf_environment_rotate(&scene->environment, degrees);
    scene->edits.environment++;
    return true;
}

static uint64_t value_count(const lsf_environment *environment)
{
    return environment->width > 0 ? (uint64_t)3 * environment->width * environment->height : 3;
}

static float *values_of(lsf_environment *environment)
{
    return environment->width > 0 ? environment->texels : environment->radiance;
}

/* Keeps the environment's radiance from before its first edit. */
static bool keep_given(lsf_environment *environment, lsf_error *error)
{
    uint64_t count = value_count(environment);
    if (environment->given)
        return true;
    environment->given = lsf_alloc(count, sizeof *environment->given);
    if (!environment->given)
        return lsf_error_set(error, LSF_ERROR_RENDER, "environment: out of memory");
    memcpy(environment->given, values_of(environment), count * sizeof *environment->given);
    return true;
}

bool lsf_scene_set_environment_strength(lsf_scene *scene, float strength, lsf_error *error)
{
    if (!has_environment(scene, error))
        return false;
    if (!(strength >= 0.0f && isfinite(strength)))
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "environment: strength %g must be finite and at least 0",
                             (double)strength);
    lsf_environment *environment = &scene->environment;
    if (!keep_given(environment, error))
        return false;
    uint64_t count = value_count(environment);
    float most = 0.0f, *values = values_of(environment);
    for (uint64_t i = 0; i < count; i++)
        most = fmaxf(most, environment->given[i]);
    double brightest = (double)most * (double)strength;
    if (brightest > LSF_LIGHT_BRIGHTEST)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "environment: with strength %g it has a radiance of %.3g, above %.3g "
                             "beyond which pixels would not be finite",
                             (double)strength, brightest, LSF_LIGHT_BRIGHTEST);
    bool none = environment->width == 0 && brightest < LSF_LIGHT_DIMMEST;
    for (uint64_t i = 0; i < count; i++)
        values[i] = none ? 0.0f : environment->given[i] * strength;
    environment->strength = strength;
    scene->edits.environment++;
    scene->edits.radiance++;
    return lsf_scene_update_requirements(scene) ||
           lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for an edit of the environment");
}
