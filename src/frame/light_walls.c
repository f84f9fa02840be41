#include "frame/light_walls.h"

#include "shared/scene_data.h"

/* Where paths refract, paths that meet the sky by chance have to bring all light of the sky that
 * passes. */
static bool sky_passes(const lsf_plan *plan)
{
    return plan->straight && plan->sky_lights > 0;
}

bool lsf_light_walls_needed(const lsf_plan *plan)
{
    return plan->transmission && (plan->requirements.thin_walls || sky_passes(plan));
}

lsf_light_passage lsf_light_passage_of(const lsf_iteration *iteration, uint32_t light_index)
{
    const lsf_plan *plan = iteration->plan;
    bool sky = light_index >= iteration->state->light_count;
    if (!lsf_light_walls_needed(plan) || (sky && !sky_passes(plan)))
        return (lsf_light_passage){.stops = LSF_DRAW_POSITIONS};
    if (sky)
        return (lsf_light_passage){true, LSF_DRAW_OPAQUE, LSF_DRAW_TRANSMISSIVE};
    return (lsf_light_passage){true, LSF_DRAW_BUT_WALLS, LSF_DRAW_WALLS};
}

GLenum lsf_light_tint_format(const lsf_plan *plan)
{
    return plan->straight && plan->requirements.refractive ? GL_RGBA32F : GL_RGB10_A2;
}

void lsf_light_walls_plan(lsf_plan *plan, const char *name, bool gradient)
{
    if (!lsf_light_walls_needed(plan)) {
        lsf_plan_omit(plan, name, "no thin wall transmits light");
        return;
    }
    lsf_plan_pass_add(plan, name, "thin walls let light of lamps through, tinted");
    lsf_plan_reads(plan, "scene");
    lsf_plan_switch_add(plan, "LSF_GRADIENT", gradient, "planes are compared");
    lsf_scene_gpu_material_switches(plan, true, false);
    lsf_scene_gpu_media_switch(plan);
}

bool lsf_light_walls_create(lsf_light_walls *walls, lsf_context *context, const lsf_plan *plan,
                            const char *name, bool depth, lsf_error *error)
{
    static const char *const depth_files[5] = {"passes/reflective_shadow_map.vert.glsl",
                                               "lib/light_walls_depth.frag.glsl"};
    static const char *const tint_files[5] = {"passes/reflective_shadow_map.vert.glsl",
                                              "lib/light_walls_tint.frag.glsl"};
    *walls = (lsf_light_walls){.context = context};
    if (!lsf_plan_find_pass(plan, name))
        return true;
    walls->tint_program = lsf_plan_program(plan, context, name, tint_files, error);
    if (depth)
        walls->depth_program = lsf_plan_program(plan, context, name, depth_files, error);
    return walls->tint_program && (!depth || walls->depth_program);
}

void lsf_light_walls_draw(const lsf_light_walls *walls, const lsf_iteration *iteration, GLint face,
                          uint32_t purpose, uint32_t light_index, const lsf_draw_region *region,
                          uint64_t *counts)
{
    lsf_light_passage passage = lsf_light_passage_of(iteration, light_index);
    if (!passage.any)
        return;
    glUseProgram(walls->depth_program);
    glUniform1i(0, face);
    lsf_iteration_set_chance(iteration, purpose, light_index);
    lsf_scene_gpu_draw(iteration->scene, iteration->state, passage.passes, region, counts);
}

void lsf_light_walls_tint(const lsf_light_walls *walls, const lsf_iteration *iteration,
                          GLuint framebuffer, uint32_t resolution, GLint face, uint32_t purpose,
                          uint32_t light_index, GLuint depth, const lsf_draw_region *region,
                          uint64_t *counts)
{
    static const GLfloat white[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    lsf_light_passage passage = lsf_light_passage_of(iteration, light_index);
    lsf_begin_fullscreen(framebuffer, resolution, resolution, walls->tint_program);
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, white);
    lsf_blend_multiply(0);
    glUniform1i(0, face);
    lsf_iteration_set_blend_chance(iteration, purpose, light_index);
    lsf_bind_texture(LSF_UNIT_SEEN_DEPTH, depth);
    if (passage.any)
        lsf_scene_gpu_draw(iteration->scene, iteration->state, passage.passes, region, counts);
}
