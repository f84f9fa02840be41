#include "scene/light_range.h"

#include <math.h>

#include "math/vector.h"
#include "scene/animated.h"

/* `unit`: a normalised unit of this light in the scene's units. */
static bool bound(lsf_scene *scene, float light[3], double unit, const char *kind, const char *name,
                  lsf_error *error)
{
    double largest = (double)lsf_f3_max(lsf_f3_load(light)) / unit;
    if (largest > LSF_LIGHT_BRIGHTEST)
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: %s \"%s\" gives %.3g of light, and pixels would not be finite "
                             "above %.3g; scale all light of the scene down",
                             scene->path, kind, name, largest * unit, LSF_LIGHT_BRIGHTEST * unit);
    if (largest > 0.0 && largest < LSF_LIGHT_DIMMEST) {
        lsf_scene_add_note(scene, "%s \"%s\" gives %.3g of light, less than %.3g: it is left out",
                           kind, name, largest * unit, LSF_LIGHT_DIMMEST * unit);
        light[0] = light[1] = light[2] = 0.0f;
    }
    return true;
}

static bool bound_environment(lsf_scene *scene, lsf_error *error)
{
    lsf_environment *environment = &scene->environment;
    if (!environment->present)
        return true;
    if (environment->width == 0)
        return bound(scene, environment->radiance, 1.0, "environment", "uniform", error);
    for (uint64_t i = 0; i < 3 * (uint64_t)environment->width * environment->height; i++)
        if (!((double)environment->texels[i] <= LSF_LIGHT_BRIGHTEST))
            return lsf_error_set(
                error, LSF_ERROR_FILE,
                "the environment holds a radiance of %.3g, above %.3g beyond which "
                "pixels would not be finite; scale it down",
                (double)environment->texels[i], LSF_LIGHT_BRIGHTEST);
    return true;
}

/* Values that animations give to light are checked against the upper end alone: below the lower
 * one light is 0 whenever it is that dim. */
static bool bound_animated(lsf_scene *scene, const float light[3], double unit, const char *kind,
                           const char *name, lsf_error *error)
{
    float most[3] = {light[0], light[1], light[2]};
    return (double)lsf_f3_max(lsf_f3_load(most)) < LSF_LIGHT_DIMMEST * unit ||
           bound(scene, most, unit, kind, name, error);
}

static bool no_memory(const lsf_scene *scene, lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory", scene->path);
}

bool lsf_bound_radiance(lsf_scene *scene, lsf_error *error)
{
    lsf_animated_range range;
    if (!lsf_animated_find_range(&range, scene))
        return no_memory(scene, error);
    bool good = true;
    for (uint32_t i = 0; good && i < scene->material_count; i++) {
        lsf_material *material = &scene->materials[i];
        good = bound(scene, material->emission, 1.0, "material", material->name, error) &&
               bound_animated(scene, range.materials[1][i].emission, 1.0, "material",
                              material->name, error);
    }
    lsf_animated_range_finish(&range);
    return good && bound_environment(scene, error);
}

bool lsf_bound_lights(lsf_scene *scene, lsf_error *error)
{
    lsf_animated_range range;
    if (!lsf_animated_find_range(&range, scene))
        return no_memory(scene, error);
    bool good = true;
    for (uint32_t i = 0; good && i < scene->light_count; i++) {
        lsf_light *light = &scene->lights[i];
        double scale = light->type == LSF_LIGHT_DIRECTIONAL ? 1.0 : scene->requirements.scale;
        double unit = 1.0 / (scale * scale);
        good =
            bound(scene, light->intensity, unit, "light", light->name, error) &&
            bound_animated(scene, range.lights[1][i].intensity, unit, "light", light->name, error);
    }
    lsf_animated_range_finish(&range);
    return good;
}
