#include "scene/checks.h"

#include <float.h>
#include <math.h>

#include "base/base.h"
#include "scene/light_range.h"

bool lsf_check_within(const char *what, uint32_t index, const char *name, float value, double least,
                      double most, lsf_error *error)
{
    return ((double)value >= least && (double)value <= most) ||
           lsf_error_set(error, LSF_ERROR_USAGE, "%s %u: %s is %g; it must lie between %g and %g",
                         what, index, name, (double)value, least, most);
}

bool lsf_check_bright(const char *what, uint32_t index, const char *name, const float light[3],
                      double unit, lsf_error *error)
{
    for (int i = 0; i < 3; i++)
        if (!lsf_check_within(what, index, name, light[i], 0.0, LSF_LIGHT_BRIGHTEST * unit, error))
            return false;
    return true;
}

void lsf_store_light(float out[3], const float light[3], double unit)
{
    float largest = fmaxf(light[0], fmaxf(light[1], light[2]));
    for (int i = 0; i < 3; i++)
        out[i] = (double)largest < LSF_LIGHT_DIMMEST * unit ? 0.0f : light[i];
}

bool lsf_check_light(uint32_t index, const lsf_light_desc *desc, double unit, lsf_error *error)
{
    if (desc->type > LSF_LIGHT_DIRECTIONAL)
        return lsf_error_set(error, LSF_ERROR_USAGE, "light %u: there is no type %d", index,
                             (int)desc->type);
    double of_type = desc->type == LSF_LIGHT_DIRECTIONAL ? 1.0 : fmin(unit, (double)FLT_MAX);
    if (!lsf_check_bright("light", index, "intensity", desc->intensity, of_type, error) ||
        !lsf_check_within("light", index, "range", desc->range, 0.0, INFINITY, error))
        return false;
    return desc->type != LSF_LIGHT_SPOT ||
           (lsf_check_within("light", index, "outer_cone", desc->outer_cone, 0.0, M_PI_2 + 1e-6,
                             error) &&
            lsf_check_within("light", index, "inner_cone", desc->inner_cone, 0.0, desc->outer_cone,
                             error));
}

void lsf_light_set(lsf_light *light, const lsf_light_desc *desc, double unit)
{
    light->type = desc->type;
    bool directional = desc->type == LSF_LIGHT_DIRECTIONAL;
    lsf_store_light(light->intensity, desc->intensity, directional && unit > 0.0 ? 1.0 : unit);
    light->range = desc->range;
    light->inner_cone = desc->inner_cone;
    light->outer_cone = desc->outer_cone;
}

bool lsf_check_matrix(uint32_t node, const double matrix[16], lsf_error *error)
{
    for (int i = 0; i < 16; i++)
        if (!isfinite(matrix[i]) || (i % 4 == 3 && matrix[i] != (i == 15 ? 1.0 : 0.0)))
            return lsf_error_set(error, LSF_ERROR_USAGE,
                                 "node %u: entry %d of the matrix is %g; it must be finite, and "
                                 "its last row 0, 0, 0, 1",
                                 node, i, matrix[i]);
    return true;
}

bool lsf_scene_given(const lsf_scene *scene, lsf_error *error)
{
    return lsf_given(scene, "scene", error) &&
           (!scene->draft || lsf_error_set(error, LSF_ERROR_USAGE,
                                           "the scene is still being built: lsf_scene_commit has "
                                           "to come first"));
}
