#include "frame/texture_upload.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "frame/alpha_mipmaps.h"
#include "shared/tonemap.h"

/* How an image is stored. sRGB colour is decoded here, to half floats, which resolve 11 bits at
 * every brightness: GL's own sRGB formats are decoded by an approximation and filtered with 8-bit
 * weights in software, which puts a channel's mean off by up to 0.4 % on a brick wall. */
typedef struct storage {
    GLenum internal_format, type;
    uint32_t channels; /* of the uploaded texels */
    bool decode;       /* sRGB to linear floats here */
} storage;

static storage choose_storage(const lsf_texture_image *image, bool srgb)
{
    uint32_t n = image->channels;
    if (image->type == LSF_TEXEL_F32)
        return (storage){GL_RGBA32F, GL_FLOAT, 4, false};
    if (srgb)
        return (storage){GL_RGBA16F, GL_FLOAT, 4, true};
    bool wide = image->type == LSF_TEXEL_U16;
    GLenum type = wide ? GL_UNSIGNED_SHORT : GL_UNSIGNED_BYTE;
    if (n == 1)
        return (storage){wide ? GL_R16 : GL_R8, type, 1, false};
    if (n == 2)
        return (storage){wide ? GL_RG16 : GL_RG8, type, 2, false};
    return (storage){wide ? GL_RGBA16 : GL_RGBA8, type, 4, false};
}

static uint32_t level_count(uint32_t width, uint32_t height)
{
    uint32_t levels = 1;
    for (uint32_t size = width > height ? width : height; size > 1; size >>= 1)
        levels++;
    return levels;
}

uint32_t lsf_texture_upload_read_by(const lsf_material *m, bool transmission,
                                    lsf_texture_read out[LSF_MATERIAL_TEXTURES])
{
    const lsf_texture_read all[LSF_MATERIAL_TEXTURES] = {
        {LSF_UNIT_BASE_COLOR, &m->base_color_texture, LSF_TEXTURE_MEAN},
        {LSF_UNIT_METALLIC_ROUGHNESS, &m->metallic_roughness_texture, LSF_TEXTURE_FINEST},
        {LSF_UNIT_NORMAL, &m->normal_texture, LSF_TEXTURE_FINEST},
        {LSF_UNIT_EMISSIVE, &m->emissive_texture, LSF_TEXTURE_MEAN},
        {LSF_UNIT_ANISOTROPY, &m->anisotropy_texture, LSF_TEXTURE_FINEST},
        {LSF_UNIT_SPECULAR, &m->specular_texture, LSF_TEXTURE_MEAN},
        {LSF_UNIT_SPECULAR_COLOR, &m->specular_color_texture, LSF_TEXTURE_MEAN},
        {LSF_UNIT_COAT, &m->coat_texture, LSF_TEXTURE_MEAN},
        {LSF_UNIT_COAT_ROUGHNESS, &m->coat_roughness_texture, LSF_TEXTURE_FINEST},
        {LSF_UNIT_COAT_NORMAL, &m->coat_normal_texture, LSF_TEXTURE_FINEST},
        {LSF_UNIT_SHEEN_COLOR, &m->sheen_color_texture, LSF_TEXTURE_MEAN},
        {LSF_UNIT_SHEEN_ROUGHNESS, &m->sheen_roughness_texture, LSF_TEXTURE_FINEST},
        {LSF_UNIT_TRANSMISSION, &m->transmission_texture, LSF_TEXTURE_MEAN}};
    uint32_t count = 0;
    for (size_t i = 0; i < LSF_COUNT(all); i++)
        if (all[i].slot->texture != LSF_NONE &&
            (transmission || all[i].unit != LSF_UNIT_TRANSMISSION))
            out[count++] = all[i];
    return count;
}

/* The index of channel `c` of R, G, B, A in a texel of `channels`; -1: it has none, and alpha is
 * opaque. */
static int source_channel(uint32_t channels, uint32_t c)
{
    if (c == 3)
        return channels == 2 || channels == 4 ? (int)channels - 1 : -1;
    return channels <= 2 ? 0 : (int)c;
}

/* How materials in use read a texture. */
typedef struct texture_use {
    bool used;
    bool filtered; /* some material reads it by lsf_texture_filter LSF_TEXTURE_MEAN */
    bool weighed;  /* its alpha masks or blends some material */
} texture_use;

/* A distinct pair of image and colour space, by one of the textures that need it. */
typedef struct image_use {
    uint32_t texture;
    bool filtered, weighed; /* as above, of any of the textures */
} image_use;

/* Whether alpha and colour are kept as floats, so that mipmaps can weigh one by the other. */
static bool holds_blend_colors(const lsf_scene *scene, const lsf_texture *texture)
{
    const lsf_texture_image *image = &scene->images[texture->image];
    return source_channel(image->channels, 3) >= 0 &&
           choose_storage(image, texture->srgb).type == GL_FLOAT;
}

