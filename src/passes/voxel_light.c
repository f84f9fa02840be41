#include "passes/voxel_light.h"

#include <string.h>

#include "base/base.h"
#include "plan/light_map.h"
#include "shared/scene_data.h"

/* Storage buffer beside LSF_BINDING_MATERIALS. */
#define BINDING_BRICKS 1

static void plan_program(lsf_plan *plan, const char *name, const lsf_voxel_light_use *use,
                         const char *why)
{
    const lsf_requirements *r = &plan->requirements;
    lsf_plan_pass_add(plan, name, "%s", why);
    lsf_plan_switch_add(plan, "LSF_VOXEL_SIDES", (int)use->sides,
                        "sides that radiance is kept for");
    lsf_plan_switch_add(plan, "LSF_EMISSION", r->emissive || r->unlit,
                        "some material emits or is unlit");
    lsf_plan_switch_add(plan, "LSF_BINDING_BRICKS", BINDING_BRICKS, "always");
}

void lsf_voxel_light_plan(lsf_plan *plan, const lsf_voxel_grid *grid,
                          const lsf_voxel_light_use *use)
{
    plan_program(plan, "voxel_light", use, "what voxels emit, and reflect of punctual lights");
    lsf_plan_switch_add(plan, "LSF_SHADOW_PCF", use->pcf, "shadow.filter is pcf");
    lsf_light_switches(plan);
    lsf_voxel_texture_plan(plan, grid, "voxel_light.radiance", GL_RGBA16F, use->sides, use->levels,
                           "radiance of each side of a voxel's surface");
}

bool lsf_voxel_light_create(lsf_voxel_light *pass, lsf_context *context, const lsf_plan *plan,
                            const lsf_voxel_light_use *use, lsf_error *error)
{
    static const char *const begin[5] = {"passes/voxel_light_begin.comp.glsl"};
    static const char *const add[5] = {"passes/voxel_light_add.comp.glsl"};
    static const char *const clear[5] = {"lib/voxel_sides_clear.comp.glsl"};
    *pass = (lsf_voxel_light){.context = context, .use = *use};
    if (!lsf_plan_create_texture(plan, context, "voxel_light.radiance", &pass->radiance, error))
        return false;
    for (uint32_t level = 0; level < use->levels; level++)
        glClearTexImage(pass->radiance, (GLint)level, GL_RGBA, GL_FLOAT, NULL);
    pass->begin_program = lsf_plan_program(plan, context, "voxel_light", begin, error);
    pass->clear_program = lsf_plan_program(plan, context, "voxel_light", clear, error);
    pass->add_program = lsf_plan_program(plan, context, "voxel_light", add, error);
    pass->timer = lsf_timer_create(context, "voxel_light", error);
    return pass->begin_program && pass->clear_program && pass->add_program && pass->timer;
}

static void dispatch(const lsf_voxel_light *pass, GLuint program, GLuint list)
{
    glBindImageTexture(0, pass->radiance, 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA16F);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_BRICKS, list);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, list);
    glUseProgram(program);
    glDispatchComputeIndirect(0);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

static void bind_voxels(const lsf_voxel_light_inputs *inputs)
{
    glBindTextureUnit(LSF_UNIT_VOXEL_OCCUPANCY, inputs->occupancy);
    glBindTextureUnit(LSF_UNIT_VOXEL_ALBEDO, inputs->albedo);
    glBindTextureUnit(LSF_UNIT_VOXEL_NORMAL, inputs->normal);
    glBindTextureUnit(LSF_UNIT_VOXEL_GLOSS, inputs->point);
    glBindTextureUnit(LSF_UNIT_VOXEL_EMISSION, inputs->emission);
}

void lsf_voxel_light_begin(lsf_voxel_light *pass, const lsf_voxel_light_inputs *inputs)
{
    lsf_timer_begin(pass->timer);
    if (inputs->changed && pass->use.levels > 1)
        dispatch(pass, pass->clear_program, inputs->previous_bricks);
    bind_voxels(inputs);
    dispatch(pass, pass->begin_program, inputs->bricks);
    lsf_timer_end(pass->timer);
}

void lsf_voxel_light_add(lsf_voxel_light *pass, const lsf_voxel_light_inputs *inputs,
                         const lsf_voxel_light_map *map)
{
    lsf_timer_begin(pass->timer);
    bind_voxels(inputs);
    glBindTextureUnit(LSF_UNIT_SHADOW_DEPTH, map->depth);
    glBindTextureUnit(LSF_UNIT_SHADOW_GRADIENT, map->gradient);
    dispatch(pass, pass->add_program, inputs->bricks);
    lsf_timer_end(pass->timer);
}

void lsf_voxel_light_destroy(lsf_voxel_light *pass)
{
    if (!pass->context)
        return;
    lsf_texture_destroy(pass->context, &pass->radiance);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
