#include "window/canvas.h"

#include "base/base.h"
#include "window/gl_calls.h"

#include <stdlib.h>
#include <string.h>

void lsf_canvas_destroy(lsf_canvas *canvas)
{
    if (canvas->framebuffer)
        lsf_gl.DeleteFramebuffers(1, &canvas->framebuffer);
    if (canvas->texture)
        lsf_gl.DeleteTextures(1, &canvas->texture);
    *canvas = (lsf_canvas){0};
}

bool lsf_canvas_resize(lsf_canvas *canvas, uint32_t width, uint32_t height, lsf_error *error)
{
    if (canvas->texture && canvas->width == width && canvas->height == height)
        return true;
    lsf_canvas_destroy(canvas);
    while (lsf_gl.GetError() != GL_NO_ERROR) {
    }
    lsf_gl.CreateTextures(GL_TEXTURE_2D, 1, &canvas->texture);
    lsf_gl.TextureStorage2D(canvas->texture, 1, GL_RGBA8, (GLsizei)width, (GLsizei)height);
    lsf_gl.TextureParameteri(canvas->texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    lsf_gl.TextureParameteri(canvas->texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    lsf_gl.TextureParameteri(canvas->texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    lsf_gl.TextureParameteri(canvas->texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    lsf_gl.ClearTexImage(canvas->texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    lsf_gl.CreateFramebuffers(1, &canvas->framebuffer);
    lsf_gl.NamedFramebufferTexture(canvas->framebuffer, GL_COLOR_ATTACHMENT0, canvas->texture, 0);
    if (lsf_gl.GetError() != GL_NO_ERROR) {
        lsf_canvas_destroy(canvas);
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory for a picture of %ux%u pixels",
                             width, height);
    }
    canvas->width = width;
    canvas->height = height;
    return true;
}

void lsf_canvas_write(lsf_canvas *canvas, const uint8_t *rgb)
{
    lsf_gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (uint32_t y = 0; y < canvas->height; y++)
        lsf_gl.TextureSubImage2D(canvas->texture, 0, 0, (GLint)(canvas->height - 1 - y),
                                 (GLsizei)canvas->width, 1, GL_RGB, GL_UNSIGNED_BYTE,
                                 rgb + (size_t)y * canvas->width * 3);
    lsf_gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

void lsf_canvas_read(const lsf_canvas *canvas, uint8_t *rgb)
{
    lsf_gl.BindFramebuffer(GL_READ_FRAMEBUFFER, canvas->framebuffer);
    lsf_gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    for (uint32_t y = 0; y < canvas->height; y++)
        lsf_gl.ReadPixels(0, (GLint)(canvas->height - 1 - y), (GLsizei)canvas->width, 1, GL_RGB,
                          GL_UNSIGNED_BYTE, rgb + (size_t)y * canvas->width * 3);
    lsf_gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    lsf_gl.BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}
