#include "gl/context.h"

#include <stdio.h>

static uint32_t level_size(uint32_t size, uint32_t level)
{
    uint32_t reduced = level < 32 ? size >> level : 0;
    return reduced ? reduced : 1;
}

/* Slices shrink with the level; layers and faces do not. */
static uint64_t level_texels(const lsf_texture_desc *desc, uint32_t level)
{
    uint32_t depth = desc->target == GL_TEXTURE_3D ? level_size(desc->depth, level) : desc->depth;
    uint64_t plane = (uint64_t)level_size(desc->width, level) * level_size(desc->height, level);
    uint64_t texels;
    return __builtin_mul_overflow(plane, (uint64_t)depth, &texels) ? UINT64_MAX : texels;
}

uint64_t lsf_texture_bytes(const lsf_texture_desc *desc)
{
    uint64_t total = 0;
    for (uint32_t level = 0; level < desc->levels; level++) {
        uint64_t bytes;
        if (__builtin_mul_overflow(level_texels(desc, level),
                                   (uint64_t)lsf_format_bytes(desc->internal_format), &bytes) ||
            __builtin_add_overflow(total, bytes, &total))
            return UINT64_MAX;
    }
    return total;
}

static bool fail(const char *what, const char *size_name, uint32_t size, const char *limit_name,
                 uint32_t limit, lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_RENDER,
                         "%s: its %s of %u is outside 1 to %u, this device's limit (%s); ask for a "
                         "smaller one",
                         what, size_name, size, limit, limit_name);
}

static bool within(const char *what, const char *size_name, uint32_t size, GLenum limit,
                   const char *limit_name, lsf_error *error)
{
    GLint most = 0;
    glGetIntegerv(limit, &most);
    return (size >= 1 && size <= (uint32_t)most) ||
           fail(what, size_name, size, limit_name, (uint32_t)most, error);
}

static bool check_limits(const lsf_texture_desc *desc, const char *what, lsf_error *error)
{
    GLenum limit = GL_MAX_TEXTURE_SIZE;
    const char *name = "GL_MAX_TEXTURE_SIZE";
    bool depth_fits = false;
    switch (desc->target) {
    case GL_TEXTURE_2D:
        depth_fits = desc->depth == 1 || fail(what, "depth", desc->depth, "a 2D texture", 1, error);
        break;
    case GL_TEXTURE_2D_ARRAY:
        depth_fits = within(what, "layer count", desc->depth, GL_MAX_ARRAY_TEXTURE_LAYERS,
                            "GL_MAX_ARRAY_TEXTURE_LAYERS", error);
        break;
    case GL_TEXTURE_CUBE_MAP:
        limit = GL_MAX_CUBE_MAP_TEXTURE_SIZE;
        name = "GL_MAX_CUBE_MAP_TEXTURE_SIZE";
        depth_fits = (desc->depth == 6 && desc->width == desc->height) ||
                     lsf_error_set(error, LSF_ERROR_RENDER,
                                   "%s: a cube map has six faces, each as high as wide", what);
        break;
    case GL_TEXTURE_3D:
        limit = GL_MAX_3D_TEXTURE_SIZE;
        name = "GL_MAX_3D_TEXTURE_SIZE";
        depth_fits = within(what, "depth", desc->depth, limit, name, error);
        break;
    default:
        lsf_error_set(error, LSF_ERROR_RENDER, "%s: target 0x%04x is not supported", what,
                      desc->target);
        break;
    }
    if (!depth_fits || !within(what, "width", desc->width, limit, name, error) ||
        !within(what, "height", desc->height, limit, name, error))
        return false;

    uint32_t largest = desc->width > desc->height ? desc->width : desc->height;
    if (desc->target == GL_TEXTURE_3D && desc->depth > largest)
        largest = desc->depth;
    uint32_t most_levels = 1;
    while (largest >> most_levels)
        most_levels++;
    if (desc->levels < 1 || desc->levels > most_levels)
        return fail(what, "level count", desc->levels, "a full mip chain", most_levels, error);
    if (lsf_format_bytes(desc->internal_format) == 0)
        return lsf_error_set(error, LSF_ERROR_RENDER, "%s: the format is not a sized one", what);
    return true;
}

GLuint lsf_texture_create(lsf_context *context, const lsf_texture_desc *desc, lsf_error *error)
{
    char what[320];
    snprintf(what, sizeof what, "texture %s, %s, %u x %u x %u, %u level%s, %llu bytes",
             desc->label ? desc->label : "without a label", lsf_format_name(desc->internal_format),
             desc->width, desc->height, desc->depth, desc->levels, lsf_plural(desc->levels),
             (unsigned long long)lsf_texture_bytes(desc));
    if (!check_limits(desc, what, error) || !lsf_memory_begin(context, what, error))
        return 0;

    GLsizei width = (GLsizei)desc->width, height = (GLsizei)desc->height;
    GLsizei levels = (GLsizei)desc->levels;
    GLuint texture = 0;
    glCreateTextures(desc->target, 1, &texture);
    if (desc->target == GL_TEXTURE_2D || desc->target == GL_TEXTURE_CUBE_MAP)
        glTextureStorage2D(texture, levels, desc->internal_format, width, height);
    else
        glTextureStorage3D(texture, levels, desc->internal_format, width, height,
                           (GLsizei)desc->depth);
    if (!lsf_memory_end(context, GL_TEXTURE, texture, lsf_texture_bytes(desc), what, error)) {
        glDeleteTextures(1, &texture);
        return 0;
    }
    /* Whatever the number of levels: software GL compiles a program for each filter. */
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    lsf_debug_label(GL_TEXTURE, texture, desc->label);
    return texture;
}

void lsf_texture_destroy(lsf_context *context, GLuint *texture)
{
    if (*texture == 0)
        return;
    lsf_memory_forget(context, GL_TEXTURE, *texture);
    glDeleteTextures(1, texture);
    *texture = 0;
}
