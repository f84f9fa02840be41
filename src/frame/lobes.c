/* Lobes that few materials have: their table, and where the G-buffer keeps them. */
#include "frame/lobes.h"

bool lsf_scene_gpu_has_lobes(const lsf_requirements *r)
{
    return r->specular_varied || r->coated || r->sheened;
}

int lsf_scene_gpu_coat_word(const lsf_plan *plan)
{
    const lsf_requirements *r = &plan->requirements;
    return !r->coated            ? 0
           : !r->anisotropic     ? 1
           : !plan->transmission ? 2
           : !r->specular_varied ? 3
                                 : 0;
}

int lsf_scene_gpu_sheen_word(const lsf_plan *plan)
{
    const lsf_requirements *r = &plan->requirements;
    int coat = lsf_scene_gpu_coat_word(plan);
    return !r->sheened                        ? 0
           : !r->anisotropic && coat != 1     ? 1
           : !plan->transmission && coat != 2 ? 2
           : !r->specular_varied && coat != 3 ? 3
                                              : 0;
}

void lsf_scene_gpu_word_switches(lsf_plan *plan, bool specular_params)
{
    lsf_plan_switch_add(
        plan, "LSF_COAT", specular_params ? lsf_scene_gpu_coat_word(plan) : 0,
        "some material is coated: the word of specular_params that holds it, 0: none");
    lsf_plan_switch_add(
        plan, "LSF_SHEEN", specular_params ? lsf_scene_gpu_sheen_word(plan) : 0,
        "some material has a sheen: the word of specular_params that holds it, 0: none");
}

void lsf_scene_gpu_fold_lobes(lsf_plan *plan)
{
    lsf_plan_switch_add(plan, "LSF_LOBES_FOLDED", lsf_scene_gpu_has_lobes(&plan->requirements),
                        "only the G-buffer keeps lobes apart");
}

void lsf_scene_gpu_lobe_switches(lsf_plan *plan, bool specular_params)
{
    lsf_plan_switch_add(plan, "LSF_SPECULAR_TINT",
                        specular_params && plan->requirements.specular_varied,
                        "some reflection is tinted or weighed");
    lsf_scene_gpu_word_switches(plan, specular_params);
}

void lsf_scene_gpu_media_switch(lsf_plan *plan)
{
    if (plan->straight && plan->requirements.refractive)
        lsf_plan_switch_add(plan, "LSF_ABSORPTION", true, "there are media");
}

void lsf_scene_gpu_seen_through_switch(lsf_plan *plan)
{
    if (plan->seen_through)
        lsf_plan_switch_add(plan, "LSF_SEEN_THROUGH", true,
                            "surfaces that transmit are seen through by chance");
}

void lsf_scene_gpu_scatter_switch(lsf_plan *plan)
{
    if (plan->scattered)
        lsf_plan_switch_add(plan, "LSF_SCATTER", true, "rough walls scatter what they transmit");
}

void lsf_scene_gpu_scatter_switches(lsf_plan *plan)
{
    if (!plan->scattered)
        return;
    lsf_plan_switch_add(plan, "LSF_TRANSMISSION", true, "light passes materials that transmit");
    lsf_plan_switch_add(plan, "LSF_STRAIGHT", true, "it goes straight on");
    lsf_scene_gpu_scatter_switch(plan);
}

static struct lsf_lobe_data lobe_data(const lsf_material *m)
{
    const float *tint = m->specular_color;
    return (struct lsf_lobe_data){
        .specular = {tint[0], tint[1], tint[2], m->specular},
        .coat = {m->coat, m->coat_roughness, m->coat_normal_scale, 0.0f},
        .sheen = {m->sheen_color[0], m->sheen_color[1], m->sheen_color[2], m->sheen_roughness},
        .sheen_color_slot = lsf_scene_gpu_slot(&m->sheen_color_texture),
        .sheen_roughness_slot = lsf_scene_gpu_slot(&m->sheen_roughness_texture),
        .coat_slot = lsf_scene_gpu_slot(&m->coat_texture),
        .coat_roughness_slot = lsf_scene_gpu_slot(&m->coat_roughness_texture),
        .coat_normal_slot = lsf_scene_gpu_slot(&m->coat_normal_texture),
        .specular_slot = lsf_scene_gpu_slot(&m->specular_texture),
        .specular_color_slot = lsf_scene_gpu_slot(&m->specular_color_texture)};
}

bool lsf_scene_gpu_create_lobes(lsf_scene_gpu *gpu, const lsf_plan *plan, lsf_error *error)
{
    if (!lsf_plan_create_buffer_if_planned(plan, gpu->context, "scene.lobes", NULL,
                                           GL_DYNAMIC_STORAGE_BIT, &gpu->lobes, error))
        return false;
    if (!gpu->lobes)
        return true;
    if (!lsf_buffer_textures_create(gpu->context, 1, &gpu->lobe_table, error))
        return false;
    glTextureBuffer(gpu->lobe_table, GL_RGBA32F, gpu->lobes);
    return true;
}

void lsf_scene_gpu_update_lobes(lsf_scene_gpu *gpu)
{
    for (uint32_t i = 0; gpu->lobes && i < gpu->scene->material_count; i++) {
        const struct lsf_lobe_data data = lobe_data(&gpu->surfaces[i]);
        glNamedBufferSubData(gpu->lobes, (GLintptr)(i * sizeof data), sizeof data, &data);
    }
}
