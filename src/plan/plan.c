#include "plan/plan.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"

#define FORMAT_INTO(buffer, format)                                                                \
    do {                                                                                           \
        va_list arguments;                                                                         \
        va_start(arguments, format);                                                               \
        lsf_format_plain(buffer, sizeof(buffer), format, arguments);                               \
        va_end(arguments);                                                                         \
    } while (0)

bool lsf_plan_surfaces_shine(const lsf_plan *plan)
{
    return plan->requirements.emissive || plan->requirements.unlit;
}

bool lsf_plan_media_absorb(const lsf_plan *plan)
{
    return plan->straight && plan->requirements.refractive && !plan->refracted;
}

bool lsf_plan_measures_motion(const lsf_plan *plan)
{
    return plan->temporal || (plan->aovs & LSF_AOV_MOTION);
}

bool lsf_plan_surfaces_differ(const lsf_plan *plan)
{
    const lsf_requirements *r = &plan->requirements;
    return r->specular && (r->glossy || r->variable_ior || r->anisotropic || plan->transmission);
}

/* A zeroed new element at the end of one of the plan's lists, or NULL. */
static void *append(lsf_plan *plan, void **list, uint64_t *count, uint64_t *capacity, uint64_t size)
{
    if (plan->failed || !lsf_grow(list, capacity, *count + 1, size)) {
        plan->failed = true;
        return NULL;
    }
    void *element = (char *)*list + (*count)++ * size;
    memset(element, 0, size);
    return element;
}

