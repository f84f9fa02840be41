#include "io/image_module.h"
#include "io/io.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef bool decode_function(lsf_decoded_image *decoded, const lsf_image_header *header,
                             const void *bytes, size_t length, const char *name, lsf_error *error);

static size_t (*const without_metadata[])(uint8_t *bytes, size_t length) = {
    [LSF_IMAGE_FILE_PNG] = lsf_png_without_metadata,
    [LSF_IMAGE_FILE_JPEG] = lsf_jpeg_without_metadata,
    [LSF_IMAGE_FILE_WEBP] = lsf_webp_without_metadata,
};

/* Decodes a copy without metadata where the kind of file has any that a library would read. */
static bool decode_pixels(decode_function *decode, lsf_decoded_image *decoded,
                          const lsf_image_header *header, const void *bytes, size_t length,
                          const char *name, lsf_error *error)
{
    if (!without_metadata[header->file])
        return decode(decoded, header, bytes, length, name, error);
    uint8_t *copy = lsf_alloc(length, 1);
    if (!copy)
        return lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory for its %zu bytes", name,
                             length);
    memcpy(copy, bytes, length);
    length = without_metadata[header->file](copy, length);
    bool decoded_well = decode(decoded, header, copy, length, name, error);
    free(copy);
    return decoded_well;
}

static bool decode_file(lsf_decoded_image *decoded, lsf_image_header *header, const void *bytes,
                        size_t length, uint64_t byte_limit, const char *name, lsf_error *error)
{
    if (!lsf_image_header_read(header, bytes, length, byte_limit, name, error))
        return false;
    lsf_error cause;
    const lsf_webp_module *webp = NULL;
    const lsf_image_module *others = NULL;
    if (header->file == LSF_IMAGE_FILE_WEBP)
        webp = lsf_webp_module_get(&cause);
    else
        others = lsf_image_module_get(&cause);
    if (!webp && !others)
        return lsf_error_set(error, cause.code, "%s: cannot be read: %s", name, cause.message);
    return decode_pixels(webp ? webp->decode : others->decode, decoded, header, bytes, length, name,
                         error);
}

static void release(lsf_decoded_image *decoded)
{
    free(decoded->texels);
    free(decoded->names);
}

static int find_name(const lsf_decoded_image *decoded, const char *name)
{
    for (uint32_t c = 0; c < decoded->channels; c++)
        if (strcmp(decoded->names[c], name) == 0)
            return (int)c;
    return -1;
}

