#include "frame/resources.h"

#include <string.h>

static bool refuse(const char *what, const char *name, lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_RENDER,
                         "the frame plan lists no %s \"%s\": a fault of Lightsheaf's", what, name);
}

bool lsf_plan_create_texture(const lsf_plan *plan, lsf_context *context, const char *name,
                             GLuint *texture, lsf_error *error)
{
    const lsf_plan_resource *resource = lsf_plan_find(plan, name);
    if (!resource || resource->is_buffer)
        return refuse("texture", name, error);
    lsf_texture_desc desc = resource->texture;
    desc.label = resource->name;
    *texture = lsf_texture_create(context, &desc, error);
    return *texture != 0;
}

bool lsf_plan_create_buffer(const lsf_plan *plan, lsf_context *context, const char *name,
                            const void *data, GLbitfield flags, GLuint *buffer, lsf_error *error)
{
    const lsf_plan_resource *resource = lsf_plan_find(plan, name);
    if (!resource || !resource->is_buffer)
        return refuse("buffer", name, error);
    *buffer = lsf_buffer_create(context, resource->name, resource->bytes, data, flags, error);
    return *buffer != 0;
}

bool lsf_plan_create_texture_if_planned(const lsf_plan *plan, lsf_context *context,
                                        const char *name, GLuint *texture, lsf_error *error)
{
    return !lsf_plan_find(plan, name) ||
           lsf_plan_create_texture(plan, context, name, texture, error);
}

bool lsf_plan_create_buffer_if_planned(const lsf_plan *plan, lsf_context *context, const char *name,
                                       const void *data, GLbitfield flags, GLuint *buffer,
                                       lsf_error *error)
{
    return !lsf_plan_find(plan, name) ||
           lsf_plan_create_buffer(plan, context, name, data, flags, buffer, error);
}

static GLuint *texture_of(void *pass, const lsf_texture_row *row)
{
    return (GLuint *)(void *)((char *)pass + row->offset);
}

bool lsf_plan_create_textures(const lsf_plan *plan, lsf_context *context,
                              const lsf_texture_row *rows, size_t count, void *pass,
                              lsf_error *error)
{
    for (size_t i = 0; i < count; i++)
        if (!lsf_plan_create_texture_if_planned(plan, context, rows[i].name,
                                                texture_of(pass, &rows[i]), error))
            return false;
    return true;
}

void lsf_textures_destroy(lsf_context *context, const lsf_texture_row *rows, size_t count,
                          void *pass)
{
    for (size_t i = 0; i < count; i++)
        lsf_texture_destroy(context, texture_of(pass, &rows[i]));
}

bool lsf_plan_resize_buffer(lsf_plan *plan, lsf_context *context, const char *name, uint64_t bytes,
                            GLbitfield flags, GLuint *buffer, lsf_error *error)
{
    for (uint64_t i = 0; i < plan->resource_count; i++) {
        lsf_plan_resource *resource = &plan->resources[i];
        if (strcmp(resource->name, name) != 0)
            continue;
        lsf_buffer_destroy(context, buffer);
        resource->bytes = 0;
        *buffer = lsf_buffer_create(context, name, bytes, NULL, flags, error);
        if (!*buffer)
            return false;
        resource->bytes = bytes;
        return true;
    }
    return refuse("buffer", name, error);
}

GLuint lsf_plan_program(const lsf_plan *plan, lsf_context *context, const char *pass_name,
                        const char *const files[5], lsf_error *error)
{
    const lsf_plan_pass *pass = lsf_plan_find_pass(plan, pass_name);
    lsf_define defines[LSF_PLAN_MAX_SWITCHES];
    if (!pass) {
        refuse("pass", pass_name, error);
        return 0;
    }
    for (uint32_t i = 0; i < pass->switch_count; i++)
        defines[i] = pass->switches[i].define;
    lsf_program_desc desc = {
        .label = pass_name, .defines = defines, .define_count = pass->switch_count};
    for (int i = 0; i < 5 && files[i]; i++)
        desc.files[i] = files[i];
    return lsf_program_get(context, &desc, error);
}
