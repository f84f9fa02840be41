#include "passes/accumulate.h"

#include <stdio.h>
#include <string.h>

void lsf_accumulate_plan(lsf_plan *plan, uint32_t layer_count, const char *const *layer_names)
{
    lsf_plan_pass_add(plan, "accumulate", "the mean over iterations");
    lsf_plan_reads(plan, "view compose voxel_view");
    if (plan->aovs & (LSF_AOV_ALBEDO | LSF_AOV_NORMAL | LSF_AOV_DEPTH | LSF_AOV_MOTION))
        lsf_plan_reads(plan, "gbuffer");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    if ((plan->aovs & LSF_AOV_NORMAL) && plan->seen_through)
        lsf_scene_gpu_scatter_switch(plan);
    lsf_sparse_grid_pixel_switch(plan);
    for (uint32_t i = 0; i < layer_count; i++) {
        char name[64];
        snprintf(name, sizeof name, "accumulate.%s", layer_names[i]);
        lsf_plan_texture_add(plan, name, GL_RGBA32F, plan->width, plan->height,
                             i == 0 ? "the result" : "asked for");
    }
}

static lsf_accumulate_source source_of(const char *layer)
{
    static const char *const names[] = {"", "albedo", "normal", "depth"};
    for (int i = LSF_ACCUMULATE_ALBEDO; i < LSF_ACCUMULATE_SOURCES; i++)
        if (strcmp(names[i], layer) == 0)
            return (lsf_accumulate_source)i;
    return LSF_ACCUMULATE_COLOR;
}

static bool create_program(lsf_accumulate *pass, const lsf_plan *plan, lsf_accumulate_source source,
                           lsf_error *error)
{
    if (pass->programs[source])
        return true;
    const lsf_define defines[] = {
        {"LSF_SOURCE", (int)source},
        {"LSF_ORTHOGRAPHIC", plan->orthographic},
        {"LSF_PIXEL_SIDE", (int)plan->pixel_side},
        {"LSF_SCATTER", lsf_plan_switch_value(plan, "accumulate", "LSF_SCATTER")}};
    lsf_program_desc desc = {.label = "accumulate",
                             .files = {"lib/fullscreen.vert.glsl", "passes/accumulate.frag.glsl"},
                             .defines = defines,
                             .define_count = defines[3].value ? 4 : 3};
    pass->programs[source] = lsf_program_get(pass->context, &desc, error);
    return pass->programs[source] != 0;
}

bool lsf_accumulate_create(lsf_accumulate *pass, lsf_context *context, const lsf_plan *plan,
                           uint32_t layer_count, const char *const *layer_names, lsf_error *error)
{
    *pass = (lsf_accumulate){.context = context, .layer_count = layer_count};
    for (uint32_t i = 0; i < layer_count; i++) {
        char name[64];
        snprintf(name, sizeof name, "accumulate.%s", layer_names[i]);
        pass->sources[i] = source_of(layer_names[i]);
        if (!lsf_plan_create_texture(plan, context, name, &pass->means[i], error) ||
            !create_program(pass, plan, pass->sources[i], error))
            return false;
    }
    glCreateFramebuffers(1, &pass->framebuffer);
    glNamedFramebufferParameteri(pass->framebuffer, GL_FRAMEBUFFER_DEFAULT_WIDTH,
                                 (GLint)plan->width);
    glNamedFramebufferParameteri(pass->framebuffer, GL_FRAMEBUFFER_DEFAULT_HEIGHT,
                                 (GLint)plan->height);
    pass->timer = lsf_timer_create(context, "accumulate", error);
    return pass->timer != NULL;
}

void lsf_accumulate_run(lsf_accumulate *pass, const lsf_iteration *iteration,
                        const GLuint *textures, GLuint depth, GLuint gate)
{
    lsf_timer_begin(pass->timer);
    for (uint32_t i = 0; i < pass->layer_count; i++) {
        if (!textures[i])
            continue;
        lsf_begin_fullscreen(pass->framebuffer, iteration->plan->width, iteration->plan->height,
                             pass->programs[pass->sources[i]]);
        glUniform1f(0, 1.0f / ((float)iteration->done + 1.0f));
        lsf_bind_texture(0, textures[i]);
        lsf_bind_texture(1, depth);
        glBindImageTexture(0, pass->means[i], 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
        if (gate)
            lsf_draw_fullscreen_indirect(pass->context, gate);
        else
            lsf_draw_fullscreen(pass->context);
    }
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_TEXTURE_UPDATE_BARRIER_BIT);
    lsf_timer_end(pass->timer);
}

void lsf_accumulate_destroy(lsf_accumulate *pass)
{
    if (!pass->context)
        return;
    for (uint32_t i = 0; i < pass->layer_count; i++)
        lsf_texture_destroy(pass->context, &pass->means[i]);
    glDeleteFramebuffers(1, &pass->framebuffer);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