static void note_uses(texture_use *uses, const lsf_scene *scene, const lsf_plan *plan)
{
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const lsf_material *m =
            &scene->materials[scene->primitives[scene->instances[i].primitive].material];
        lsf_texture_read textures[LSF_MATERIAL_TEXTURES];
        uint32_t count = lsf_texture_upload_read_by(m, plan->transmission, textures);
        for (uint32_t s = 0; s < count; s++) {
            texture_use *use = &uses[textures[s].slot->texture];
            const lsf_texture *texture = &scene->textures[textures[s].slot->texture];
            use->used = true;
            use->filtered |= textures[s].filter == LSF_TEXTURE_MEAN;
            use->weighed |= textures[s].unit == LSF_UNIT_BASE_COLOR &&
                            m->alpha_mode != LSF_ALPHA_OPAQUE && holds_blend_colors(scene, texture);
        }
    }
}

/* Numbers the distinct pairs of image and colour space that materials in use read, and counts them;
 * false without memory. `of` (per scene texture, LSF_NONE when unused; NULL allowed) and `uses`
 * (one for each scene texture suffices) are filled in. */
static bool number_textures(const lsf_scene *scene, const lsf_plan *plan, uint32_t *of,
                            image_use *uses, uint32_t *count)
{
    *count = 0;
    uint32_t *pair_of = lsf_alloc((uint64_t)scene->image_count * 2, sizeof *pair_of);
    texture_use *used = lsf_alloc(scene->texture_count, sizeof *used);
    bool good = pair_of && used;
    if (!good)
        goto done;
    note_uses(used, scene, plan);
    for (uint32_t t = 0; t < scene->texture_count; t++) {
        if (of)
            of[t] = LSF_NONE;
        if (!used[t].used)
            continue;
        uint32_t *pair = &pair_of[2 * scene->textures[t].image + scene->textures[t].srgb];
        if (*pair == 0) {
            uses[*count] = (image_use){.texture = t};
            *pair = ++*count; /* one-based; 0 is "not numbered yet" */
        }
        uses[*pair - 1].filtered |= used[t].filtered;
        uses[*pair - 1].weighed |= used[t].weighed;
        if (of)
            of[t] = *pair - 1;
    }
done:
    free(pair_of);
    free(used);
    return good;
}

static void texture_name(char name[64], uint32_t index)
{
    snprintf(name, 64, "scene.texture.%u", index);
}

void lsf_texture_upload_plan(lsf_plan *plan, const lsf_scene *scene)
{
    image_use *uses = lsf_alloc(scene->texture_count, sizeof *uses);
    uint32_t count = 0;
    if (!uses || !number_textures(scene, plan, NULL, uses, &count))
        plan->failed = true;
    for (uint32_t i = 0; i < count; i++) {
        const lsf_texture *texture = &scene->textures[uses[i].texture];
        const lsf_texture_image *image = &scene->images[texture->image];
        lsf_texture_desc desc = {NULL,
                                 GL_TEXTURE_2D,
                                 choose_storage(image, texture->srgb).internal_format,
                                 image->width,
                                 image->height,
                                 1,
                                 uses[i].filtered ? level_count(image->width, image->height) : 1};
        char name[64];
        texture_name(name, i);
        lsf_plan_texture_desc_add(plan, name, &desc, "%.100s%s", image->name,
                                  texture->srgb ? ", sRGB" : "");
    }
    free(uses);
    if (scene->environment.present && scene->environment.width)
        lsf_plan_texture_add(plan, "scene.environment", GL_RGB32F, scene->environment.width,
                             scene->environment.height, "the environment map, lat-long");
}

/* A channel of a texel; integers are mapped to 0..1. */
static float texel_value(const lsf_texture_image *image, uint64_t index)
{
    if (image->type == LSF_TEXEL_U8)
        return (float)((const uint8_t *)image->texels)[index] / 255.0f;
    if (image->type == LSF_TEXEL_U16)
        return (float)((const uint16_t *)image->texels)[index] / 65535.0f;
    return ((const float *)image->texels)[index];
}

/* RGBA floats, decoded from sRGB where `s.decode`. */
static void convert_to_float(float *out, const lsf_texture_image *image, storage s)
{
    float table[256];
    for (int i = 0; i < 256; i++)
        table[i] = lsf_srgb_decode((float)i / 255.0f);
    uint64_t count = (uint64_t)image->width * image->height;
    for (uint64_t i = 0; i < count; i++)
        for (uint32_t c = 0; c < 4; c++) {
            int from = source_channel(image->channels, c);
            uint64_t at = i * image->channels + (uint32_t)(from < 0 ? 0 : from);
            float value = from < 0 ? 1.0f : texel_value(image, at);
            if (s.decode && c < 3)
                value = image->type == LSF_TEXEL_U8 ? table[((const uint8_t *)image->texels)[at]]
                                                    : lsf_srgb_decode(value);
            out[4 * i + c] = value;
        }
}

