#include "io/image_header.h"
#include "io/io.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Deflate codes at most 258 bytes in 2 bits. */
#define DEFLATE_RATIO_MAX 1032

static uint32_t read_u32(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

static uint32_t read_u16(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] << 8 | bytes[1];
}

static bool cut(const char *name, const char *kind, lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_FILE,
                         "%s: the %s file ends too early or is damaged; save or copy it again",
                         name, kind);
}

static bool damaged(const char *name, const char *kind, const char *what, lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_FILE, "%s: damaged %s file: %s; save or copy it again",
                         name, kind, what);
}

/* PNG specification (ISO/IEC 15948), sections 5 and 11. */
static bool read_png(lsf_image_header *header, const uint8_t *bytes, size_t length,
                     uint64_t *pixels_max, const char *name, lsf_error *error)
{
    enum { GREY = 0, RGB = 2, PALETTE = 3, GREY_ALPHA = 4, RGBA = 6 };
    if (length < 33 || read_u32(bytes + 8) != 13 || memcmp(bytes + 12, "IHDR", 4) != 0)
        return cut(name, "PNG", error);
    header->width = read_u32(bytes + 16);
    header->height = read_u32(bytes + 20);
    uint32_t depth = bytes[24], colour = bytes[25];
    header->type = depth == 16 ? LSF_TEXEL_U16 : LSF_TEXEL_U8;
    if (colour != GREY && colour != RGB && colour != PALETTE && colour != GREY_ALPHA &&
        colour != RGBA)
        return damaged(name, "PNG", "unknown colour type", error);
    if (depth != 1 && depth != 2 && depth != 4 && depth != 8 && depth != 16)
        return damaged(name, "PNG", "unknown bit depth", error);

    bool data = false, end = false, transparent = false;
    for (size_t at = 8; !end && at + 12 <= length;) {
        uint64_t size = read_u32(bytes + at);
        if (size > length - at - 12)
            return cut(name, "PNG", error);
        data |= memcmp(bytes + at + 4, "IDAT", 4) == 0;
        end = memcmp(bytes + at + 4, "IEND", 4) == 0;
        transparent |= memcmp(bytes + at + 4, "tRNS", 4) == 0;
        at += (size_t)size + 12;
    }
    if (!data || !end)
        return cut(name, "PNG", error);

    uint32_t stored = colour == RGB ? 3 : colour == GREY_ALPHA ? 2 : colour == RGBA ? 4 : 1;
    header->channels = colour == PALETTE ? 3 : stored;
    if (transparent && (colour == GREY || colour == RGB || colour == PALETTE))
        header->channels++;
    *pixels_max = (uint64_t)length * DEFLATE_RATIO_MAX * 8 / (stored * depth);
    return true;
}

/* Walks the markers of a JPEG (ITU-T T.81, annex B) to its end. */
static bool read_jpeg(lsf_image_header *header, const uint8_t *bytes, size_t length,
                      uint64_t *pixels_max, const char *name, lsf_error *error)
{
    /* Each scan of a progressive file visits all blocks; files that are meant to be seen have
     * about ten. */
    enum { SCANS_MAX = 100 };
    uint32_t scans = 0;
    bool frame = false;
    for (size_t at = 2; at + 2 <= length;) {
        if (bytes[at] != 0xff || bytes[at + 1] == 0x00 || bytes[at + 1] == 0xff ||
            (bytes[at + 1] >= 0xd0 && bytes[at + 1] <= 0xd7)) {
            at++; /* entropy-coded data, fill bytes, restart markers */
            continue;
        }
        uint32_t marker = bytes[at + 1];
        if (marker == 0xd9) {
            if (!frame || scans == 0)
                return damaged(name, "JPEG", "it holds no picture", error);
            header->type = LSF_TEXEL_U8;
            /* Each 8 x 8 block takes at least a bit of Huffman code. */
            *pixels_max = (uint64_t)length * 8 * 64;
            return true;
        }
        if (length - at < 4 || read_u16(bytes + at + 2) < 2 ||
            read_u16(bytes + at + 2) > length - at - 2)
            return cut(name, "JPEG", error);
        uint32_t size = read_u16(bytes + at + 2);
        if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 &&
            marker != 0xcc) {
            if (marker > 0xc2)
                return lsf_error_set(error, LSF_ERROR_FILE,
                                     "%s: JPEG of a rare kind (lossless, hierarchical or "
                                     "arithmetic-coded); save it as baseline or progressive",
                                     name);
            if (size < 8 || frame)
                return damaged(name, "JPEG", "bad frame header", error);
            frame = true;
            header->height = read_u16(bytes + at + 5);
            header->width = read_u16(bytes + at + 7);
            header->channels = bytes[at + 9];
            if (bytes[at + 4] != 8 || (header->channels != 1 && header->channels != 3))
                return lsf_error_set(error, LSF_ERROR_FILE,
                                     "%s: JPEG with %u components of %u bits (CMYK or 12 bits); "
                                     "save it as 8-bit grey or RGB",
                                     name, header->channels, bytes[at + 4]);
        }
        if (marker == 0xda && ++scans > SCANS_MAX)
            return lsf_error_set(error, LSF_ERROR_FILE,
                                 "%s: JPEG with more than %d scans; save it as baseline", name,
                                 SCANS_MAX);
        at += 2 + size;
    }
    return cut(name, "JPEG", error);
}

