#include "gl/context.h"

#include <stdio.h>

static const char *status_description(GLenum status)
{
    switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
        return "an attachment cannot be rendered to, or its layer does not exist";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
        return "it has no attachment";
    case GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS:
        return "layered and plain attachments are mixed";
    case GL_FRAMEBUFFER_UNSUPPORTED:
        return "the driver does not support this mix of formats";
    default:
        return "it is incomplete";
    }
}

static void attach(GLuint framebuffer, GLenum attachment, GLuint texture, int32_t layer)
{
    if (layer < 0)
        glNamedFramebufferTexture(framebuffer, attachment, texture, 0);
    else
        glNamedFramebufferTextureLayer(framebuffer, attachment, texture, 0, layer);
}

GLuint lsf_framebuffer_create(lsf_context *context, const lsf_framebuffer_desc *desc,
                              lsf_error *error)
{
    char what[256];
    snprintf(what, sizeof what, "framebuffer %s", desc->label ? desc->label : "without a label");
    GLint most = 0;
    glGetIntegerv(GL_MAX_DRAW_BUFFERS, &most);
    if (desc->color_count > LSF_COUNT(desc->colors) || desc->color_count > (uint32_t)most) {
        lsf_error_set(error, LSF_ERROR_RENDER,
                      "%s: %u colour attachments are more than the %d that this device writes at "
                      "once (GL_MAX_DRAW_BUFFERS)",
                      what, desc->color_count, most);
        return 0;
    }
    if (!lsf_memory_begin(context, what, error))
        return 0;
    GLuint framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    GLenum buffers[LSF_COUNT(desc->colors)] = {GL_NONE};
    uint32_t colors = 0;
    for (uint32_t i = 0; i < desc->color_count; i++)
        if (desc->colors[i]) {
            buffers[colors] = GL_COLOR_ATTACHMENT0 + colors;
            attach(framebuffer, buffers[colors++], desc->colors[i], desc->layer);
        }
    if (desc->depth)
        attach(framebuffer, GL_DEPTH_ATTACHMENT, desc->depth, desc->layer);
    glNamedFramebufferDrawBuffers(framebuffer, colors ? (GLsizei)colors : 1, buffers);
    glNamedFramebufferReadBuffer(framebuffer, buffers[0]);
    if (desc->width) {
        glNamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_WIDTH, (GLint)desc->width);
        glNamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_HEIGHT,
                                     (GLint)desc->height);
    }
    GLenum status = glCheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER);
    if (!lsf_memory_end(context, GL_FRAMEBUFFER, framebuffer, 0, what, error)) {
        glDeleteFramebuffers(1, &framebuffer);
        return 0;
    }
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        lsf_error_set(error, LSF_ERROR_RENDER, "%s: %s (status 0x%04x)", what,
                      status_description(status), status);
        glDeleteFramebuffers(1, &framebuffer);
        return 0;
    }
    lsf_debug_label(GL_FRAMEBUFFER, framebuffer, desc->label);
    return framebuffer;
}

void lsf_framebuffer_destroy(lsf_context *context, GLuint *framebuffer)
{
    (void)context;
    glDeleteFramebuffers(1, framebuffer); /* 0 is ignored */
    *framebuffer = 0;
}
