/* The module lightsheaf-webp: WebP pictures by libwebp, which allocates by nothing but the size
 * that lsf_webp_header_read has checked and the codes that it says a picture may have. */
#include "io/image_module.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <webp/decode.h>

static bool decode(lsf_decoded_image *decoded, const lsf_image_header *header, const void *bytes,
                   size_t length, const char *name, lsf_error *error)
{
    static const char names[] = {'R', 'G', 'B', 'A'};
    memset(decoded, 0, sizeof *decoded);
    uint32_t channels = header->channels;
    size_t stride = (size_t)header->width * channels, size = stride * header->height;
    void *texels = lsf_alloc(size, 1);
    decoded->names = lsf_alloc(channels, LSF_CHANNEL_NAME_SIZE);
    if (!texels || !decoded->names) {
        free(texels);
        free(decoded->names);
        decoded->names = NULL;
        return lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory for %u x %u pixels",
                             name, header->width, header->height);
    }
    const uint8_t *done = channels == 4
                              ? WebPDecodeRGBAInto(bytes, length, texels, size, (int)stride)
                              : WebPDecodeRGBInto(bytes, length, texels, size, (int)stride);
    if (!done) {
        free(texels);
        free(decoded->names);
        decoded->names = NULL;
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: the WebP file is damaged or cut short; save or copy it again",
                             name);
    }
    for (uint32_t c = 0; c < channels; c++)
        decoded->names[c][0] = names[c];
    decoded->width = header->width;
    decoded->height = header->height;
    decoded->channels = channels;
    decoded->type = LSF_TEXEL_U8;
    decoded->texels = texels;
    return true;
}

__attribute__((visibility("default"))) const lsf_webp_module lsf_webp = {decode};
