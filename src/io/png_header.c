#include "io/image_header.h"

#include <string.h>

/* The layout is that of the PNG specification (ISO/IEC 15948), sections 5 and 11: a signature, then
 * chunks of length, type, data and CRC. */

/* Deflate codes at most 258 bytes in 2 bits. */
#define DEFLATE_RATIO_MAX 1032

enum { SIGNATURE_BYTES = 8, CHUNK_FRAME_BYTES = 12 };

static uint32_t read_u32(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

static bool cut(const char *name, lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_FILE,
                         "%s: the PNG file ends too early or is damaged; save or copy it again",
                         name);
}

static bool damaged(const char *name, const char *what, lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_FILE, "%s: damaged PNG file: %s; save or copy it again",
                         name, what);
}

static bool is_type(const uint8_t *chunk, const char *type)
{
    return memcmp(chunk + 4, type, 4) == 0;
}

bool lsf_png_header_read(lsf_image_header *header, const uint8_t *bytes, size_t length,
                         uint64_t *pixels_max, const char *name, lsf_error *error)
{
    enum { GREY = 0, RGB = 2, PALETTE = 3, GREY_ALPHA = 4, RGBA = 6 };
    if (length < 33 || read_u32(bytes + 8) != 13 || !is_type(bytes + SIGNATURE_BYTES, "IHDR"))
        return cut(name, error);
    header->width = read_u32(bytes + 16);
    header->height = read_u32(bytes + 20);
    uint32_t depth = bytes[24], colour = bytes[25];
    header->type = depth == 16 ? LSF_TEXEL_U16 : LSF_TEXEL_U8;
    if (colour != GREY && colour != RGB && colour != PALETTE && colour != GREY_ALPHA &&
        colour != RGBA)
        return damaged(name, "unknown colour type", error);
    if (depth != 1 && depth != 2 && depth != 4 && depth != 8 && depth != 16)
        return damaged(name, "unknown bit depth", error);

    bool data = false, end = false, transparent = false;
    for (size_t at = SIGNATURE_BYTES; !end && at + CHUNK_FRAME_BYTES <= length;) {
        const uint8_t *chunk = bytes + at;
        uint64_t size = read_u32(chunk);
        if (size > length - at - CHUNK_FRAME_BYTES)
            return cut(name, error);
        data |= is_type(chunk, "IDAT");
        end = is_type(chunk, "IEND");
        transparent |= is_type(chunk, "tRNS");
        at += (size_t)size + CHUNK_FRAME_BYTES;
    }
    if (!data || !end)
        return cut(name, error);

    uint32_t stored = colour == RGB ? 3 : colour == GREY_ALPHA ? 2 : colour == RGBA ? 4 : 1;
    header->channels = colour == PALETTE ? 3 : stored;
    if (transparent && (colour == GREY || colour == RGB || colour == PALETTE))
        header->channels++;
    *pixels_max = (uint64_t)length * DEFLATE_RATIO_MAX * 8 / (stored * depth);
    /* OpenImageIO keeps interlaced pictures whole; a row is small. */
    uint64_t pixel_bytes = header->channels * (depth == 16 ? 2u : 1u);
    if (bytes[28] != 0)
        header->working_bytes = (uint64_t)header->width * header->height * pixel_bytes;
    return true;
}

/* Chunks that a decoder needs have a capital first letter; of the others only tRNS changes
 * pixels. */
size_t lsf_png_without_metadata(uint8_t *bytes, size_t length)
{
    enum { ANCILLARY = 0x20 };
    size_t kept = SIGNATURE_BYTES;
    bool end = false;
    for (size_t at = kept; !end && at + CHUNK_FRAME_BYTES <= length;) {
        size_t size = (size_t)read_u32(bytes + at) + CHUNK_FRAME_BYTES;
        end = is_type(bytes + at, "IEND");
        if (!(bytes[at + 4] & ANCILLARY) || is_type(bytes + at, "tRNS")) {
            memmove(bytes + kept, bytes + at, size);
            kept += size;
        }
        at += size;
    }
    return kept;
}

bool lsf_png_next_text(const uint8_t *bytes, size_t length, size_t *at, lsf_header_text *text)
{
    for (size_t offset = *at ? *at : SIGNATURE_BYTES; offset + CHUNK_FRAME_BYTES <= length;) {
        const uint8_t *chunk = bytes + offset;
        size_t size = read_u32(chunk);
        const uint8_t *key = chunk + 8;
        const uint8_t *end = size > 0 ? memchr(key, 0, size) : NULL;
        offset += size + CHUNK_FRAME_BYTES;
        if (is_type(chunk, "IEND"))
            break;
        if (!is_type(chunk, "tEXt") || !end)
            continue;
        *at = offset;
        *text = (lsf_header_text){(const char *)key, (const char *)end + 1,
                                  size - (size_t)(end - key) - 1};
        return true;
    }
    return false;
}