/* IEC 61966-2-1, in double precision. */
static double srgb_to_linear(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

/* Grey, grey and alpha, RGB or RGBA integers to linear R, G, B and alpha. */
static lsf_image *linear_from_integers(const lsf_decoded_image *decoded, lsf_error *error)
{
    static const char *const names[] = {"R", "G", "B", "A"};
    uint32_t colours = decoded->channels >= 3 ? 3 : 1;
    bool alpha = decoded->channels > colours;
    uint32_t code_count = decoded->type == LSF_TEXEL_U8 ? 256 : 65536;
    float *linear = lsf_alloc(code_count, sizeof *linear);
    lsf_image *image =
        lsf_image_create(decoded->width, decoded->height, alpha ? 4 : 3, names, error);
    if (!linear || !image) {
        free(linear);
        lsf_image_destroy(image);
        if (!linear)
            lsf_error_set(error, LSF_ERROR_RENDER, "not enough memory");
        return NULL;
    }
    for (uint32_t code = 0; code < code_count; code++)
        linear[code] = (float)srgb_to_linear(code / (double)(code_count - 1));

    const uint8_t *bytes = decoded->texels;
    const uint16_t *words = decoded->texels;
    uint64_t pixels = (uint64_t)decoded->width * decoded->height;
    for (uint64_t i = 0; i < pixels; i++) {
        float *pixel = image->pixels + i * image->channel_count;
        for (uint32_t c = 0; c < image->channel_count; c++) {
            uint32_t source = c == 3 ? decoded->channels - 1 : colours == 1 ? 0 : c;
            uint64_t at = i * decoded->channels + source;
            uint32_t code = decoded->type == LSF_TEXEL_U8 ? bytes[at] : words[at];
            pixel[c] = c == 3 ? (float)code / (float)(code_count - 1) : linear[code];
        }
    }
    free(linear);
    return image;
}

#define FLOATS_TOO_LARGE                                                                           \
    "%s: %u x %u pixels as floats are more than the memory limit leaves; raise the limit or "      \
    "scale "                                                                                       \
    "the image down"

static lsf_image *image_from_memory(const void *bytes, size_t length, uint64_t byte_limit,
                                    const char *name, lsf_error *error)
{
    lsf_image_header header;
    lsf_decoded_image decoded;
    if (!decode_file(&decoded, &header, bytes, length, byte_limit, name, error))
        return NULL;
    if (decoded.type != LSF_TEXEL_F32) {
        uint64_t pixels = (uint64_t)decoded.width * decoded.height;
        uint64_t encoded_bytes = pixels * decoded.channels * (decoded.type == LSF_TEXEL_U8 ? 1 : 2);
        lsf_image *image = NULL;
        if (pixels * 4 * sizeof(float) > byte_limit - encoded_bytes)
            lsf_error_set(error, LSF_ERROR_FILE, FLOATS_TOO_LARGE, name, decoded.width,
                          decoded.height);
        else
            image = linear_from_integers(&decoded, error);
        release(&decoded);
        return image;
    }
    lsf_image *image = lsf_image_create(0, 0, 0, NULL, error);
    if (!image) {
        release(&decoded);
        return NULL;
    }
    free(image->channel_names);
    free(image->pixels);
    *image = (lsf_image){.width = decoded.width,
                         .height = decoded.height,
                         .channel_count = decoded.channels,
                         .channel_names = decoded.names,
                         .pixels = decoded.texels};
    return image;
}

static lsf_image *image_from_file(const char *path, uint64_t byte_limit, lsf_error *error)
{
    uint64_t file_limit = byte_limit < LSF_IMAGE_MAX_BYTES ? byte_limit : LSF_IMAGE_MAX_BYTES;
    size_t length;
    char *bytes = lsf_file_read(path, file_limit, &length, error);
    if (!bytes)
        return NULL;
    lsf_image *image = image_from_memory(bytes, length, byte_limit - length, path, error);
    free(bytes);
    return image;
}

lsf_image *lsf_image_load(const char *path, lsf_error *error)
{
    if (!lsf_given(path, "path", error))
        return NULL;
    return image_from_file(path, UINT64_MAX, error);
}

static void *shrink(void *array, size_t bytes)
{
    void *moved = realloc(array, bytes);
    return moved ? moved : array;
}

/* Keeps the channels that make a colour, in the order R, G, B, A (or Y, A). */
static bool keep_colour_channels(lsf_decoded_image *decoded, const char *name, lsf_error *error)
{
    static const char *const wanted[2][4] = {{"R", "G", "B", "A"}, {"Y", "A", "", ""}};
    int picked[4] = {0};
    uint32_t count = 0;
    for (int set = 0; set < 2 && count == 0; set++) {
        uint32_t needed = set == 0 ? 3 : 1;
        while (count < needed + 1 && (picked[count] = find_name(decoded, wanted[set][count])) >= 0)
            count++;
        if (count < needed)
            count = 0;
    }
    if (count == 0)
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: the image has neither channels R, G, B nor Y; its first is "
                             "\"%s\"; rename its channels",
                             name, decoded->names[0]);
    float *texels = decoded->texels;
    uint64_t pixels = (uint64_t)decoded->width * decoded->height;
    for (uint64_t i = 0; i < pixels; i++) {
        float kept[4];
        for (uint32_t c = 0; c < count; c++)
            kept[c] = texels[i * decoded->channels + (uint32_t)picked[c]];
        memcpy(texels + i * count, kept, count * sizeof *kept);
    }
    decoded->channels = count;
    decoded->texels = shrink(texels, pixels * count * sizeof *texels);
    return true;
}

