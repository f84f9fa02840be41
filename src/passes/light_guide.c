#include "passes/light_guide.h"

#include <string.h>

#include "base/base.h"

#define AT(member) offsetof(lsf_light_guide, member)

static const lsf_texture_row textures[] = {
    {"light_guide.guide", GL_RGBA32F, AT(maps.guide), 0,
     "normal, depth and lobe, for filters of light"},
    {"light_guide.slope", GL_RGBA32F, AT(maps.slope), 0, "of what is seen"},
    {"light_guide.curvature", GL_RG16F, AT(maps.curvature), 0, "of normals from pixel to pixel"},
};

void lsf_light_guide_plan(lsf_plan *plan)
{
    lsf_plan_pass_add(plan, "light_guide", "tells filters of light which pixels see one surface");
    lsf_plan_reads(plan, "light_mean");
    lsf_plan_switch_add(plan, "LSF_LOBE", plan->requirements.specular,
                        "materials have a specular lobe");
    lsf_plan_switch_add(plan, "LSF_PATTERN", (int)plan->pattern,
                        "the side of the interleaving pattern whose light is pooled");
    lsf_plan_textures_add(plan, textures, LSF_COUNT(textures), 0, plan->width, plan->height);
}

bool lsf_light_guide_create(lsf_light_guide *pass, lsf_context *context, const lsf_plan *plan,
                            lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl",
                                         "passes/light_guide.frag.glsl"};
    *pass = (lsf_light_guide){.context = context};
    if (!lsf_plan_create_textures(plan, context, textures, LSF_COUNT(textures), pass, error))
        return false;
    const lsf_framebuffer_desc desc = {
        .label = "light_guide",
        .color_count = 3,
        .colors = {pass->maps.guide, pass->maps.slope, pass->maps.curvature},
        .layer = -1};
    pass->framebuffer = lsf_framebuffer_create(context, &desc, error);
    pass->program =
        pass->framebuffer ? lsf_plan_program(plan, context, "light_guide", files, error) : 0;
    pass->timer = pass->program ? lsf_timer_create(context, "light_guide", error) : NULL;
    return pass->timer != NULL;
}

void lsf_light_guide_run(lsf_light_guide *pass, const lsf_plan *plan, uint32_t iterations,
                         const lsf_light_guide_inputs *inputs)
{
    lsf_timer_begin(pass->timer);
    lsf_begin_fullscreen(pass->framebuffer, plan->width, plan->height, pass->program);
    lsf_bind_texture(0, inputs->mean);
    lsf_bind_texture(1, inputs->diffuse_factor);
    glUniform1f(0, (float)iterations);
    if (plan->requirements.specular) {
        lsf_bind_texture(2, inputs->specular_factor);
        glUniform1f(1, inputs->kernel);
    }
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->timer);
}

void lsf_light_guide_destroy(lsf_light_guide *pass)
{
    if (!pass->context)
        return;
    lsf_textures_destroy(pass->context, textures, LSF_COUNT(textures), pass);
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
