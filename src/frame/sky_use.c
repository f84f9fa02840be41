#include "frame/sky_use.h"

#include "frame/maps.h"
#include "frame/scene_gpu.h"

void lsf_sky_use_switches(lsf_plan *plan)
{
    const lsf_requirements *r = &plan->requirements;
    bool specular_params = lsf_gbuffer_specular_params(plan) != GL_NONE;
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_SPECULAR", r->specular, "materials have a specular lobe");
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PARAMS", specular_params, "roughness or metallic vary");
    lsf_plan_switch_add(plan, "LSF_ANISOTROPY", specular_params && r->anisotropic,
                        "some material is anisotropic");
    lsf_plan_switch_add(plan, "LSF_TRANSMISSION", plan->transmission,
                        "light passes materials that transmit");
    lsf_plan_switch_add(plan, "LSF_STRAIGHT", plan->straight, "it goes straight on");
    lsf_scene_gpu_scatter_switch(plan);
    lsf_scene_gpu_lobe_switches(plan, specular_params);
}
