/* Refuses a plan that the device cannot hold before anything is allocated. */
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "frame/resources.h"

#define GPU_MEMORY_AVAILABLE_NVX 0x9049 /* kilobytes, GL_NVX_gpu_memory_info */

static bool has_extension(const char *name)
{
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; i++)
        if (strcmp((const char *)glGetStringi(GL_EXTENSIONS, (GLuint)i), name) == 0)
            return true;
    return false;
}

/* Bytes that GL may take: half of what is free in software, where GL and the program share main
 * memory; what the driver reports on a GPU; infinity when nobody tells. */
static double available_bytes(const lsf_context *context)
{
    if (lsf_context_get_info(context).software)
        return 0.5 * (double)sysconf(_SC_AVPHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    GLint kilobytes = 0;
    if (has_extension("GL_NVX_gpu_memory_info"))
        glGetIntegerv(GPU_MEMORY_AVAILABLE_NVX, &kilobytes);
    return kilobytes > 0 ? 1024.0 * kilobytes : INFINITY;
}

bool lsf_plan_check(const lsf_plan *plan, const lsf_context *context, lsf_error *error)
{
    GLint max_size = 0, max_viewport[2] = {0}, max_layers = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &max_size);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, max_viewport);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &max_layers);
    uint32_t widest = (uint32_t)(max_size < max_viewport[0] ? max_size : max_viewport[0]);
    uint32_t highest = (uint32_t)(max_size < max_viewport[1] ? max_size : max_viewport[1]);
    if (plan->width > widest || plan->height > highest)
        return lsf_error_set(error, LSF_ERROR_RENDER,
                             "a picture of %ux%u is more than this device draws; the largest is "
                             "%u,%u pixels",
                             plan->width, plan->height, plan->width < widest ? plan->width : widest,
                             plan->height < highest ? plan->height : highest);
    double fixed = 0.0, scaling = 0.0; /* bytes that stay the same, and bytes that grow with the
                                        * resolution */
    for (uint64_t i = 0; i < plan->resource_count; i++) {
        const lsf_plan_resource *resource = &plan->resources[i];
        bool of_scene = resource->is_buffer || strncmp(resource->name, "scene.", 6) == 0;
        *(of_scene ? &fixed : &scaling) += (double)resource->bytes;
        if (resource->is_buffer)
            continue;
        const lsf_texture_desc *texture = &resource->texture;
        if (texture->width > (uint32_t)max_size || texture->height > (uint32_t)max_size)
            return lsf_error_set(error, LSF_ERROR_RENDER,
                                 "%s (%s) is %ux%u and this device holds %d; use a smaller %s",
                                 resource->name, resource->why, texture->width, texture->height,
                                 max_size, of_scene ? "image" : "resolution");
    }
    double available = available_bytes(context);
    if (fixed + scaling <= available)
        return true;
    if (fixed >= available)
        return lsf_error_set(error, LSF_ERROR_RENDER,
                             "the scene takes %.0f MiB of GL memory and %.0f are free; use smaller "
                             "textures or less geometry (`lightsheaf plan` lists them)",
                             fixed / 1048576.0, available / 1048576.0);
    double factor = sqrt((available - fixed) / scaling);
    return lsf_error_set(
        error, LSF_ERROR_RENDER,
        "%ux%u takes %.0f MiB of GL memory and %.0f are free; a resolution of %u,%u "
        "would fit",
        plan->width, plan->height, (fixed + scaling) / 1048576.0, available / 1048576.0,
        (uint32_t)fmax(1.0, floor(plan->width * factor)),
        (uint32_t)fmax(1.0, floor(plan->height * factor)));
}
