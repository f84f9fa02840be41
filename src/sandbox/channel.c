#include "sandbox/channel.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include <lightsheaf/image.h>

#define NOISE_SIDE 256
#define CUBE_FACES 6

/* --- what is said of it --- */

typedef struct word_choice {
    const char *word;
    GLenum wrap, filter, shrink;
} word_choice;

static const word_choice choices[] = {
    {"wrap=repeat", GL_REPEAT, 0, 0},
    {"wrap=clamp", GL_CLAMP_TO_EDGE, 0, 0},
    {"wrap=mirror", GL_MIRRORED_REPEAT, 0, 0},
    {"filter=nearest", 0, GL_NEAREST, GL_NEAREST},
    {"filter=linear", 0, GL_LINEAR, GL_LINEAR},
    {"filter=mipmap", 0, GL_LINEAR, GL_LINEAR_MIPMAP_LINEAR},
};

static bool take_choice(lsf_sandbox_channel *channel, const char *word)
{
    if (strcmp(word, "flip=no") == 0) {
        channel->flip = false;
        return true;
    }
    for (size_t i = 0; i < LSF_COUNT(choices); i++) {
        if (strcmp(choices[i].word, word) != 0)
            continue;
        if (choices[i].wrap)
            channel->wrap = choices[i].wrap;
        if (choices[i].filter) {
            channel->filter = choices[i].filter;
            channel->shrink = choices[i].shrink;
            channel->mipmap = channel->shrink == GL_LINEAR_MIPMAP_LINEAR;
        }
        return true;
    }
    return false;
}

static void set_defaults(lsf_sandbox_channel *channel, lsf_sandbox_source source)
{
    bool picture = source == LSF_SOURCE_FILE || source == LSF_SOURCE_NOISE;
    channel->source = source;
    channel->flip = true;
    channel->mipmap = picture || source == LSF_SOURCE_CUBE;
    channel->wrap = picture ? GL_REPEAT : GL_CLAMP_TO_EDGE;
    channel->filter = source == LSF_SOURCE_KEYBOARD ? GL_NEAREST : GL_LINEAR;
    channel->shrink = channel->mipmap ? GL_LINEAR_MIPMAP_LINEAR : channel->filter;
}

/* The first word. */
static bool take_source(lsf_sandbox_channel *channel, const char *word, const char *folder)
{
    static const struct {
        const char *word;
        lsf_sandbox_source source;
    } words[] = {{"previous", LSF_SOURCE_PREVIOUS},
                 {"keyboard", LSF_SOURCE_KEYBOARD},
                 {"noise", LSF_SOURCE_NOISE}};
    for (size_t i = 0; i < LSF_COUNT(words); i++)
        if (strcmp(words[i].word, word) == 0) {
            set_defaults(channel, words[i].source);
            return true;
        }
    if (word[0] >= 'a' && word[0] <= 'd' && word[1] == '\0') {
        set_defaults(channel, LSF_SOURCE_BUFFER);
        channel->buffer = (uint32_t)(word[0] - 'a');
        return true;
    }
    set_defaults(channel, LSF_SOURCE_FILE);
    channel->path = word[0] == '/' ? strdup(word) : lsf_format("%s/%s", folder, word);
    return channel->path != NULL;
}

bool lsf_sandbox_channel_parse(lsf_sandbox_channel *channel, const char *source, const char *folder,
                               const char *location, lsf_error *error)
{
    *channel = (lsf_sandbox_channel){0};
    char *copy = strdup(source), *rest = NULL;
    char *word = copy ? strtok_r(copy, " \t\r", &rest) : NULL;
    bool cube = word && strcmp(word, "cube") == 0;
    if (cube)
        word = strtok_r(NULL, " \t\r", &rest);
    bool good = word && take_source(channel, word, folder);
    if (!good)
        lsf_error_set(error, LSF_ERROR_USAGE,
                      "%s: name a channel's source: a file, a, b, c, d, "
                      "previous, keyboard, noise, or cube and a file",
                      location);
    if (good && cube && channel->source == LSF_SOURCE_FILE)
        set_defaults(channel, LSF_SOURCE_CUBE);
    while (good && (word = strtok_r(NULL, " \t\r", &rest))) {
        good = take_choice(channel, word);
        if (!good)
            lsf_error_set(error, LSF_ERROR_USAGE,
                          "%s: %s: expected wrap=repeat, clamp or mirror, filter=nearest, linear "
                          "or mipmap, or flip=no",
                          location, word);
    }
    bool kept = channel->source == LSF_SOURCE_BUFFER || channel->source == LSF_SOURCE_PREVIOUS;
    if (good && kept && channel->mipmap)
        good = lsf_error_set(error, LSF_ERROR_USAGE,
                             "%s: filter=mipmap is for pictures; take filter=linear", location);
    free(copy);
    return good;
}

