#include "io/image_header.h"

#include <lightsheaf/image.h>

#include <stdlib.h>
#include <string.h>

/* The layout is that of "OpenEXR File Layout", openexr.com: magic, version and flags, attributes
 * (name, type, size, value), a zero byte, the table of chunk offsets, the chunks. */

enum { NONE, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB, COMPRESSION_COUNT };
static const uint16_t rows_per_chunk[COMPRESSION_COUNT] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};

enum { FLAG_TILED = 0x200, FLAG_DEEP = 0x800, FLAG_MULTIPART = 0x1000 };
enum { CHANNELS_MAX = 1024, TILE_MAX = 8192 };

typedef struct attributes {
    uint32_t compression, channels;
    uint64_t pixel_bytes; /* as stored */
    int64_t window[4];    /* x min, y min, x max, y max */
    bool has_compression, has_channels, has_window;
    uint32_t tile_width, tile_height;
} attributes;

static uint32_t read_u32(const uint8_t *bytes)
{
    return (uint32_t)bytes[3] << 24 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[1] << 8 | bytes[0];
}

static bool damaged(const char *name, const char *what, lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_FILE, "%s: damaged EXR file: %s; save or copy it again",
                         name, what);
}

/* Length of the string at `bytes` without its NUL; `limit` when it does not end before. */
static size_t string_length(const uint8_t *bytes, size_t limit)
{
    const uint8_t *end = memchr(bytes, 0, limit);
    return end ? (size_t)(end - bytes) : limit;
}

static bool read_channels(attributes *result, const uint8_t *bytes, size_t size, const char *name,
                          lsf_error *error)
{
    size_t at = 0;
    while (at < size && bytes[at] != 0) {
        size_t length = string_length(bytes + at, size - at);
        if (size - at < length + 17)
            return damaged(name, "bad channel list", error);
        const uint8_t *channel = bytes + at + length + 1;
        uint32_t type = read_u32(channel);
        if (length >= LSF_CHANNEL_NAME_SIZE)
            return lsf_error_set(error, LSF_ERROR_FILE,
                                 "%s: EXR channel name \"%.80s\" is longer than %d characters; "
                                 "rename the channel",
                                 name, (const char *)bytes + at, LSF_CHANNEL_NAME_SIZE - 1);
        if (type > 2)
            return damaged(name, "unknown channel type", error);
        if (read_u32(channel + 8) != 1 || read_u32(channel + 12) != 1)
            return lsf_error_set(error, LSF_ERROR_FILE,
                                 "%s: EXR channel \"%s\" is subsampled (luminance and chroma); "
                                 "save it as RGB",
                                 name, (const char *)bytes + at);
        if (++result->channels > CHANNELS_MAX)
            return lsf_error_set(error, LSF_ERROR_FILE,
                                 "%s: EXR with more than %d channels; leave some out", name,
                                 CHANNELS_MAX);
        result->pixel_bytes += type == 1 ? 2 : 4;
        at += length + 17;
    }
    result->has_channels = true;
    return result->channels > 0 || damaged(name, "no channels", error);
}

static bool read_attribute(attributes *result, const char *key, const uint8_t *value, size_t size,
                           const char *name, lsf_error *error)
{
    if (strcmp(key, "channels") == 0)
        return result->has_channels ? damaged(name, "two channel lists", error)
                                    : read_channels(result, value, size, name, error);
    if (strcmp(key, "compression") == 0) {
        if (size != 1 || value[0] >= COMPRESSION_COUNT)
            return damaged(name, "unknown compression", error);
        result->compression = value[0];
        result->has_compression = true;
    } else if (strcmp(key, "dataWindow") == 0) {
        if (size != 16)
            return damaged(name, "bad data window", error);
        for (int i = 0; i < 4; i++)
            result->window[i] = (int32_t)read_u32(value + 4 * i);
        result->has_window = true;
    } else if (strcmp(key, "tiles") == 0) {
        if (size != 9)
            return damaged(name, "bad tile description", error);
        result->tile_width = read_u32(value);
        result->tile_height = read_u32(value + 4);
    }
    return true;
}

/* The most bytes of pixels that `length` bytes can code. */
static uint64_t decoded_bytes_max(uint32_t compression, uint64_t length)
{
    switch (compression) {
    case NONE:
        return length;
    case RLE:
        return length * 64;
    case ZIPS:
    case ZIP:
    case PXR24:
        return length * 1032 * 2; /* deflate; PXR24 drops a byte in four or two before it */
    default:
        return UINT64_MAX; /* wavelets and cosines have no tight bound */
    }
}

