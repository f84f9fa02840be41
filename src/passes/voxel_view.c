#include "passes/voxel_view.h"

#include <string.h>

#include "shared/scene_data.h"

#define LAYERS (LSF_AOV_VOXEL_ALBEDO | LSF_AOV_VOXEL_NORMAL | LSF_AOV_VOXEL_RADIANCE)

bool lsf_voxel_view_needed(const lsf_plan *plan)
{
    return (plan->aovs & LAYERS) != 0;
}

static void plan_layer(lsf_plan *plan, uint32_t aov, const char *name)
{
    if (plan->aovs & aov)
        lsf_plan_texture_add(plan, name, GL_RGBA32F, plan->width, plan->height, "asked for");
}

void lsf_voxel_view_plan(lsf_plan *plan, uint32_t sides)
{
    lsf_plan_pass_add(plan, "voxel_view", "voxels as the camera sees them");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_VOXEL_SIDES", (int)sides, "sides that radiance is kept for");
    plan_layer(plan, LSF_AOV_VOXEL_ALBEDO, "voxel_view.albedo");
    plan_layer(plan, LSF_AOV_VOXEL_NORMAL, "voxel_view.normal");
    plan_layer(plan, LSF_AOV_VOXEL_RADIANCE, "voxel_view.radiance");
}

bool lsf_voxel_view_create(lsf_voxel_view *pass, lsf_context *context, const lsf_plan *plan,
                           lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl", "passes/voxel_view.frag.glsl"};
    static const GLenum targets[3] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                      GL_COLOR_ATTACHMENT2};
    *pass = (lsf_voxel_view){.context = context};
    lsf_voxel_view_outputs *o = &pass->outputs;
    if (!lsf_plan_create_texture_if_planned(plan, context, "voxel_view.albedo", &o->albedo,
                                            error) ||
        !lsf_plan_create_texture_if_planned(plan, context, "voxel_view.normal", &o->normal,
                                            error) ||
        !lsf_plan_create_texture_if_planned(plan, context, "voxel_view.radiance", &o->radiance,
                                            error))
        return false;
    const GLuint textures[3] = {o->albedo, o->normal, o->radiance};
    lsf_framebuffer_desc desc = {.label = "voxel_view", .layer = -1};
    GLenum draws[3] = {GL_NONE, GL_NONE, GL_NONE};
    for (int i = 0; i < 3; i++)
        if (textures[i]) {
            draws[i] = targets[desc.color_count];
            desc.colors[desc.color_count++] = textures[i];
        }
    pass->framebuffer = lsf_framebuffer_create(context, &desc, error);
    if (pass->framebuffer)
        glNamedFramebufferDrawBuffers(pass->framebuffer, 3, draws);
    pass->program = lsf_plan_program(plan, context, "voxel_view", files, error);
    pass->timer = lsf_timer_create(context, "voxel_view", error);
    return pass->framebuffer && pass->program && pass->timer;
}

void lsf_voxel_view_run(lsf_voxel_view *pass, const lsf_iteration *iteration,
                        const lsf_voxels *voxels, GLuint radiance)
{
    lsf_timer_begin(pass->timer);
    lsf_begin_fullscreen(pass->framebuffer, iteration->plan->width, iteration->plan->height,
                         pass->program);
    lsf_voxels_bind(voxels);
    lsf_bind_texture(LSF_UNIT_VOXEL_RADIANCE, radiance);
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->timer);
}

void lsf_voxel_view_destroy(lsf_voxel_view *pass)
{
    if (!pass->context)
        return;
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    lsf_texture_destroy(pass->context, &pass->outputs.albedo);
    lsf_texture_destroy(pass->context, &pass->outputs.normal);
    lsf_texture_destroy(pass->context, &pass->outputs.radiance);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
