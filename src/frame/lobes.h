/* The functions of lobes.c that scene_gpu.c calls; the others are in scene_gpu.h. */
#ifndef LSF_FRAME_LOBES_H
#define LSF_FRAME_LOBES_H

#include "frame/scene_gpu.h"

/* Whether some material needs a struct lsf_lobe_data. */
bool lsf_scene_gpu_has_lobes(const lsf_requirements *r);
/* Adds LSF_COAT and LSF_SHEEN. */
void lsf_scene_gpu_word_switches(lsf_plan *plan, bool specular_params);
/* Creates the table, where the plan lists it, and fills it. */
bool lsf_scene_gpu_create_lobes(lsf_scene_gpu *gpu, const lsf_plan *plan, lsf_error *error);
void lsf_scene_gpu_update_lobes(lsf_scene_gpu *gpu);
/* The lobes of a material in the form that shaders read. */
struct lsf_texture_slot_data lsf_scene_gpu_slot(const lsf_texture_slot *slot);

#endif