/* RGB to RGBA, opaque, keeping the integers of `size` bytes. */
static void convert_to_rgba(uint8_t *out, const lsf_texture_image *image, size_t size)
{
    uint64_t count = (uint64_t)image->width * image->height;
    const uint8_t *in = image->texels;
    for (uint64_t i = 0; i < count; i++) {
        memcpy(out + 4 * size * i, in + 3 * size * i, 3 * size);
        memset(out + 4 * size * i + 3 * size, 0xff, size);
    }
}

/* Texels in a layout that GL takes, where the file's is another; NULL without memory. */
static void *convert_texels(const lsf_texture_image *image, storage s)
{
    size_t size = s.type == GL_FLOAT ? 4 : s.type == GL_UNSIGNED_SHORT ? 2 : 1;
    void *out = lsf_alloc((uint64_t)image->width * image->height, s.channels * size);
    if (out && s.type == GL_FLOAT)
        convert_to_float(out, image, s);
    else if (out)
        convert_to_rgba(out, image, size);
    return out;
}

/* `texels`: level 0, RGBA floats. */
static bool make_alpha_mipmaps(GLuint texture, const float *texels, const lsf_texture_image *image,
                               lsf_error *error)
{
    float *levels = lsf_alpha_mipmaps_create(texels, image->width, image->height);
    if (!levels)
        return lsf_error_set(error, LSF_ERROR_RENDER, "%s: out of memory for its mipmaps",
                             image->name);
    const float *next = levels;
    uint32_t count = level_count(image->width, image->height);
    for (uint32_t i = 1; i < count; i++) {
        uint32_t width = image->width >> i ? image->width >> i : 1;
        uint32_t height = image->height >> i ? image->height >> i : 1;
        glTextureSubImage2D(texture, (GLint)i, 0, 0, (GLsizei)width, (GLsizei)height, GL_RGBA,
                            GL_FLOAT, next);
        next += 4 * (uint64_t)width * height;
    }
    free(levels);
    return true;
}

static bool upload(lsf_scene_gpu *gpu, const lsf_plan *plan, uint32_t index, image_use use,
                   lsf_error *error)
{
    static const GLenum layouts[] = {0, GL_RED, GL_RG, GL_RGB, GL_RGBA};
    const lsf_texture *texture = &gpu->scene->textures[use.texture];
    const lsf_texture_image *image = &gpu->scene->images[texture->image];
    storage s = choose_storage(image, texture->srgb);
    char name[64];
    texture_name(name, index);
    if (!lsf_plan_create_texture(plan, gpu->context, name, &gpu->textures[index], error))
        return false;
    bool direct = s.channels == image->channels && !s.decode;
    void *converted = direct ? NULL : convert_texels(image, s);
    if (!direct && !converted)
        return lsf_error_set(error, LSF_ERROR_RENDER, "%s: out of memory for %ux%u texels",
                             image->name, image->width, image->height);
    const void *texels = direct ? image->texels : converted;
    glTextureSubImage2D(gpu->textures[index], 0, 0, 0, (GLsizei)image->width,
                        (GLsizei)image->height, layouts[s.channels], s.type, texels);
    bool made = !use.weighed || make_alpha_mipmaps(gpu->textures[index], texels, image, error);
    free(converted);
    if (!made)
        return false;
    if (s.channels <= 2) {
        GLint swizzle[] = {GL_RED, GL_RED, GL_RED, s.channels == 2 ? GL_GREEN : GL_ONE};
        glTextureParameteriv(gpu->textures[index], GL_TEXTURE_SWIZZLE_RGBA, swizzle);
    }
    if (use.filtered && !use.weighed)
        glGenerateTextureMipmap(gpu->textures[index]);
    return true;
}

static void fill_environment(lsf_scene_gpu *gpu)
{
    const lsf_environment *environment = &gpu->scene->environment;
    glTextureSubImage2D(gpu->environment, 0, 0, 0, (GLsizei)environment->width,
                        (GLsizei)environment->height, GL_RGB, GL_FLOAT, environment->texels);
    gpu->radiance_edits = gpu->scene->edits.radiance;
}

void lsf_texture_upload_update(lsf_scene_gpu *gpu)
{
    if (gpu->environment && gpu->radiance_edits != gpu->scene->edits.radiance)
        fill_environment(gpu);
}

