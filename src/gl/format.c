#include "gl/gl.h"

#include <stddef.h>

/* Bytes that drivers store for a texel: depth formats of 24 bits take a whole word, and a 32-bit
 * depth with stencil takes two. */
static const struct {
    GLenum format;
    uint32_t bytes;
    const char *name;
} formats[] = {
#define FORMAT(name, bytes)                                                                        \
    {                                                                                              \
        name, bytes, #name                                                                         \
    }
    FORMAT(GL_R8, 1),
    FORMAT(GL_R8_SNORM, 1),
    FORMAT(GL_R8I, 1),
    FORMAT(GL_R8UI, 1),
    FORMAT(GL_R16, 2),
    FORMAT(GL_R16_SNORM, 2),
    FORMAT(GL_R16F, 2),
    FORMAT(GL_R16I, 2),
    FORMAT(GL_R16UI, 2),
    FORMAT(GL_R32F, 4),
    FORMAT(GL_R32I, 4),
    FORMAT(GL_R32UI, 4),
    FORMAT(GL_RG8, 2),
    FORMAT(GL_RG8_SNORM, 2),
    FORMAT(GL_RG8I, 2),
    FORMAT(GL_RG8UI, 2),
    FORMAT(GL_RG16, 4),
    FORMAT(GL_RG16_SNORM, 4),
    FORMAT(GL_RG16F, 4),
    FORMAT(GL_RG16I, 4),
    FORMAT(GL_RG16UI, 4),
    FORMAT(GL_RG32F, 8),
    FORMAT(GL_RG32I, 8),
    FORMAT(GL_RG32UI, 8),
    FORMAT(GL_RGB8, 3),
    FORMAT(GL_SRGB8, 3),
    FORMAT(GL_RGB16F, 6),
    FORMAT(GL_RGB32F, 12),
    FORMAT(GL_RGB9_E5, 4),
    FORMAT(GL_R11F_G11F_B10F, 4),
    FORMAT(GL_RGB10_A2, 4),
    FORMAT(GL_RGB10_A2UI, 4),
    FORMAT(GL_RGBA8, 4),
    FORMAT(GL_RGBA8_SNORM, 4),
    FORMAT(GL_RGBA8I, 4),
    FORMAT(GL_RGBA8UI, 4),
    FORMAT(GL_SRGB8_ALPHA8, 4),
    FORMAT(GL_RGBA16, 8),
    FORMAT(GL_RGBA16_SNORM, 8),
    FORMAT(GL_RGBA16F, 8),
    FORMAT(GL_RGBA16I, 8),
    FORMAT(GL_RGBA16UI, 8),
    FORMAT(GL_RGBA32F, 16),
    FORMAT(GL_RGBA32I, 16),
    FORMAT(GL_RGBA32UI, 16),
    FORMAT(GL_DEPTH_COMPONENT16, 2),
    FORMAT(GL_DEPTH_COMPONENT24, 4),
    FORMAT(GL_DEPTH_COMPONENT32F, 4),
    FORMAT(GL_DEPTH24_STENCIL8, 4),
    FORMAT(GL_DEPTH32F_STENCIL8, 8),
#undef FORMAT
};

uint32_t lsf_format_bytes(GLenum internal_format)
{
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++)
        if (formats[i].format == internal_format)
            return formats[i].bytes;
    return 0;
}

const char *lsf_format_name(GLenum internal_format)
{
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++)
        if (formats[i].format == internal_format)
            return formats[i].name;
    return "unknown format";
}
