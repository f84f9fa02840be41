#include "scene/added_lights.h"

#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "scene/checks.h"

static bool grow(void **array, uint32_t count, uint32_t more, size_t size)
{
    void *larger = realloc(*array, ((size_t)count + more) * size);
    if (!larger)
        return false;
    *array = larger;
    memset((char *)larger + count * size, 0, more * size);
    return true;
}

static bool place(lsf_scene *scene, uint32_t number, const lsf_placed_light *placed,
                  lsf_error *error)
{
    double scale = scene->requirements.scale, unit = 1.0 / (scale * scale);
    uint32_t light = scene->light_count, node = scene->node_count;
    if (!lsf_check_light(light, &placed->light, unit, error) ||
        !lsf_check_matrix(node, placed->matrix, error))
        return false;
    lsf_light *l = &scene->lights[light];
    lsf_node *n = &scene->nodes[node];
    *n = (lsf_node){.name = lsf_format("added light %u", number + 1),
                    .parent = LSF_NONE,
                    .mesh = LSF_NONE,
                    .camera = LSF_NONE,
                    .light = light,
                    .has_matrix = true,
                    .rotation = {0.0, 0.0, 0.0, 1.0},
                    .scale = {1.0, 1.0, 1.0}};
    memcpy(n->matrix, placed->matrix, sizeof n->matrix);
    scene->node_count++;
    l->name = lsf_format("added light %u", number + 1);
    lsf_light_set(l, &placed->light, unit);
    scene->light_count++;
    return (n->name && l->name) ||
           lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for a light");
}

bool lsf_added_lights_place(lsf_scene *scene, const lsf_scene_params *params, lsf_error *error)
{
    if (params->light_count == 0)
        return true;
    if (!lsf_given(params->lights, "lsf_scene_params.lights", error))
        return false;
    bool good =
        grow((void **)&scene->lights, scene->light_count, params->light_count,
             sizeof *scene->lights) &&
        grow((void **)&scene->nodes, scene->node_count, params->light_count, sizeof *scene->nodes);
    if (!good)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u lights",
                             params->light_count);
    for (uint32_t i = 0; good && i < params->light_count; i++)
        good = place(scene, i, &params->lights[i], error);
    return good && (lsf_scene_update_requirements(scene) ||
                    lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u lights",
                                  params->light_count));
}
