#include "passes/tonemap.h"

#include <math.h>
#include <string.h>

void lsf_tonemap_plan(lsf_plan *plan, bool rgb8)
{
    lsf_plan_pass_add(plan, "tonemap",
                      rgb8 ? "8-bit output is asked for; runs once, on the mean"
                           : "presenting is asked for; runs once, on the mean");
    lsf_plan_reads(plan, "accumulate");
    if (rgb8)
        lsf_plan_texture_add(plan, "tonemap.display", GL_RGBA8, plan->width, plan->height,
                             "8-bit sRGB");
}

bool lsf_tonemap_create(lsf_tonemap *pass, lsf_context *context, const lsf_plan *plan, bool rgb8,
                        lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl", "passes/tonemap.frag.glsl"};
    *pass = (lsf_tonemap){.context = context, .width = plan->width, .height = plan->height};
    if (rgb8 && !lsf_plan_create_texture(plan, context, "tonemap.display", &pass->display, error))
        return false;
    const lsf_framebuffer_desc desc = {
        .label = "tonemap", .color_count = 1, .colors = {pass->display}, .layer = -1};
    if (rgb8 && !(pass->framebuffer = lsf_framebuffer_create(context, &desc, error)))
        return false;
    pass->program = lsf_plan_program(plan, context, "tonemap", files, error);
    pass->timer = lsf_timer_create(context, "tonemap", error);
    return pass->program && pass->timer;
}

static void draw(lsf_tonemap *pass, GLuint radiance, GLuint framebuffer, const int32_t viewport[4],
                 float exposure, lsf_tone_curve curve, bool rows_from_top)
{
    lsf_timer_begin(pass->timer);
    lsf_begin_fullscreen(framebuffer, pass->width, pass->height, pass->program);
    glViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
    glUniform1f(0, exp2f(exposure));
    glUniform1i(1, (GLint)curve);
    glUniform4f(2, (float)viewport[0], (float)viewport[1], (float)pass->width / (float)viewport[2],
                (float)pass->height / (float)viewport[3]);
    glUniform1i(3, rows_from_top);
    lsf_bind_texture(0, radiance);
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->timer);
}

void lsf_tonemap_run(lsf_tonemap *pass, GLuint radiance, float exposure, lsf_tone_curve curve)
{
    const int32_t whole[4] = {0, 0, (int32_t)pass->width, (int32_t)pass->height};
    draw(pass, radiance, pass->framebuffer, whole, exposure, curve, true);
}

void lsf_tonemap_present(lsf_tonemap *pass, GLuint radiance, GLuint framebuffer,
                         const int32_t viewport[4], float exposure, lsf_tone_curve curve)
{
    draw(pass, radiance, framebuffer, viewport, exposure, curve, false);
}

void lsf_tonemap_destroy(lsf_tonemap *pass)
{
    if (!pass->context)
        return;
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    lsf_texture_destroy(pass->context, &pass->display);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
