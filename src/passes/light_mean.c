#include "passes/light_mean.h"

#include <string.h>

#include "base/base.h"
#include "frame/sparse_grid.h"

#define AT(member) offsetof(lsf_light_mean, member)

static const lsf_texture_row textures[] = {
    {"light_mean.guide", GL_RGBA32F, AT(guide), 0, "for light_filter"},
    {"light_mean.diffuse", GL_RGBA32F, AT(diffuse.light), 0, "for light_filter"},
    {"light_mean.diffuse_factor", GL_RGBA32F, AT(diffuse.factor), 0, "for light_filter"},
    {"light_mean.specular", GL_RGBA32F, AT(specular.light), LSF_TEXTURE_SPECULAR,
     "for light_filter"},
    {"light_mean.specular_factor", GL_RGBA32F, AT(specular.factor), LSF_TEXTURE_SPECULAR,
     "for light_filter"},
    {"light_mean.half", GL_RG32F, AT(half), 0, "luminance of the first half of the iterations"},
};

void lsf_light_mean_plan(lsf_plan *plan, const lsf_light_mean_use *use)
{
    const lsf_requirements *r = &plan->requirements;
    bool specular_params = lsf_gbuffer_specular_params(plan) != GL_NONE;
    lsf_plan_pass_add(plan, "light_mean", "means of the parts of light, for its filter");
    lsf_plan_reads(plan, "view gbuffer");
    if (use->indirect)
        lsf_plan_reads(plan, LSF_PLAN_INDIRECT);
    if (use->sky)
        lsf_plan_reads(plan, "direct_light");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PARAMS", specular_params, "roughness or metallic vary");
    lsf_plan_switch_add(plan, "LSF_ANISOTROPY", 0, "never: lobes were evaluated before");
    lsf_plan_switch_add(plan, "LSF_SPECULAR", r->specular, "materials have a specular lobe");
    lsf_plan_switch_add(plan, "LSF_TRANSMISSION", plan->transmission,
                        "light passes materials that transmit");
    lsf_scene_gpu_seen_through_switch(plan);
    lsf_plan_switch_add(plan, "LSF_STRAIGHT", plan->straight, "it goes straight on");
    lsf_plan_switch_add(plan, "LSF_REFRACTED", plan->refracted,
                        "refracted paths show what is behind media");
    lsf_scene_gpu_scatter_switch(plan);
    lsf_plan_switch_add(plan, "LSF_ABSORPTION", lsf_plan_media_absorb(plan),
                        "there are media, which are looked through");
    lsf_scene_gpu_lobe_switches(plan, specular_params);
    lsf_plan_switch_add(plan, "LSF_INDIRECT", use->indirect, "light bounces, or comes by chance");
    lsf_plan_switch_add(plan, "LSF_SPLIT_DIRECT", use->split_direct,
                        "direct light is asked for apart");
    lsf_plan_switch_add(plan, "LSF_SKY_LIGHT", use->sky, "directions of the environment");
    lsf_sparse_grid_pixel_switch(plan);
    lsf_plan_textures_add(plan, textures, LSF_COUNT(textures), 0, plan->width, plan->height);
}

bool lsf_light_mean_create(lsf_light_mean *pass, lsf_context *context, const lsf_plan *plan,
                           lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl", "passes/light_mean.frag.glsl"};
    *pass = (lsf_light_mean){.context = context};
    if (!lsf_plan_create_textures(plan, context, textures, LSF_COUNT(textures), pass, error))
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

uint32_t lsf_light_mean_half(uint32_t iterations)
{
    uint32_t half = 1;
    while (half < iterations - half)
        half *= 2;
    return iterations > 1 ? half : 0;
}

void lsf_light_mean_run(lsf_light_mean *pass, const lsf_iteration *iteration,
                        const lsf_light_parts *parts, GLuint gate)
{
    const GLuint means[] = {pass->guide, pass->diffuse.light, pass->diffuse.factor,
                            pass->specular.light, pass->specular.factor};
    lsf_timer_begin(pass->timer);
    lsf_begin_fullscreen(pass->framebuffer, iteration->plan->width, iteration->plan->height,
                         pass->program);
    glUniform1f(0, 1.0f / ((float)iteration->done + 1.0f));
    glUniform1i(1, lsf_light_mean_half(iteration->done + 1) == iteration->done);
    glBindImageTexture(5, pass->half, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RG32F);
    lsf_surface_maps_bind(&parts->gbuffer->seen);
    lsf_bind_texture(3, parts->indirect.irradiance);
    lsf_bind_texture(4, parts->indirect.specular);
    lsf_bind_texture(7, parts->split_direct.irradiance);
    lsf_bind_texture(8, parts->split_direct.specular);
    lsf_bind_texture(12, parts->sky.irradiance);
    lsf_bind_texture(13, parts->sky.specular);
    lsf_bind_texture(10, parts->gbuffer->tint);
    lsf_bind_texture(11, parts->gbuffer->absorption);
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
    lsf_textures_destroy(pass->context, textures, LSF_COUNT(textures), pass);
    glDeleteFramebuffers(1, &pass->framebuffer);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
