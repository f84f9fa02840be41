#include "gl/context.h"

#include <stdio.h>
#include <string.h>

const char *lsf_gl_error_name(GLenum code)
{
    switch (code) {
    case GL_NO_ERROR:
        return "GL_NO_ERROR";
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    case GL_STACK_OVERFLOW:
        return "GL_STACK_OVERFLOW";
    case GL_STACK_UNDERFLOW:
        return "GL_STACK_UNDERFLOW";
    case GL_CONTEXT_LOST:
        return "GL_CONTEXT_LOST";
    default:
        return "an unknown GL error";
    }
}

/* Mesa ends its messages with a newline. */
static int message_length(const char *message)
{
    return (int)strcspn(message, "\n");
}

/* The innermost pass that is running, as "name: ". */
static const char *group_prefix(const lsf_context *context, char prefix[static 128])
{
    uint32_t depth =
        context->group_count < LSF_GROUP_DEPTH_MAX ? context->group_count : LSF_GROUP_DEPTH_MAX;
    prefix[0] = '\0';
    if (depth)
        snprintf(prefix, 128, "%s: ", context->groups[depth - 1]);
    return prefix;
}

/* lsf_context_check tells of the first error: later ones tend to follow from it. */
static void record_error(lsf_context *context, const char *message)
{
    if (context->error_expected || context->error_seen)
        return;
    char prefix[128];
    context->error_seen = true;
    snprintf(context->first_error, sizeof context->first_error, "%s%.*s",
             group_prefix(context, prefix), message_length(message), message);
}

static lsf_log_level level_of(GLenum type, GLenum severity)
{
    bool is_error = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
    if (severity == GL_DEBUG_SEVERITY_HIGH)
        return is_error ? LSF_LOG_ERROR : LSF_LOG_WARNING;
    if (severity == GL_DEBUG_SEVERITY_MEDIUM)
        return is_error ? LSF_LOG_WARNING : LSF_LOG_INFO; /* NVIDIA's performance hints */
    return LSF_LOG_DEBUG;
}

static void GLAD_API_PTR on_message(GLenum source, GLenum type, GLuint id, GLenum severity,
                                    GLsizei length, const GLchar *message, const void *user)
{
    (void)id;
    (void)length;
    lsf_context *context = (lsf_context *)user;
    if (type == GL_DEBUG_TYPE_PUSH_GROUP || type == GL_DEBUG_TYPE_POP_GROUP)
        return;
    /* The caller that tries an allocation or a compilation reports its failure. */
    bool reported_elsewhere = context->error_expected || source == GL_DEBUG_SOURCE_SHADER_COMPILER;
    lsf_log_level level = reported_elsewhere ? LSF_LOG_DEBUG : level_of(type, severity);
    char prefix[128];
    lsf_log(level, "OpenGL: %s%.*s", group_prefix(context, prefix), message_length(message),
            message);
    if (!reported_elsewhere && (severity == GL_DEBUG_SEVERITY_HIGH || type == GL_DEBUG_TYPE_ERROR))
        record_error(context, message);
}

void lsf_debug_install(lsf_context *context, bool debug)
{
    if (!debug)
        return;
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS); /* so that a breakpoint shows the offending call */
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, NULL, GL_TRUE);
    glDebugMessageCallback(on_message, context);
}

GLenum lsf_debug_take_errors(lsf_context *context)
{
    GLenum first = GL_NO_ERROR;
    /* The loop is bounded: a lost context may answer GL_CONTEXT_LOST for ever. */
    for (int i = 0; i < 16; i++) {
        GLenum code = glGetError();
        if (code == GL_NO_ERROR)
            break;
        record_error(context, lsf_gl_error_name(code));
        if (first == GL_NO_ERROR)
            first = code;
    }
    return first;
}

void lsf_debug_label(GLenum identifier, GLuint name, const char *label)
{
    enum {
        GUARANTEED_LENGTH = 256, /* the least GL_MAX_LABEL_LENGTH, with the terminator */
    };
    if (label)
        glObjectLabel(identifier, name, (GLsizei)strnlen(label, GUARANTEED_LENGTH - 1), label);
}

void lsf_debug_push_group(lsf_context *context, const char *name)
{
    if (context->group_count < LSF_GROUP_DEPTH_MAX)
        context->groups[context->group_count] = name;
    context->group_count++;
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, name);
}

void lsf_debug_pop_group(lsf_context *context)
{
    glPopDebugGroup();
    context->group_count--;
}