/* --- its texture --- */

static uint32_t levels_of(uint32_t width, uint32_t height)
{
    uint32_t levels = 1;
    for (uint32_t side = width > height ? width : height; side > 1; side /= 2)
        levels++;
    return levels;
}

static bool create_texture(lsf_sandbox_channel *channel, lsf_context *context, GLenum format,
                           lsf_error *error)
{
    bool cube = channel->source == LSF_SOURCE_CUBE;
    const lsf_texture_desc desc = {
        .label = channel->path ? channel->path : "sandbox.noise",
        .target = cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D,
        .internal_format = format,
        .width = channel->width,
        .height = channel->height,
        .depth = cube ? CUBE_FACES : 1,
        .levels = channel->mipmap ? levels_of(channel->width, channel->height) : 1};
    channel->texture = lsf_texture_create(context, &desc, error);
    return channel->texture != 0;
}

static bool make_noise(lsf_sandbox_channel *channel, lsf_context *context, lsf_error *error)
{
    uint8_t *texels = lsf_alloc((uint64_t)NOISE_SIDE * NOISE_SIDE, 4);
    channel->width = channel->height = NOISE_SIDE;
    bool good = texels || lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for noise");
    for (uint32_t i = 0; good && i < NOISE_SIDE * NOISE_SIDE; i++) {
        uint32_t bits = lsf_hash(0, i);
        memcpy(texels + 4 * (size_t)i, &bits, 4);
    }
    good = good && create_texture(channel, context, GL_RGBA8, error);
    if (good)
        glTextureSubImage2D(channel->texture, 0, 0, 0, NOISE_SIDE, NOISE_SIDE, GL_RGBA,
                            GL_UNSIGNED_BYTE, texels);
    free(texels);
    return good;
}

/* Files of 8 bits give shaders their code values, as they were before they were read. */
static float code_value(float linear)
{
    float c = fminf(fmaxf(linear, 0.0f), 1.0f);
    return c <= 0.0031308f ? 12.92f * c : 1.055f * powf(c, 1.0f / 2.4f) - 0.055f;
}

/* R, G, B and A of each pixel, from the row that a texture has first. */
static float *texels_of(const lsf_image *image, bool encode, bool flip)
{
    uint64_t pixels = (uint64_t)image->width * image->height;
    float *texels = lsf_alloc(pixels, 4 * sizeof *texels);
    int at[4] = {lsf_image_channel(image, "R"), lsf_image_channel(image, "G"),
                 lsf_image_channel(image, "B"), lsf_image_channel(image, "A")};
    for (int c = 0; c < 3; c++)
        at[c] = at[c] < 0 ? 0 : at[c];
    for (uint64_t i = 0; texels && i < pixels; i++) {
        uint64_t x = i % image->width, y = i / image->width;
        uint64_t row = flip ? image->height - 1 - y : y;
        const float *from = image->pixels + (row * image->width + x) * image->channel_count;
        for (int c = 0; c < 3; c++)
            texels[4 * i + (uint64_t)c] = encode ? code_value(from[at[c]]) : from[at[c]];
        texels[4 * i + 3] = at[3] < 0 ? 1.0f : from[at[3]];
    }
    return texels;
}

/* Formats that hold radiance hold it as it is. */
static bool holds_radiance(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && (strcmp(dot, ".exr") == 0 || strcmp(dot, ".hdr") == 0);
}

static bool bad_file(const char *location, const lsf_error *reason, lsf_error *error)
{
    return lsf_error_set(error, reason->code, "%.500s: %.3000s", location, reason->message);
}

