/* The output of a sandbox's picture. */
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "sandbox/sandbox.h"

uint32_t lsf_sandbox_texture(const lsf_sandbox *sandbox)
{
    if (!sandbox)
        return 0;
    const lsf_sandbox_target *target = &sandbox->targets[LSF_SANDBOX_IMAGE];
    return target->textures[target->now];
}

/* R, G, B and A, rows from the bottom. */
static float *read_texels(const lsf_sandbox *sandbox, lsf_error *error)
{
    const lsf_render_params *params = &sandbox->params.render;
    uint64_t bytes = (uint64_t)params->width * params->height * 4 * sizeof(float);
    float *texels = bytes <= INT32_MAX ? lsf_alloc(bytes, 1) : NULL;
    if (texels)
        glGetTextureImage(lsf_sandbox_texture(sandbox), 0, GL_RGBA, GL_FLOAT, (GLsizei)bytes,
                          texels);
    else
        lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %ux%u pixels", params->width,
                      params->height);
    return texels;
}

lsf_image *lsf_sandbox_read(lsf_sandbox *sandbox, lsf_error *error)
{
    static const char *const names[] = {"R", "G", "B"};
    if (!lsf_given(sandbox, "sandbox", error))
        return NULL;
    LSF_LEAVE lsf_context *entered = lsf_context_enter(sandbox->context, error);
    if (!entered)
        return NULL;
    const lsf_render_params *params = &sandbox->params.render;
    float *texels = read_texels(sandbox, error);
    lsf_image *image =
        texels ? lsf_image_create(params->width, params->height, 3, names, error) : NULL;
    for (uint32_t y = 0; image && y < params->height; y++)
        for (uint32_t x = 0; x < params->width; x++)
            memcpy(image->pixels + 3 * ((size_t)y * params->width + x),
                   texels + 4 * ((size_t)(params->height - 1 - y) * params->width + x),
                   3 * sizeof(float));
    free(texels);
    if (image && !lsf_context_check(sandbox->context, error)) {
        lsf_image_destroy(image);
        return NULL;
    }
    return image;
}

/* A NaN is black. */
static uint8_t to_byte(float value)
{
    return value > 0.0f ? (uint8_t)((value < 1.0f ? value : 1.0f) * 255.0f + 0.5f) : 0;
}

static bool read_display(const lsf_sandbox *sandbox, uint8_t *rgb, lsf_error *error)
{
    uint32_t width = sandbox->params.render.width, height = sandbox->params.render.height;
    float *texels = read_texels(sandbox, error);
    for (uint32_t y = 0; texels && y < height; y++)
        for (uint32_t x = 0; x < width; x++)
            for (uint32_t c = 0; c < 3; c++)
                rgb[3 * ((size_t)y * width + x) + c] =
                    to_byte(texels[4 * ((size_t)(height - 1 - y) * width + x) + c]);
    free(texels);
    return texels != NULL;
}

static void read_mapped(lsf_sandbox *sandbox, float exposure, lsf_tone_curve curve, uint8_t *rgb)
{
    uint32_t width = sandbox->params.render.width, height = sandbox->params.render.height;
    lsf_tonemap_run(&sandbox->tonemap, lsf_sandbox_texture(sandbox), exposure, curve);
    glGetTextureImage(sandbox->tonemap.display, 0, GL_RGB, GL_UNSIGNED_BYTE,
                      (GLsizei)(width * height * 3), rgb);
}

bool lsf_sandbox_read_rgb8(lsf_sandbox *sandbox, float exposure, lsf_tone_curve curve, uint8_t *rgb,
                           lsf_error *error)
{
    if (!lsf_given(sandbox, "sandbox", error) || !lsf_given(rgb, "rgb", error))
        return false;
    LSF_LEAVE lsf_context *entered = lsf_context_enter(sandbox->context, error);
    if (!entered)
        return false;
    if (sandbox->tonemap.timer)
        read_mapped(sandbox, exposure, curve, rgb);
    else if (!read_display(sandbox, rgb, error))
        return false;
    return lsf_context_check(sandbox->context, error);
}

bool lsf_sandbox_present(lsf_sandbox *sandbox, uint32_t framebuffer, const int32_t viewport[4],
                         float exposure, lsf_tone_curve curve, lsf_error *error)
{
    if (!lsf_given(sandbox, "sandbox", error) || !lsf_given(viewport, "viewport", error))
        return false;
    LSF_LEAVE lsf_context *entered = lsf_context_enter(sandbox->context, error);
    if (!entered)
        return false;
    const lsf_render_params *params = &sandbox->params.render;
    const lsf_sandbox_target *target = &sandbox->targets[LSF_SANDBOX_IMAGE];
    if (sandbox->tonemap.timer) {
        lsf_tonemap_present(&sandbox->tonemap, target->textures[target->now], framebuffer, viewport,
                            exposure, curve);
    } else {
        lsf_begin_fullscreen(framebuffer, params->width, params->height, 0);
        glBlitNamedFramebuffer(target->framebuffers[target->now], framebuffer, 0, 0,
                               (GLint)params->width, (GLint)params->height, viewport[0],
                               viewport[1], viewport[0] + viewport[2], viewport[1] + viewport[3],
                               GL_COLOR_BUFFER_BIT, GL_LINEAR);
    }
    return lsf_context_check(sandbox->context, error);
}