/* Radiance pictures: Ward, "Real pixels", Graphics Gems II, 1991; text header, then a line that
 * gives order and size. */
static bool read_hdr(lsf_image_header *header, const uint8_t *bytes, size_t length,
                     uint64_t *pixels_max, const char *name, lsf_error *error)
{
    enum { HEADER_MAX = 65536 };
    size_t limit = length < HEADER_MAX ? length : HEADER_MAX;
    for (size_t at = 0; at < limit;) {
        const uint8_t *end = memchr(bytes + at, '\n', limit - at);
        if (!end)
            break;
        char line[128];
        size_t size = (size_t)(end - (bytes + at));
        snprintf(line, sizeof line, "%.*s", (int)(size < 127 ? size : 127),
                 (const char *)bytes + at);
        at += size + 1;
        if (strncmp(line, "FORMAT=", 7) == 0 && strncmp(line, "FORMAT=32-bit_rle_rgbe", 22) != 0)
            return lsf_error_set(error, LSF_ERROR_FILE,
                                 "%s: HDR file in %.60s; only 32-bit_rle_rgbe is read", name, line);
        if (line[0] != '-' && line[0] != '+')
            continue;
        if (sscanf(line, "-Y %9u +X %9u", &header->height, &header->width) != 2)
            return lsf_error_set(error, LSF_ERROR_FILE,
                                 "%s: HDR file with the rare row order \"%.60s\"; save it with "
                                 "rows from the top (-Y H +X W)",
                                 name, line);
        header->channels = 3;
        header->type = LSF_TEXEL_F32;
        /* Run-length coding takes 8 bytes for 127 pixels. */
        *pixels_max = (uint64_t)length * 16;
        return true;
    }
    return cut(name, "HDR", error);
}

static bool starts_with(const uint8_t *bytes, size_t length, const char *magic, size_t size)
{
    return length >= size && memcmp(bytes, magic, size) == 0;
}

bool lsf_image_header_read(lsf_image_header *header, const void *data, size_t length,
                           uint64_t byte_limit, const char *name, lsf_error *error)
{
    const uint8_t *bytes = data;
    uint64_t pixels_max = 0;
    bool valid;
    *header = (lsf_image_header){0};
    if (starts_with(bytes, length, "\x89PNG\r\n\x1a\n", 8)) {
        header->file = LSF_IMAGE_FILE_PNG;
        valid = read_png(header, bytes, length, &pixels_max, name, error);
    } else if (starts_with(bytes, length, "\xff\xd8\xff", 3)) {
        header->file = LSF_IMAGE_FILE_JPEG;
        valid = read_jpeg(header, bytes, length, &pixels_max, name, error);
    } else if (starts_with(bytes, length, "#?RADIANCE", 10) ||
               starts_with(bytes, length, "#?RGBE", 6)) {
        header->file = LSF_IMAGE_FILE_HDR;
        valid = read_hdr(header, bytes, length, &pixels_max, name, error);
    } else if (starts_with(bytes, length, "\x76\x2f\x31\x01", 4)) {
        header->file = LSF_IMAGE_FILE_EXR;
        valid = lsf_exr_header_read(header, bytes, length, &pixels_max, name, error);
    } else {
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: is not a PNG, JPEG, HDR or EXR image; convert it to one", name);
    }
    if (!valid)
        return false;

    if (header->width == 0 || header->height == 0)
        return lsf_error_set(error, LSF_ERROR_FILE, "%s: the image has no pixels (%u x %u)", name,
                             header->width, header->height);
    if (header->width > LSF_IMAGE_MAX_SIZE || header->height > LSF_IMAGE_MAX_SIZE)
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: the image has %u x %u pixels; at most %u a side are read, scale "
                             "it down",
                             name, header->width, header->height, LSF_IMAGE_MAX_SIZE);
    uint64_t texel_bytes = header->type == LSF_TEXEL_F32   ? 4
                           : header->type == LSF_TEXEL_U16 ? 2
                                                           : 1;
    uint64_t pixels = (uint64_t)header->width * header->height;
    if (pixels > byte_limit / (header->channels * texel_bytes))
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: the image (%u x %u, %u channels) would take more than %llu bytes "
                             "once decoded; scale it down",
                             name, header->width, header->height, header->channels,
                             (unsigned long long)byte_limit);
    if (pixels > pixels_max)
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: claims %u x %u pixels, more than its %zu bytes can hold; it is "
                             "damaged or was made to exhaust memory",
                             name, header->width, header->height, length);
    return true;
}