static bool upload_environment(lsf_scene_gpu *gpu, const lsf_plan *plan, lsf_error *error)
{
    if (!lsf_plan_create_texture_if_planned(plan, gpu->context, "scene.environment",
                                            &gpu->environment, error))
        return false;
    if (!gpu->environment)
        return true;
    fill_environment(gpu);
    glTextureParameteri(gpu->environment, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(gpu->environment, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(gpu->environment, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTextureParameteri(gpu->environment, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return true;
}

enum { LINEAR, NEAREST, POINT, FINEST_LINEAR, FINEST_NEAREST, FILTERS };

static uint32_t sampler_index(const lsf_texture *texture, lsf_texture_filter filter, bool point)
{
    uint32_t wraps = (uint32_t)texture->wrap_s * 3 + (uint32_t)texture->wrap_t;
    int index;
    if (filter == LSF_TEXTURE_FINEST)
        index = point || texture->nearest ? FINEST_NEAREST : FINEST_LINEAR;
    else
        index = point ? POINT : texture->nearest ? NEAREST : LINEAR;
    return wraps * FILTERS + (uint32_t)index;
}

static void create_sampler(lsf_scene_gpu *gpu, const lsf_texture *texture,
                           lsf_texture_filter filter, bool point)
{
    static const GLint wraps[] = {GL_REPEAT, GL_CLAMP_TO_EDGE, GL_MIRRORED_REPEAT};
    static const GLint minified[FILTERS] = {GL_LINEAR_MIPMAP_LINEAR, GL_NEAREST_MIPMAP_LINEAR,
                                            GL_NEAREST_MIPMAP_NEAREST, GL_LINEAR, GL_NEAREST};
    uint32_t index = sampler_index(texture, filter, point);
    GLuint *sampler = &gpu->samplers[index];
    if (*sampler)
        return;
    glCreateSamplers(1, sampler);
    glSamplerParameteri(*sampler, GL_TEXTURE_WRAP_S, wraps[texture->wrap_s]);
    glSamplerParameteri(*sampler, GL_TEXTURE_WRAP_T, wraps[texture->wrap_t]);
    glSamplerParameteri(*sampler, GL_TEXTURE_MAG_FILTER,
                        point || texture->nearest ? GL_NEAREST : GL_LINEAR);
    glSamplerParameteri(*sampler, GL_TEXTURE_MIN_FILTER, minified[index % FILTERS]);
}

static void create_samplers(lsf_scene_gpu *gpu, const lsf_texture *texture)
{
    for (int point = 0; point < 2; point++) {
        create_sampler(gpu, texture, LSF_TEXTURE_MEAN, point != 0);
        create_sampler(gpu, texture, LSF_TEXTURE_FINEST, point != 0);
    }
}

bool lsf_texture_upload_create(lsf_scene_gpu *gpu, const lsf_plan *plan, lsf_error *error)
{
    const lsf_scene *scene = gpu->scene;
    image_use *uses = lsf_alloc(scene->texture_count, sizeof *uses);
    gpu->texture_of = lsf_alloc(scene->texture_count, sizeof *gpu->texture_of);
    gpu->textures = lsf_alloc(scene->texture_count, sizeof *gpu->textures);
    bool ok = uses && gpu->texture_of && gpu->textures &&
              number_textures(scene, plan, gpu->texture_of, uses, &gpu->gl_texture_count);
    if (!ok)
        lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u textures",
                      scene->texture_count);
    for (uint32_t i = 0; ok && i < gpu->gl_texture_count; i++)
        ok = upload(gpu, plan, i, uses[i], error);
    for (uint32_t t = 0; ok && t < scene->texture_count; t++)
        if (gpu->texture_of[t] != LSF_NONE)
            create_samplers(gpu, &scene->textures[t]);
    free(uses);
    return ok && upload_environment(gpu, plan, error);
}

void lsf_texture_upload_destroy(lsf_scene_gpu *gpu)
{
    for (uint32_t i = 0; gpu->textures && i < gpu->gl_texture_count; i++)
        lsf_texture_destroy(gpu->context, &gpu->textures[i]);
    lsf_texture_destroy(gpu->context, &gpu->environment);
    glDeleteSamplers(LSF_COUNT(gpu->samplers), gpu->samplers);
    free(gpu->textures);
    free(gpu->texture_of);
}

GLuint lsf_texture_upload_sampler(const lsf_scene_gpu *gpu, uint32_t texture,
                                  lsf_texture_filter filter, bool point)
{
    return gpu->samplers[sampler_index(&gpu->scene->textures[texture], filter, point)];
}

void lsf_texture_upload_set_lod_bias(const lsf_scene_gpu *gpu, float bias)
{
    for (size_t i = 0; i < LSF_COUNT(gpu->samplers); i++)
        if (gpu->samplers[i])
            glSamplerParameterf(gpu->samplers[i], GL_TEXTURE_LOD_BIAS, bias);
}
