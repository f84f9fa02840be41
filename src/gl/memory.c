/* The bytes of GL storage that are alive, and the hook by which tests make an allocation fail. */
#include "gl/context.h"

void lsf_context_fail_allocation(lsf_context *context, uint64_t n)
{
    context->fail_countdown = n;
}

bool lsf_memory_begin(lsf_context *context, const char *what, lsf_error *error)
{
    lsf_debug_take_errors(context); /* An older error must not be taken for one of this
                                     * allocation. */
    if (context->fail_countdown && --context->fail_countdown == 0)
        return lsf_error_set(error, LSF_ERROR_RENDER,
                             "%s: allocation failed on purpose, as a test asked", what);
    context->error_expected = true;
    return true;
}

static bool record(lsf_context *context, GLenum kind, GLuint name, uint64_t bytes)
{
    void *allocations = context->allocations;
    if (!lsf_grow(&allocations, &context->allocation_capacity, context->allocation_count + 1,
                  sizeof(lsf_allocation)))
        return false;
    context->allocations = allocations;
    context->allocations[context->allocation_count++] = (lsf_allocation){kind, name, bytes};
    context->gl_bytes += bytes;
    if (context->gl_bytes > context->gl_bytes_peak)
        context->gl_bytes_peak = context->gl_bytes;
    return true;
}

bool lsf_memory_end(lsf_context *context, GLenum kind, GLuint name, uint64_t bytes,
                    const char *what, lsf_error *error)
{
    GLenum code = lsf_debug_take_errors(context);
    context->error_expected = false;
    if (code == GL_OUT_OF_MEMORY)
        return lsf_error_set(error, LSF_ERROR_RENDER,
                             "%s: the device has no memory left for it beside the %llu bytes "
                             "already in use; lower the resolution or the size it comes from",
                             what, (unsigned long long)context->gl_bytes);
    if (code != GL_NO_ERROR)
        return lsf_error_set(error, LSF_ERROR_RENDER, "%s: the driver refused it with %s", what,
                             lsf_gl_error_name(code));
    if (bytes && !record(context, kind, name, bytes))
        return lsf_error_set(error, LSF_ERROR_RENDER, "%s: out of memory", what);
    return true;
}

void lsf_memory_forget(lsf_context *context, GLenum kind, GLuint name)
{
    for (uint64_t i = context->allocation_count; i-- > 0;) {
        if (context->allocations[i].kind == kind && context->allocations[i].name == name) {
            context->gl_bytes -= context->allocations[i].bytes;
            context->allocations[i] = context->allocations[--context->allocation_count];
            return;
        }
    }
}
