/* Buffer textures, and what software GL makes of them. Mesa's llvmpipe compiles a program for the
 * state of each of its sampler slots, and a slot that reads a buffer texture keeps the state that
 * the slot's last other texture had (Mesa 22.3.6). That is another in a context's first iteration
 * than later on, so that programs were compiled twice. */
#include "gl/context.h"

enum { SLOTS = 24 }; /* programs have fewer */

/* Runs a fragment shader and a compute shader that have a texture in every slot: one with the
 * sampling state of most textures. */
static bool run_slots(lsf_context *context, GLuint texture, GLuint framebuffer, lsf_error *error)
{
    static const lsf_define slots = {"LSF_SAMPLER_SLOTS", SLOTS};
    static const lsf_program_desc drawn = {
        .label = "sampler_slots",
        .files = {"lib/fullscreen.vert.glsl", "lib/sampler_slots.frag.glsl"},
        .defines = &slots,
        .define_count = 1};
    static const lsf_program_desc dispatched = {.label = "sampler_slots",
                                                .files = {"lib/sampler_slots.comp.glsl"},
                                                .defines = &slots,
                                                .define_count = 1};
    GLuint draw = lsf_program_get(context, &drawn, error);
    GLuint dispatch = draw ? lsf_program_get(context, &dispatched, error) : 0;
    if (!dispatch)
        return false;
    for (GLuint unit = 0; unit < SLOTS; unit++)
        lsf_bind_texture(unit, texture);
    lsf_begin_fullscreen(framebuffer, 1, 1, draw);
    lsf_draw_fullscreen(context);
    glUseProgram(dispatch);
    glDispatchCompute(1, 1, 1);
    return true;
}

static bool settle_slots(lsf_context *context, lsf_error *error)
{
    static const lsf_texture_desc pixel = {.label = "sampler_slots",
                                           .target = GL_TEXTURE_2D,
                                           .internal_format = GL_R8,
                                           .width = 1,
                                           .height = 1,
                                           .depth = 1,
                                           .levels = 1};
    static const lsf_framebuffer_desc desc = {
        .label = "sampler_slots", .layer = -1, .width = 1, .height = 1};
    GLuint texture = lsf_texture_create(context, &pixel, error);
    GLuint framebuffer = texture ? lsf_framebuffer_create(context, &desc, error) : 0;
    bool good = framebuffer && run_slots(context, texture, framebuffer, error);
    lsf_framebuffer_destroy(context, &framebuffer);
    lsf_texture_destroy(context, &texture);
    return good;
}

bool lsf_buffer_textures_create(lsf_context *context, GLsizei count, GLuint *textures,
                                lsf_error *error)
{
    if (context->software && !context->slots_settled && !settle_slots(context, error))
        return false;
    context->slots_settled = true;
    glCreateTextures(GL_TEXTURE_BUFFER, count, textures);
    return true;
}
