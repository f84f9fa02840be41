#include "scene/texture_sample.h"

#include <math.h>
#include <stddef.h>

/* IEC 61966-2-1. */
static float srgb_to_linear(float c)
{
    return c <= 0.04045f ? c / 12.92f : powf((c + 0.055f) / 1.055f, 2.4f);
}

static float srgb8_table[256];

__attribute__((constructor)) static void fill_srgb8_table(void)
{
    for (int i = 0; i < 256; i++)
        srgb8_table[i] = srgb_to_linear((float)i / 255.0f);
}

static float read_channel(const lsf_texture_image *image, size_t at, bool srgb)
{
    switch (image->type) {
    case LSF_TEXEL_U8: {
        uint8_t value = ((const uint8_t *)image->texels)[at];
        return srgb ? srgb8_table[value] : (float)value / 255.0f;
    }
    case LSF_TEXEL_U16: {
        float value = (float)((const uint16_t *)image->texels)[at] / 65535.0f;
        return srgb ? srgb_to_linear(value) : value;
    }
    case LSF_TEXEL_F32:
        break;
    }
    return ((const float *)image->texels)[at]; /* float images hold linear values */
}

static lsf_texel read_texel(const lsf_texture_image *image, int64_t x, int64_t y, bool srgb)
{
    size_t at = ((size_t)y * image->width + (size_t)x) * image->channels;
    lsf_texel texel = {.a = 1.0f};
    texel.r = texel.g = texel.b = read_channel(image, at, srgb);
    if (image->channels >= 3) {
        texel.g = read_channel(image, at + 1, srgb);
        texel.b = read_channel(image, at + 2, srgb);
    }
    if (image->channels == 2 || image->channels == 4)
        texel.a = read_channel(image, at + image->channels - 1, false);
    return texel;
}

/* Brings a coordinate into one period (two for mirroring), so that texel indices are small. */
static double fold(double u, lsf_wrap wrap)
{
    if (!isfinite(u))
        return 0.0;
    switch (wrap) {
    case LSF_WRAP_REPEAT:
        return u - floor(u);
    case LSF_WRAP_MIRROR:
        return u - 2.0 * floor(0.5 * u);
    case LSF_WRAP_CLAMP:
        break;
    }
    return fmin(fmax(u, 0.0), 1.0);
}

/* Texel index of a folded coordinate's neighbour, which may be one outside the period. */
static int64_t wrap_index(int64_t i, int64_t size, lsf_wrap wrap)
{
    switch (wrap) {
    case LSF_WRAP_REPEAT:
        return (i + size) % size;
    case LSF_WRAP_MIRROR:
        i = (i + 2 * size) % (2 * size);
        return i < size ? i : 2 * size - 1 - i;
    case LSF_WRAP_CLAMP:
        break;
    }
    return i < 0 ? 0 : i >= size ? size - 1 : i;
}

static lsf_texel mix(lsf_texel p, lsf_texel q, float t)
{
    return (lsf_texel){p.r + (q.r - p.r) * t, p.g + (q.g - p.g) * t, p.b + (q.b - p.b) * t,
                       p.a + (q.a - p.a) * t};
}

lsf_texel lsf_texture_sample(const lsf_scene *scene, const lsf_texture_slot *slot,
                             const float uv[2])
{
    const lsf_texture *texture = &scene->textures[slot->texture];
    const lsf_texture_image *image = &scene->images[texture->image];
    const float *m = slot->transform;
    double u = (double)m[0] * uv[0] + (double)m[1] * uv[1] + m[2];
    double v = (double)m[3] * uv[0] + (double)m[4] * uv[1] + m[5];
    double x = fold(u, texture->wrap_s) * image->width;
    double y = fold(v, texture->wrap_t) * image->height;
    int64_t width = image->width, height = image->height;
    if (texture->nearest)
        return read_texel(image, wrap_index((int64_t)x, width, texture->wrap_s),
                          wrap_index((int64_t)y, height, texture->wrap_t), texture->srgb);
    double left = floor(x - 0.5), top = floor(y - 0.5);
    float tx = (float)(x - 0.5 - left), ty = (float)(y - 0.5 - top);
    int64_t x0 = wrap_index((int64_t)left, width, texture->wrap_s);
    int64_t x1 = wrap_index((int64_t)left + 1, width, texture->wrap_s);
    int64_t y0 = wrap_index((int64_t)top, height, texture->wrap_t);
    int64_t y1 = wrap_index((int64_t)top + 1, height, texture->wrap_t);
    lsf_texel upper =
        mix(read_texel(image, x0, y0, texture->srgb), read_texel(image, x1, y0, texture->srgb), tx);
    lsf_texel lower =
        mix(read_texel(image, x0, y1, texture->srgb), read_texel(image, x1, y1, texture->srgb), tx);
    return mix(upper, lower, ty);
}