#define APPEND(plan, singular)                                                                     \
    append(plan, (void **)&(plan)->singular##s, &(plan)->singular##_count,                         \
           &(plan)->singular##_capacity, sizeof *(plan)->singular##s)

void lsf_plan_pass_add(lsf_plan *plan, const char *name, const char *why, ...)
{
    lsf_plan_pass *pass = append(plan, (void **)&plan->passes, &plan->pass_count,
                                 &plan->pass_capacity, sizeof *plan->passes);
    if (!pass)
        return;
    pass->name = name;
    FORMAT_INTO(pass->why, why);
}

void lsf_plan_reads(lsf_plan *plan, const char *names)
{
    if (plan->failed)
        return;
    const char **reads = plan->passes[plan->pass_count - 1].reads;
    for (int i = 0; i < LSF_PLAN_MAX_READS - 1; i++)
        if (!reads[i]) {
            reads[i] = names;
            return;
        }
    plan->failed = true;
}

void lsf_plan_fills(lsf_plan *plan, const char *stem)
{
    if (!plan->failed)
        plan->passes[plan->pass_count - 1].fills = stem;
}

void lsf_plan_switch_add(lsf_plan *plan, const char *name, int value, const char *when, ...)
{
    if (plan->failed)
        return;
    lsf_plan_pass *pass = &plan->passes[plan->pass_count - 1];
    if (pass->switch_count == LSF_PLAN_MAX_SWITCHES) {
        plan->failed = true;
        return;
    }
    lsf_plan_switch *added = &pass->switches[pass->switch_count++];
    added->define = (lsf_define){name, value};
    FORMAT_INTO(added->when, when);
}

static lsf_plan_resource *add_resource(lsf_plan *plan, const char *name)
{
    lsf_plan_resource *resource = APPEND(plan, resource);
    if (resource)
        snprintf(resource->name, sizeof resource->name, "%s", name);
    return resource;
}

void lsf_plan_texture_add(lsf_plan *plan, const char *name, GLenum internal_format, uint32_t width,
                          uint32_t height, const char *why, ...)
{
    lsf_plan_resource *resource = add_resource(plan, name);
    if (!resource)
        return;
    resource->texture =
        (lsf_texture_desc){NULL, GL_TEXTURE_2D, internal_format, width, height, 1, 1};
    resource->bytes = lsf_texture_bytes(&resource->texture);
    FORMAT_INTO(resource->why, why);
}

void lsf_plan_texture_desc_add(lsf_plan *plan, const char *name, const lsf_texture_desc *desc,
                               const char *why, ...)
{
    lsf_plan_resource *resource = add_resource(plan, name);
    if (!resource)
        return;
    resource->texture = *desc;
    resource->bytes = lsf_texture_bytes(desc);
    FORMAT_INTO(resource->why, why);
}

void lsf_plan_buffer_add(lsf_plan *plan, const char *name, uint64_t bytes, const char *why, ...)
{
    lsf_plan_resource *resource = add_resource(plan, name);
    if (!resource)
        return;
    resource->is_buffer = true;
    resource->bytes = bytes;
    FORMAT_INTO(resource->why, why);
}

void lsf_plan_omit(lsf_plan *plan, const char *name, const char *why, ...)
{
    lsf_plan_omission *omission = APPEND(plan, omission);
    if (!omission)
        return;
    snprintf(omission->name, sizeof omission->name, "%s", name);
    FORMAT_INTO(omission->why, why);
}

void lsf_plan_leave_out(lsf_plan *plan, const char *resource, const char *why)
{
    uint64_t left = 0;
    for (uint64_t i = 0; i < plan->resource_count; i++)
        if (strcmp(plan->resources[i].name, resource) != 0)
            plan->resources[left++] = plan->resources[i];
    if (left < plan->resource_count)
        lsf_plan_omit(plan, resource, "%s", why);
    plan->resource_count = left;
}

void lsf_plan_remark(lsf_plan *plan, const char *format, ...)
{
    char **remark = APPEND(plan, remark);
    if (!remark)
        return;
    va_list arguments;
    va_start(arguments, format);
    *remark = lsf_format_arguments(format, arguments);
    if (!*remark)
        plan->failed = true;
    va_end(arguments);
}

void lsf_plan_destroy(lsf_plan *plan)
{
    if (!plan)
        return;
    for (uint64_t i = 0; i < plan->remark_count; i++)
        free(plan->remarks[i]);
    free(plan->remarks);
    free(plan->passes);
    free(plan->resources);
    free(plan->omissions);
    free(plan->weights);
    free(plan);
}

uint32_t lsf_plan_bounces(const lsf_plan *plan)
{
    if (!plan)
        return 0;
    return plan->bounces;
}

const char *lsf_plan_weights(const lsf_plan *plan)
{
    if (!plan)
        return NULL;
    return plan->weights;
}

uint64_t lsf_plan_bytes(const lsf_plan *plan)
{
    if (!plan)
        return 0;
    uint64_t bytes = 0;
    for (uint64_t i = 0; i < plan->resource_count; i++)
        bytes += plan->resources[i].bytes;
    return bytes;
}

const lsf_plan_pass *lsf_plan_find_pass(const lsf_plan *plan, const char *name)
{
    for (uint64_t i = 0; i < plan->pass_count; i++)
        if (strcmp(plan->passes[i].name, name) == 0)
            return &plan->passes[i];
    return NULL;
}

const lsf_plan_resource *lsf_plan_find(const lsf_plan *plan, const char *name)
{
    for (uint64_t i = 0; i < plan->resource_count; i++)
        if (strcmp(plan->resources[i].name, name) == 0)
            return &plan->resources[i];
    return NULL;
}

int lsf_plan_switch_value(const lsf_plan *plan, const char *pass_name, const char *name)
{
    const lsf_plan_pass *pass = lsf_plan_find_pass(plan, pass_name);
    for (uint32_t i = 0; pass && i < pass->switch_count; i++)
        if (strcmp(pass->switches[i].define.name, name) == 0)
            return pass->switches[i].define.value;
    return 0;
}

void lsf_plan_textures_add(lsf_plan *plan, const lsf_texture_row *rows, size_t count,
                           uint32_t given, uint32_t width, uint32_t height)
{
    const lsf_plan_resource *specular_params = lsf_plan_find(plan, "gbuffer.specular_params");
    GLenum specular_params_format =
        specular_params ? specular_params->texture.internal_format : GL_NONE;
    if (plan->requirements.specular)
        given |= LSF_TEXTURE_SPECULAR;
    for (size_t i = 0; i < count; i++) {
        GLenum format = rows[i].format ? rows[i].format : specular_params_format;
        if (format && !(rows[i].when & ~given))
            lsf_plan_texture_add(plan, rows[i].name, format, width, height, "%s", rows[i].why);
    }
}
