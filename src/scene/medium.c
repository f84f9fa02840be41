#include <float.h>
#include <math.h>

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
