#include "passes/voxel_view.h"

#include <string.h>

#include "base/base.h"
#include "shared/scene_data.h"

#define AT(member) offsetof(lsf_voxel_view, outputs.member)

/* Conditions are bits of lsf_aov. */
static const lsf_texture_row layers[] = {
    {"voxel_view.albedo", GL_RGBA32F, AT(albedo), LSF_AOV_VOXEL_ALBEDO, "asked for"},
    {"voxel_view.normal", GL_RGBA32F, AT(normal), LSF_AOV_VOXEL_NORMAL, "asked for"},
    {"voxel_view.radiance", GL_RGBA32F, AT(radiance), LSF_AOV_VOXEL_RADIANCE, "asked for"},
};

bool lsf_voxel_view_needed(const lsf_plan *plan)
{
    return (plan->aovs & (LSF_AOV_VOXEL_ALBEDO | LSF_AOV_VOXEL_NORMAL | LSF_AOV_VOXEL_RADIANCE)) !=
           0;
}

void lsf_voxel_view_plan(lsf_plan *plan, uint32_t sides)
{
    lsf_plan_pass_add(plan, "voxel_view", "voxels as the camera sees them");
    lsf_plan_reads(plan, "view voxelize voxel_light");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_VOXEL_SIDES", (int)sides, "sides that radiance is kept for");
    lsf_plan_textures_add(plan, layers, LSF_COUNT(layers), plan->aovs, plan->seen_width,
                          plan->seen_height);
}

bool lsf_voxel_view_create(lsf_voxel_view *pass, lsf_context *context, const lsf_plan *plan,
                           lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl", "passes/voxel_view.frag.glsl"};
    static const GLenum targets[3] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                      GL_COLOR_ATTACHMENT2};
    *pass = (lsf_voxel_view){.context = context};
    lsf_voxel_view_outputs *o = &pass->outputs;
    if (!lsf_plan_create_textures(plan, context, layers, LSF_COUNT(layers), pass, error))
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
    lsf_begin_fullscreen(pass->framebuffer, iteration->plan->seen_width,
                         iteration->plan->seen_height, pass->program);
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
    lsf_textures_destroy(pass->context, layers, LSF_COUNT(layers), pass);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
