/* Buffer textures, and what software GL makes of them. Mesa's llvmpipe compiles a program for the
 * state of each of its sampler slots, and a slot that reads a buffer texture keeps the state that
 * the slot's last other texture had (Mesa 22.3.6). That is another in a context's first iteration
 * than later on, so that programs were compiled twice. */
#include "gl/context.h"

enum { SLOTS = 24 }; /* as in lib/sampler_slots.glsl; programs have fewer */

/* A sampler object for each slot. */
static void make_samplers(GLuint samplers[SLOTS])
{
    glCreateSamplers(SLOTS, samplers);
    for (int i = 0; i < SLOTS; i++)
        lsf_sampler_set_nearest(samplers[i]);
}

/* Runs a program of each kind, of which every slot has the state of lsf_texture_create's textures:
 * the one that most textures leave. */
static bool settle_slots(lsf_context *context, lsf_error *error)
{
    static const lsf_program_desc drawn = {
        .label = "sampler_slots",
        .files = {"lib/fullscreen.vert.glsl", "lib/sampler_slots.frag.glsl"}};
    static const lsf_program_desc dispatched = {.label = "sampler_slots",
                                                .files = {"lib/sampler_slots.comp.glsl"}};
    static const lsf_framebuffer_desc desc = {
        .label = "sampler_slots", .layer = -1, .width = 1, .height = 1};
    GLuint draw = lsf_program_get(context, &drawn, error);
    GLuint dispatch = draw ? lsf_program_get(context, &dispatched, error) : 0;
    GLuint framebuffer = dispatch ? lsf_framebuffer_create(context, &desc, error) : 0;
    if (!framebuffer)
        return false;
    GLuint samplers[SLOTS];
    make_samplers(samplers);
    for (GLuint unit = 0; unit < SLOTS; unit++)
        lsf_bind_texture(unit, 0);
    glBindSamplers(0, SLOTS, samplers);
    lsf_begin_fullscreen(framebuffer, 1, 1, draw);
    lsf_draw_fullscreen(context);
    glUseProgram(dispatch);
    glDispatchCompute(1, 1, 1);
    glBindSamplers(0, SLOTS, NULL);
    glDeleteSamplers(SLOTS, samplers);
    lsf_framebuffer_destroy(context, &framebuffer);
    return true;
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
