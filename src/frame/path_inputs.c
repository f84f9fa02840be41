#include "frame/path_inputs.h"

#include "shared/scene_data.h"
#include "shared/voxel_data.h"

void lsf_path_inputs_bind(const lsf_path_inputs *inputs, const lsf_iteration *iteration)
{
    lsf_surface_maps_bind(inputs->seen);
    lsf_voxels_bind(inputs->voxels);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_MATERIALS, iteration->scene->materials);
    lsf_bind_texture(LSF_UNIT_FAR_SIDE, inputs->far_side);
    lsf_bind_texture(LSF_UNIT_FAR_COLOR, inputs->far_color);
    lsf_bind_texture(LSF_UNIT_VOXEL_RADIANCE, inputs->radiance);
    if (inputs->lamps)
        lsf_voxel_lamps_bind(iteration, inputs->grid, inputs->lamps, true);
    lsf_scene_gpu_bind_environment(iteration->scene);
    if (iteration->plan->requirements.environment)
        lsf_iteration_bind_sky(iteration);
}
