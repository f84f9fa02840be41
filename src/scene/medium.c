#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/base.h"
#include "scene/scene.h"
#include "shared/brdf.h"

bool lsf_material_hides_back(const lsf_scene *scene, const lsf_material *material)
{
    return !material->double_sided && !(material->transmission > 0.0f) && !scene->show_back_faces;
}

bool lsf_material_is_thin_wall(const lsf_material *material)
{
    return material->transmission > 0.0f && !material->volume;
}

bool lsf_material_is_rough_wall(const lsf_material *material)
{
    return lsf_material_is_thin_wall(material) &&
           (material->roughness * material->roughness > LSF_ALPHA_MIN ||
            material->anisotropy_strength > 0.0f);
}

/* Areas of triangles: their sum as vectors along the normals, and as numbers. */
typedef struct areas {
    double sum[3], all;
} areas;

static void add_areas(const lsf_scene *scene, const lsf_primitive *primitive, areas *a)
{
    const uint32_t *corner = scene->indices + primitive->first_index;
    const float *position = scene->vertices.position;
    for (uint32_t i = 0; i < primitive->index_count; i += 3, corner += 3) {
        double e[2][3], area[3];
        for (int k = 0; k < 6; k++)
            e[k / 3][k % 3] = (double)position[3 * (size_t)corner[1 + k / 3] + (size_t)(k % 3)] -
                              (double)position[3 * (size_t)corner[0] + (size_t)(k % 3)];
        for (int c = 0; c < 3; c++) {
            area[c] = e[0][(c + 1) % 3] * e[1][(c + 2) % 3] - e[0][(c + 2) % 3] * e[1][(c + 1) % 3];
            a->sum[c] += area[c];
        }
        a->all += sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
    }
}

/* The areas of a closed surface add up to 0; small holes do not count. */
bool lsf_scene_find_open_media(lsf_scene *scene)
{
    areas *found = lsf_alloc(scene->material_count, sizeof *found);
    if (!found)
        return false;
    for (uint32_t i = 0; i < scene->primitive_count; i++) {
        const lsf_primitive *primitive = &scene->primitives[i];
        if (scene->materials[primitive->material].volume)
            add_areas(scene, primitive, &found[primitive->material]);
    }
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const double *sum = found[i].sum;
        double left = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
        scene->materials[i].open = left > 0.1 * found[i].all;
    }
    free(found);
    return true;
}

void lsf_scene_absorption(const lsf_scene *scene, const lsf_material *material, float absorption[3])
{
    double distance = (double)material->attenuation_distance * scene->requirements.scale;
    for (int c = 0; c < 3; c++) {
        /* Black is clamped to stay finite: a float cannot tell the light that passes then from
         * none. */
        double color = fmax((double)material->attenuation_color[c], (double)FLT_MIN);
        absorption[c] = (float)fmin(-log(color) / distance, (double)FLT_MAX);
    }
}