/* Sets values that `keep_negative` or their finiteness forbids to 0 and counts them. */
static uint64_t repair(float *values, uint64_t count, bool keep_negative)
{
    uint64_t repaired = 0;
    for (uint64_t i = 0; i < count; i++) {
        if (isfinite(values[i]) && (keep_negative || values[i] >= 0.0f))
            continue;
        values[i] = 0.0f;
        repaired++;
    }
    return repaired;
}

bool lsf_texture_image_decode(lsf_texture_image *image, const void *bytes, size_t length,
                              uint64_t byte_limit, const char *name, lsf_error *error)
{
    lsf_image_header header;
    lsf_decoded_image decoded;
    if (!decode_file(&decoded, &header, bytes, length, byte_limit, name, error))
        return false;
    if (header.file == LSF_IMAGE_FILE_EXR && !keep_colour_channels(&decoded, name, error)) {
        release(&decoded);
        return false;
    }
    free(decoded.names);
    image->width = decoded.width;
    image->height = decoded.height;
    image->channels = decoded.channels;
    image->type = decoded.type;
    image->texels = decoded.texels;
    image->non_finite = 0;
    if (image->type == LSF_TEXEL_F32)
        image->non_finite =
            repair(image->texels, (uint64_t)image->width * image->height * image->channels, true);
    return true;
}

/* Three channels of the image, packed; in place where it has as many, which leaves it without
 * pixels. NULL without memory. */
static float *take_channels(lsf_image *image, const int channels[3])
{
    uint64_t pixels = (uint64_t)image->width * image->height;
    bool in_place = image->channel_count >= 3;
    float *taken = in_place ? image->pixels : lsf_alloc(pixels, 3 * sizeof *taken);
    if (!taken)
        return NULL;
    for (uint64_t i = 0; i < pixels; i++) {
        const float *pixel = image->pixels + i * image->channel_count;
        float rgb[3] = {pixel[channels[0]], pixel[channels[1]], pixel[channels[2]]};
        memcpy(taken + 3 * i, rgb, sizeof rgb);
    }
    if (!in_place)
        return taken;
    image->pixels = NULL;
    return shrink(taken, pixels * 3 * sizeof *taken);
}

bool lsf_environment_load(lsf_environment *environment, const char *path, uint64_t byte_limit,
                          uint64_t *repaired, lsf_error *error)
{
    lsf_image *image = image_from_file(path, byte_limit, error);
    if (!image)
        return false;
    int channels[3] = {lsf_image_channel(image, "R"), lsf_image_channel(image, "G"),
                       lsf_image_channel(image, "B")};
    bool colour = channels[0] >= 0 && channels[1] >= 0 && channels[2] >= 0;
    if (!colour)
        channels[0] = channels[1] = channels[2] = lsf_image_channel(image, "Y");
    uint64_t pixels = (uint64_t)image->width * image->height;
    float *texels = NULL;
    if (channels[0] < 0)
        lsf_error_set(error, LSF_ERROR_FILE,
                      "%s: an environment needs channels R, G, B or Y; the first here is \"%s\"",
                      path, image->channel_names[0]);
    else if (image->channel_count < 3 &&
             pixels * (3 + image->channel_count) * sizeof *texels > byte_limit)
        lsf_error_set(error, LSF_ERROR_FILE, FLOATS_TOO_LARGE, path, image->width, image->height);
    else if (!(texels = take_channels(image, channels)))
        lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory for %u x %u pixels", path,
                      image->width, image->height);
    if (!texels) {
        lsf_image_destroy(image);
        return false;
    }
    *repaired = repair(texels, 3 * pixels, false);
    environment->present = true;
    environment->width = image->width;
    environment->height = image->height;
    environment->texels = texels;
    lsf_image_destroy(image);
    return true;
}