bool lsf_exr_header_read(lsf_image_header *header, const uint8_t *bytes, size_t length,
                         uint64_t *pixels_max, const char *name, lsf_error *error)
{
    if (length < 8)
        return damaged(name, "it ends in the header", error);
    uint32_t flags = read_u32(bytes + 4);
    if ((flags & 0xff) != 2)
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: EXR version %u is not known; use version 2", name, flags & 0xff);
    if (flags & (FLAG_DEEP | FLAG_MULTIPART))
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: EXR with %s is not read; save it as a flat EXR with one part",
                             name, flags & FLAG_DEEP ? "deep data" : "several parts");

    attributes found = {0};
    size_t at = 8;
    while (at < length && bytes[at] != 0) {
        size_t key_length = string_length(bytes + at, length - at);
        size_t type_at = at + key_length + 1;
        if (type_at >= length)
            return damaged(name, "it ends in the header", error);
        size_t type_length = string_length(bytes + type_at, length - type_at);
        size_t size_at = type_at + type_length + 1;
        if (size_at >= length || length - size_at < 4 ||
            read_u32(bytes + size_at) > length - size_at - 4)
            return damaged(name, "it ends in the header", error);
        size_t size = read_u32(bytes + size_at);
        if (!read_attribute(&found, (const char *)bytes + at, bytes + size_at + 4, size, name,
                            error))
            return false;
        at = size_at + 4 + size;
    }
    if (at >= length || !found.has_channels || !found.has_compression || !found.has_window)
        return damaged(name, "it ends in the header, or a required attribute is missing", error);

    int64_t width = found.window[2] - found.window[0] + 1;
    int64_t height = found.window[3] - found.window[1] + 1;
    if (width < 1 || height < 1)
        return damaged(name, "empty data window", error);
    header->width = width > UINT32_MAX ? UINT32_MAX : (uint32_t)width;
    header->height = height > UINT32_MAX ? UINT32_MAX : (uint32_t)height;
    header->channels = found.channels;
    header->type = LSF_TEXEL_F32;

    uint64_t chunks;
    if (flags & FLAG_TILED) {
        if (found.tile_width == 0 || found.tile_height == 0 || found.tile_width > TILE_MAX ||
            found.tile_height > TILE_MAX)
            return lsf_error_set(error, LSF_ERROR_FILE,
                                 "%s: EXR with tiles of %u x %u pixels; at most %d a side are read",
                                 name, found.tile_width, found.tile_height, TILE_MAX);
        chunks = (uint64_t)((width + found.tile_width - 1) / found.tile_width) *
                 (uint64_t)((height + found.tile_height - 1) / found.tile_height);
    } else {
        int64_t rows = rows_per_chunk[found.compression];
        chunks = (uint64_t)((height + rows - 1) / rows);
    }
    /* Each chunk has an offset of 8 bytes in the table, and a header of 8. */
    if (chunks > (length - at) / 16)
        return damaged(name, "it is too short for its table of chunks", error);
    *pixels_max = decoded_bytes_max(found.compression, length) / found.pixel_bytes;
    /* OpenImageIO converts by blocks; OpenEXR keeps chunks compressed and expanded, all of them
     * where they are few. */
    header->working_bytes =
        ((uint64_t)64 << 20) + 2 * (uint64_t)header->width * header->height * found.pixel_bytes;
    return true;
}

/* The next attribute of a header that was checked; moves *at behind it. */
static bool next_attribute(const uint8_t *bytes, size_t *at, const char **type,
                           lsf_header_text *attribute)
{
    size_t offset = *at ? *at : 8;
    if (bytes[offset] == 0)
        return false;
    attribute->key = (const char *)bytes + offset;
    offset += strlen(attribute->key) + 1;
    *type = (const char *)bytes + offset;
    offset += strlen(*type) + 1;
    attribute->length = read_u32(bytes + offset);
    attribute->value = (const char *)bytes + offset + 4;
    *at = offset + 4 + attribute->length;
    return true;
}

bool lsf_exr_next_text(const uint8_t *bytes, size_t *at, lsf_header_text *text)
{
    const char *type;
    while (next_attribute(bytes, at, &type, text))
        if (strcmp(type, "string") == 0)
            return true;
    return false;
}

const char *lsf_exr_next_channel(const uint8_t *bytes, size_t *at)
{
    const char *type;
    lsf_header_text list;
    size_t offset = *at;
    while (*at == 0 && next_attribute(bytes, &offset, &type, &list))
        if (strcmp(list.key, "channels") == 0)
            *at = (size_t)(list.value - (const char *)bytes);
    const char *name = (const char *)bytes + *at;
    *at += strlen(name) + 17;
    return name;
}