static bool load_file(lsf_sandbox_channel *channel, lsf_context *context, const char *location,
                      lsf_error *error)
{
    lsf_error reason = {0};
    bool radiance = holds_radiance(channel->path);
    lsf_image *image = lsf_image_load(channel->path, &reason);
    if (!image)
        return bad_file(location, &reason, error);
    float *texels = texels_of(image, !radiance, channel->flip);
    channel->width = image->width;
    channel->height = image->height;
    bool good = texels || lsf_error_set(error, LSF_ERROR_RENDER, "%s: out of memory", location);
    if (good && !create_texture(channel, context, radiance ? GL_RGBA32F : GL_RGBA8, &reason))
        good = bad_file(location, &reason, error);
    if (good)
        glTextureSubImage2D(channel->texture, 0, 0, 0, (GLsizei)image->width,
                            (GLsizei)image->height, GL_RGBA, GL_FLOAT, texels);
    free(texels);
    lsf_image_destroy(image);
    return good;
}

/* --- cube maps --- */

/* Direction of a texel's centre, by the axes of OpenGL 4.5, table 8.19. */
static void face_direction(uint32_t face, uint32_t x, uint32_t y, uint32_t side, double d[3])
{
    double s = (2.0 * x + 1.0) / side - 1.0, t = (2.0 * y + 1.0) / side - 1.0;
    const double directions[CUBE_FACES][3] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t},
                                              {s, -1, -t}, {s, -t, 1},  {-s, -t, -1}};
    memcpy(d, directions[face], sizeof directions[face]);
}

/* Of a latitude-longitude picture, u = 0.5 + atan2(z, x) / 2 pi and the zenith on top, between its
 * four nearest texels. */
static void look_up(const float *texels, uint32_t width, uint32_t height, const double d[3],
                    float result[4])
{
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    double u = 0.5 + atan2(d[2], d[0]) / (2.0 * M_PI), v = acos(d[1] / length) / M_PI;
    double x = u * width - 0.5, y = v * height - 0.5;
    double fx = x - floor(x), fy = y - floor(y);
    memset(result, 0, 4 * sizeof *result);
    for (int k = 0; k < 4; k++) {
        int64_t column = ((int64_t)floor(x) + (k & 1) + width) % width;
        int64_t row = (int64_t)floor(y) + (k >> 1);
        row = row < 0 ? 0 : row >= height ? height - 1 : row;
        double weight = (k & 1 ? fx : 1.0 - fx) * (k >> 1 ? fy : 1.0 - fy);
        const float *texel = texels + 4 * (row * width + column);
        for (int c = 0; c < 4; c++)
            result[c] += (float)weight * texel[c];
    }
}

static bool upload_face(const lsf_sandbox_channel *channel, uint32_t face, const float *texels)
{
    glTextureSubImage3D(channel->texture, 0, 0, 0, (GLint)face, (GLsizei)channel->width,
                        (GLsizei)channel->height, 1, GL_RGBA, GL_FLOAT, texels);
    return true;
}

static bool resample(lsf_sandbox_channel *channel, lsf_context *context, const lsf_image *image,
                     const char *location, lsf_error *error)
{
    bool radiance = holds_radiance(channel->path);
    uint32_t side = image->height / 2 > 0 ? image->height / 2 : 1;
    float *from = texels_of(image, !radiance, false);
    float *texels = lsf_alloc((uint64_t)side * side, 4 * sizeof *texels);
    bool good =
        (from && texels) || lsf_error_set(error, LSF_ERROR_RENDER, "%s: out of memory", location);
    channel->width = channel->height = side;
    good = good && create_texture(channel, context, GL_RGBA32F, error);
    for (uint32_t face = 0; good && face < CUBE_FACES; face++) {
        for (uint32_t i = 0; i < side * side; i++) {
            double d[3];
            face_direction(face, i % side, i / side, side, d);
            look_up(from, image->width, image->height, d, texels + 4 * (size_t)i);
        }
        upload_face(channel, face, texels);
    }
    free(from);
    free(texels);
    return good;
}

