#include "frame/maps.h"

#include "shared/scene_data.h"

GLenum lsf_gbuffer_specular_params(const lsf_plan *plan)
{
    const lsf_plan_resource *specular_params = lsf_plan_find(plan, "gbuffer.specular_params");
    return specular_params ? specular_params->texture.internal_format : GL_NONE;
}

void lsf_surface_maps_bind(const lsf_surface_maps *maps)
{
    lsf_bind_texture(0, maps->depth);
    lsf_bind_texture(1, maps->surface);
    lsf_bind_texture(2, maps->specular_params);
    lsf_bind_texture(LSF_UNIT_POSITION_PIXELS, maps->pixels);
}

void lsf_guide_maps_bind(const lsf_guide_maps *maps)
{
    lsf_bind_texture(0, maps->guide);
    lsf_bind_texture(1, maps->slope);
    lsf_bind_texture(15, maps->curvature);
}
