#include "io/image_header.h"

#include <string.h>

/* The layout is that of the WebP container specification: RIFF with chunks of type, length and
 * data, padded to even lengths; and of the two bitstreams, VP8 (RFC 6386, section 9.1) and the WebP
 * lossless bitstream specification, section 3. */

enum { RIFF_BYTES = 12, CHUNK_FRAME_BYTES = 8 };
enum { FLAG_ANIMATION = 0x02, FLAG_ALPHA = 0x10 };

static uint32_t read_u16(const uint8_t *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8;
}

static uint32_t read_u32(const uint8_t *bytes)
{
    return read_u16(bytes) | read_u16(bytes + 2) << 16;
}

static bool is_type(const uint8_t *chunk, const char *type)
{
    return memcmp(chunk, type, 4) == 0;
}

/* Bytes of the chunk at `at` with header and padding, which the last one may lack; 0: it does
 * not lie inside the file. */
static size_t chunk_bytes(const uint8_t *bytes, size_t length, size_t at)
{
    if (length - at < CHUNK_FRAME_BYTES)
        return 0;
    uint64_t size = CHUNK_FRAME_BYTES + (uint64_t)read_u32(bytes + at + 4);
    if (size > length - at)
        return 0;
    return size < length - at ? (size_t)(size + (size & 1)) : (size_t)size;
}

static bool damaged(const char *name, const char *what, lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_FILE, "%s: damaged WebP file: %s; save or copy it again",
                         name, what);
}

/* The size that the bitstream itself declares. */
static bool read_size(lsf_image_header *header, const uint8_t *chunk)
{
    const uint8_t *data = chunk + CHUNK_FRAME_BYTES;
    uint32_t size = read_u32(chunk + 4);
    if (is_type(chunk, "VP8L")) {
        if (size < 5 || data[0] != 0x2f)
            return false;
        uint32_t bits = read_u32(data + 1);
        header->width = (bits & 0x3fff) + 1;
        header->height = (bits >> 14 & 0x3fff) + 1;
        header->channels = bits >> 28 & 1 ? 4 : 3;
        return bits >> 29 == 0; /* version */
    }
    bool key_frame = size >= 10 && !(data[0] & 1);
    if (!key_frame || memcmp(data + 3, "\x9d\x01\x2a", 3) != 0)
        return false;
    header->width = read_u16(data + 6) & 0x3fff;
    header->height = read_u16(data + 8) & 0x3fff;
    header->channels = 3;
    return true;
}

bool lsf_webp_header_read(lsf_image_header *header, const uint8_t *bytes, size_t length,
                          uint64_t *pixels_max, const char *name, lsf_error *error)
{
    if (length < RIFF_BYTES || read_u32(bytes + 4) > length - 8)
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: the WebP file ends too early; copy it again", name);
    length = (size_t)read_u32(bytes + 4) + 8;
    uint32_t canvas_width = 0, canvas_height = 0;
    bool picture = false, alpha = false;
    for (size_t at = RIFF_BYTES, size; !picture && at < length; at += size) {
        const uint8_t *chunk = bytes + at;
        size = chunk_bytes(bytes, length, at);
        if (size == 0)
            return damaged(name, "a chunk is cut", error);
        if (is_type(chunk, "VP8X")) {
            if (size < CHUNK_FRAME_BYTES + 10)
                return damaged(name, "its header is cut", error);
            if (chunk[8] & FLAG_ANIMATION)
                return lsf_error_set(error, LSF_ERROR_FILE,
                                     "%s: the WebP file is animated; save one picture of it", name);
            canvas_width = (read_u32(chunk + 12) & 0xffffff) + 1;
            canvas_height = (read_u32(chunk + 14) >> 8) + 1;
        } else if (is_type(chunk, "ALPH")) {
            alpha = true;
        } else if (is_type(chunk, "VP8 ") || is_type(chunk, "VP8L")) {
            picture = read_size(header, chunk);
            if (!picture)
                return damaged(name, "its picture does not begin as it should", error);
        }
    }
    if (!picture)
        return damaged(name, "there is no picture in it", error);
    if (canvas_width && (canvas_width != header->width || canvas_height != header->height))
        return damaged(name, "its picture is of another size than its header", error);
    if (alpha)
        header->channels = 4;
    header->type = LSF_TEXEL_U8;
    /* A few bytes can hold a picture of one colour and any size that 14 bits tell: only the limit
     * on decoded bytes bounds it. Decoding keeps it once more, in four channels; and of a lossless
     * one 13 KB for each group of prefix codes, which serves at least 4 x 4 pixels, takes at least
     * three bytes of the file, and has a number of 16 bits. */
    *pixels_max = UINT64_MAX;
    uint64_t pixels = (uint64_t)header->width * header->height;
    uint64_t groups = pixels / 16 < length / 3 ? pixels / 16 : length / 3;
    header->working_bytes = pixels * 4 + (groups < 65536 ? groups : 65536) * 13312;
    return true;
}

size_t lsf_webp_without_metadata(uint8_t *bytes, size_t length)
{
    size_t kept = RIFF_BYTES;
    for (size_t at = RIFF_BYTES, size; at < length; at += size) {
        size = chunk_bytes(bytes, length, at);
        if (size == 0)
            break;
        const uint8_t *chunk = bytes + at;
        if (!is_type(chunk, "VP8X") && !is_type(chunk, "ALPH") && !is_type(chunk, "VP8 ") &&
            !is_type(chunk, "VP8L"))
            continue;
        memmove(bytes + kept, chunk, size);
        if (is_type(bytes + kept, "VP8X"))
            bytes[kept + 8] &= FLAG_ALPHA;
        kept += size;
    }
    uint32_t size = (uint32_t)(kept - 8);
    for (int i = 0; i < 4; i++)
        bytes[4 + i] = (uint8_t)(size >> 8 * i);
    return kept;
}