static bool load_faces(lsf_sandbox_channel *channel, lsf_context *context, const char *location,
                       lsf_error *error)
{
    static const char *const names[CUBE_FACES] = {"px", "nx", "py", "ny", "pz", "nz"};
    const char *mark = strstr(channel->path, "%s");
    bool good = true;
    for (uint32_t face = 0; good && face < CUBE_FACES; face++) {
        lsf_error reason = {0};
        char *path = lsf_format("%.*s%s%s", (int)(mark - channel->path), channel->path, names[face],
                                mark + 2);
        lsf_image *image = path ? lsf_image_load(path, &reason) : NULL;
        good = image || bad_file(location, &reason, error);
        if (good && face == 0) {
            channel->width = channel->height = image->width;
            good = create_texture(channel, context, GL_RGBA32F, error);
        }
        if (good && (image->width != channel->width || image->height != channel->width))
            good = lsf_error_set(error, LSF_ERROR_FILE,
                                 "%s: %s is %ux%u; all six faces have to be squares of one size",
                                 location, path, image->width, image->height);
        float *texels = good ? texels_of(image, !holds_radiance(path), false) : NULL;
        good = good && (texels ? upload_face(channel, face, texels)
                               : lsf_error_set(error, LSF_ERROR_RENDER, "out of memory"));
        free(texels);
        free(path);
        lsf_image_destroy(image);
    }
    return good;
}

static bool load_cube(lsf_sandbox_channel *channel, lsf_context *context, const char *location,
                      lsf_error *error)
{
    lsf_error reason = {0};
    if (strstr(channel->path, "%s"))
        return load_faces(channel, context, location, error);
    lsf_image *image = lsf_image_load(channel->path, &reason);
    bool good = image ? resample(channel, context, image, location, error)
                      : bad_file(location, &reason, error);
    lsf_image_destroy(image);
    return good;
}

/* --- */

static bool same(const lsf_sandbox_channel *a, const lsf_sandbox_channel *b)
{
    bool paths = a->path && b->path ? strcmp(a->path, b->path) == 0 : a->path == b->path;
    return b->texture && !b->lent && paths && a->source == b->source && a->mipmap == b->mipmap &&
           a->flip == b->flip && memcmp(&a->stamp, &b->stamp, sizeof a->stamp) == 0;
}

bool lsf_sandbox_channel_load(lsf_sandbox_channel *channel, lsf_context *context,
                              lsf_sandbox_channel *before, uint32_t before_count,
                              const char *location, lsf_error *error)
{
    if (channel->source < LSF_SOURCE_NOISE)
        return true;
    channel->stamp = lsf_sandbox_stamp_of(channel->path);
    for (uint32_t i = 0; i < before_count; i++)
        if (same(channel, &before[i])) {
            channel->texture = before[i].texture;
            channel->width = before[i].width;
            channel->height = before[i].height;
            channel->from = &before[i];
            before[i].lent = true;
            return true;
        }
    bool good = channel->source == LSF_SOURCE_NOISE  ? make_noise(channel, context, error)
                : channel->source == LSF_SOURCE_CUBE ? load_cube(channel, context, location, error)
                                                     : load_file(channel, context, location, error);
    if (good && channel->mipmap)
        glGenerateTextureMipmap(channel->texture);
    if (good)
        lsf_sandbox_channel_set_filter(channel, channel->texture);
    return good;
}

void lsf_sandbox_channel_set_filter(const lsf_sandbox_channel *channel, GLuint texture)
{
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, (GLint)channel->filter);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, (GLint)channel->shrink);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, (GLint)channel->wrap);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, (GLint)channel->wrap);
}

void lsf_sandbox_channel_keep(lsf_sandbox_channel *channel)
{
    if (!channel->from)
        return;
    channel->from->texture = 0;
    channel->from = NULL;
    lsf_sandbox_channel_set_filter(channel, channel->texture);
}

void lsf_sandbox_channel_finish(lsf_sandbox_channel *channel, lsf_context *context)
{
    if (channel->from)
        channel->from->lent = false;
    else if (channel->texture)
        lsf_texture_destroy(context, &channel->texture);
    free(channel->path);
    *channel = (lsf_sandbox_channel){0};
}
