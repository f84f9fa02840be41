#include "frame/upload.h"

#include <stdio.h>
#include <string.h>

static void staging_name(const char *name, char text[64])
{
    snprintf(text, 64, "%s_staging", name);
}

void lsf_upload_plan(lsf_plan *plan, const char *name, uint64_t bytes, const char *why)
{
    char staging[64];
    staging_name(name, staging);
    lsf_plan_buffer_add(plan, name, bytes, "%s", why);
    lsf_plan_buffer_add(plan, staging, LSF_UPLOAD_PARTS * bytes,
                        "the same of the last iterations, on its way to the GPU");
}

bool lsf_upload_create(lsf_upload *upload, lsf_context *context, const lsf_plan *plan,
                       const char *name, lsf_error *error)
{
    const GLbitfield map = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    char staging[64];
    staging_name(name, staging);
    *upload = (lsf_upload){0};
    if (!lsf_plan_create_buffer(plan, context, name, NULL, 0, &upload->buffer, error) ||
        !lsf_plan_create_buffer(plan, context, staging, NULL, map, &upload->staging, error))
        return false;
    upload->bytes = lsf_plan_find(plan, name)->bytes;
    upload->mapped = glMapNamedBufferRange(upload->staging, 0,
                                           (GLsizeiptr)(LSF_UPLOAD_PARTS * upload->bytes), map);
    return upload->mapped || lsf_error_set(error, LSF_ERROR_RENDER, "%s cannot be mapped", staging);
}

void *lsf_upload_begin(lsf_upload *upload)
{
    const GLuint64 second = UINT64_C(1000000000);
    GLsync *copied = &upload->copied[upload->part];
    while (*copied &&
           glClientWaitSync(*copied, GL_SYNC_FLUSH_COMMANDS_BIT, second) == GL_TIMEOUT_EXPIRED) {
    }
    glDeleteSync(*copied); /* NULL is ignored */
    *copied = NULL;
    return upload->mapped + upload->part * upload->bytes;
}

void lsf_upload_end(lsf_upload *upload)
{
    glCopyNamedBufferSubData(upload->staging, upload->buffer,
                             (GLintptr)(upload->part * upload->bytes), 0,
                             (GLsizeiptr)upload->bytes);
    upload->copied[upload->part] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    upload->part = (upload->part + 1) % LSF_UPLOAD_PARTS;
}

void lsf_upload_destroy(lsf_upload *upload, lsf_context *context)
{
    for (uint32_t i = 0; i < LSF_UPLOAD_PARTS; i++)
        glDeleteSync(upload->copied[i]);
    lsf_buffer_destroy(context, &upload->staging);
    lsf_buffer_destroy(context, &upload->buffer);
    memset(upload, 0, sizeof *upload);
}
