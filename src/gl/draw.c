/* Draws, and the state that they need. */
#include "gl/context.h"

/* User clip planes that GL promises. */
#define CLIP_DISTANCES 8

/* State in which every fragment of every triangle is written unchanged. state.c sets the rest. */
static void set_plain_state(uint32_t width, uint32_t height, GLuint program)
{
    static const GLenum off[] = {GL_SCISSOR_TEST,
                                 GL_STENCIL_TEST,
                                 GL_DEPTH_TEST,
                                 GL_DEPTH_CLAMP,
                                 GL_CULL_FACE,
                                 GL_BLEND,
                                 GL_COLOR_LOGIC_OP,
                                 GL_POLYGON_OFFSET_FILL,
                                 GL_RASTERIZER_DISCARD,
                                 GL_PRIMITIVE_RESTART,
                                 GL_PRIMITIVE_RESTART_FIXED_INDEX};
    for (size_t i = 0; i < LSF_COUNT(off); i++)
        glDisable(off[i]);
    for (GLenum plane = 0; plane < CLIP_DISTANCES; plane++)
        glDisable(GL_CLIP_DISTANCE0 + plane);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
    glFrontFace(GL_CCW);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glDepthRange(0.0, 1.0);
    glViewport(0, 0, (GLsizei)width, (GLsizei)height);
    glUseProgram(program);
}

void lsf_begin_fullscreen(GLuint framebuffer, uint32_t width, uint32_t height, GLuint program)
{
    set_plain_state(width, height, program);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

void lsf_skip_background(void)
{
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS); /* the triangle's 0 against the depth of a surface, which is greater */
    glDepthMask(GL_FALSE);
}

void lsf_begin_surfaces(uint32_t width, uint32_t height, GLuint program)
{
    set_plain_state(width, height, program);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
}

void lsf_cull_back(bool culled, bool mirrored)
{
    if (!culled) {
        glDisable(GL_CULL_FACE);
        return;
    }
    glEnable(GL_CULL_FACE);
    glCullFace(mirrored ? GL_FRONT : GL_BACK);
}

void lsf_blend_add(uint32_t attachments)
{
    for (uint32_t i = 0; i < attachments; i++)
        glEnablei(GL_BLEND, i);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
}

void lsf_blend_add_color(void)
{
    glEnablei(GL_BLEND, 0);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ZERO);
}

void lsf_blend_multiply(uint32_t attachment)
{
    glEnablei(GL_BLEND, attachment);
    glBlendEquationi(attachment, GL_FUNC_ADD);
    glBlendFunci(attachment, GL_ZERO, GL_SRC_COLOR);
}

void lsf_draw_fullscreen(lsf_context *context)
{
    lsf_draw_vertices(context, 3);
}

void lsf_draw_fullscreen_indirect(lsf_context *context, GLuint buffer)
{
    glBindVertexArray(context->empty_vertex_array);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer);
    glDrawArraysIndirect(GL_TRIANGLES, NULL);
}

void lsf_draw_vertices(lsf_context *context, uint32_t count)
{
    glBindVertexArray(context->empty_vertex_array);
    glDrawArrays(GL_TRIANGLES, 0, (GLsizei)count);
}

void lsf_bind_texture(GLuint unit, GLuint texture)
{
    glBindTextureUnit(unit, texture);
    glBindSampler(unit, 0);
}
