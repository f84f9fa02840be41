#include "gl/context.h"

#include <stdio.h>

GLuint lsf_buffer_create(lsf_context *context, const char *label, uint64_t bytes, const void *data,
                         GLbitfield flags, lsf_error *error)
{
    char what[256];
    snprintf(what, sizeof what, "buffer %s, %llu bytes", label ? label : "without a label",
             (unsigned long long)bytes);
    if (bytes == 0 || bytes > (uint64_t)PTRDIFF_MAX) {
        lsf_error_set(error, LSF_ERROR_RENDER, "%s: its size must lie between 1 and %llu bytes",
                      what, (unsigned long long)PTRDIFF_MAX);
        return 0;
    }
    if (!lsf_memory_begin(context, what, error))
        return 0;
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, (GLsizeiptr)bytes, data, flags);
    if (!lsf_memory_end(context, GL_BUFFER, buffer, bytes, what, error)) {
        glDeleteBuffers(1, &buffer);
        return 0;
    }
    lsf_debug_label(GL_BUFFER, buffer, label);
    return buffer;
}

void lsf_buffer_destroy(lsf_context *context, GLuint *buffer)
{
    if (*buffer == 0)
        return;
    lsf_memory_forget(context, GL_BUFFER, *buffer);
    glDeleteBuffers(1, buffer);
    *buffer = 0;
}
