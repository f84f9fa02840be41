#include "passes/light_mean.h"

#include <string.h>

#include "base/base.h"

void lsf_light_mean_plan(lsf_plan *plan, bool split_direct)
{
    const lsf_requirements *r = &plan->requirements;
    bool gloss = lsf_gbuffer_gloss(plan) != GL_NONE;
    lsf_plan_pass_add(plan, "light_mean", "means of the parts of light, for its filter");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_GLOSS", gloss, "roughness or metallic vary");
    lsf_plan_switch_add(plan, "LSF_ANISOTROPY", 0, "never: lobes were evaluated before");
    lsf_plan_switch_add(plan, "LSF_SPECULAR", r->specular, "materials have a specular lobe");
    lsf_plan_switch_add(plan, "LSF_TRANSMISSION", plan->transmission,
                        "light passes materials that transmit");
    lsf_plan_switch_add(plan, "LSF_STRAIGHT", plan->straight, "it goes straight on");
    lsf_plan_switch_add(plan, "LSF_ABSORPTION", plan->straight && r->refractive, "there are media");
    lsf_scene_gpu_lobe_switches(plan, gloss);
    lsf_plan_switch_add(plan, "LSF_SPLIT_DIRECT", split_direct, "direct light is asked for apart");
    const char *names[] = {"light_mean.guide", "light_mean.diffuse", "light_mean.diffuse_factor",
                           "light_mean.specular", "light_mean.specular_factor"};
    for (uint32_t i = 0; i < (r->specular ? 5 : 3); i++)
        lsf_plan_texture_add(plan, names[i], GL_RGBA32F, plan->width, plan->height,
                             "for light_filter");
}

bool lsf_light_mean_create(lsf_light_mean *pass, lsf_context *context, const lsf_plan *plan,
                           lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl", "passes/light_mean.frag.glsl"};
    *pass = (lsf_light_mean){.context = context};
    const struct {
        const char *name;
        GLuint *texture;
    } textures[] = {
        {"light_mean.guide", &pass->guide},
        {"light_mean.diffuse", &pass->diffuse.light},
        {"light_mean.diffuse_factor", &pass->diffuse.factor},
        {"light_mean.specular", &pass->specular.light},
        {"light_mean.specular_factor", &pass->specular.factor},
    };
    for (size_t i = 0; i < LSF_COUNT(textures); i++)
        if (!lsf_plan_create_texture_if_planned(plan, context, textures[i].name,
                                                textures[i].texture, error))
            return false;
    glCreateFramebuffers(1, &pass->framebuffer);
    glNamedFramebufferParameteri(pass->framebuffer, GL_FRAMEBUFFER_DEFAULT_WIDTH,
                                 (GLint)plan->width);
    glNamedFramebufferParameteri(pass->framebuffer, GL_FRAMEBUFFER_DEFAULT_HEIGHT,
                                 (GLint)plan->height);
    pass->program = lsf_plan_program(plan, context, "light_mean", files, error);
    pass->timer = pass->program ? lsf_timer_create(context, "light_mean", error) : NULL;
    return pass->timer != NULL;
}

void lsf_light_mean_run(lsf_light_mean *pass, const lsf_iteration *iteration,
                        const lsf_light_mean_inputs *inputs, GLuint gate)
{
    const GLuint means[] = {pass->guide, pass->diffuse.light, pass->diffuse.factor,
                            pass->specular.light, pass->specular.factor};
    lsf_timer_begin(pass->timer);
    lsf_begin_fullscreen(pass->framebuffer, iteration->plan->width, iteration->plan->height,
                         pass->program);
    glUniform1f(0, 1.0f / ((float)iteration->done + 1.0f));
    lsf_surface_maps_bind(&inputs->gbuffer->seen);
    lsf_bind_texture(3, inputs->indirect.irradiance);
    lsf_bind_texture(4, inputs->indirect.specular);
    lsf_bind_texture(7, inputs->direct.irradiance);
    lsf_bind_texture(8, inputs->direct.specular);
    lsf_bind_texture(10, inputs->gbuffer->tint);
    lsf_bind_texture(11, inputs->gbuffer->absorption);
    for (GLuint i = 0; i < LSF_COUNT(means); i++)
        if (means[i])
            glBindImageTexture(i, means[i], 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    if (gate)
        lsf_draw_fullscreen_indirect(pass->context, gate);
    else
        lsf_draw_fullscreen(pass->context);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    lsf_timer_end(pass->timer);
}

void lsf_light_mean_destroy(lsf_light_mean *pass)
{
    if (!pass->context)
        return;
    GLuint *textures[] = {&pass->guide, &pass->diffuse.light, &pass->diffuse.factor,
                          &pass->specular.light, &pass->specular.factor};
    for (size_t i = 0; i < LSF_COUNT(textures); i++)
        lsf_texture_destroy(pass->context, textures[i]);
    glDeleteFramebuffers(1, &pass->framebuffer);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
