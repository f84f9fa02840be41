#include "io/image_header.h"

#include "io/foreign_file.h"
#include "io/io.h"

#include <stdio.h>
#include <string.h>

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
    return lsf_error_set(error, LSF_ERROR_FILE,
                         "%s: the HDR file ends too early or is damaged; save or copy it again",
                         name);
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
        valid = lsf_png_header_read(header, bytes, length, &pixels_max, name, error);
    } else if (starts_with(bytes, length, "\xff\xd8\xff", 3)) {
        header->file = LSF_IMAGE_FILE_JPEG;
        valid = lsf_jpeg_header_read(header, bytes, length, &pixels_max, name, error);
    } else if (starts_with(bytes, length, "#?RADIANCE", 10) ||
               starts_with(bytes, length, "#?RGBE", 6)) {
        header->file = LSF_IMAGE_FILE_HDR;
        valid = read_hdr(header, bytes, length, &pixels_max, name, error);
    } else if (starts_with(bytes, length, "\x76\x2f\x31\x01", 4)) {
        header->file = LSF_IMAGE_FILE_EXR;
        valid = lsf_exr_header_read(header, bytes, length, &pixels_max, name, error);
    } else if (starts_with(bytes, length, "RIFF", 4) && length >= 12 &&
               memcmp(bytes + 8, "WEBP", 4) == 0) {
        header->file = LSF_IMAGE_FILE_WEBP;
        valid = lsf_webp_header_read(header, bytes, length, &pixels_max, name, error);
    } else if (starts_with(bytes, length, "\xabKTX 20\xbb\r\n\x1a\n", 12)) {
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: is a KTX2 image (KHR_texture_basisu), which is not read; export "
                             "the file with PNG, "
                             "JPEG or WebP textures",
                             name);
    } else if (lsf_is_git_lfs_pointer(bytes, length)) {
        return lsf_error_set(
            error, LSF_ERROR_FILE,
            "%s: is a pointer of Git LFS, not the image itself; run `git lfs pull`", name);
    } else {
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: is not a PNG, JPEG, WebP, HDR or EXR image; convert it to one",
                             name);
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
    if (pixels > LSF_IMAGE_MAX_BYTES / (header->channels * texel_bytes))
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: the image (%u x %u, %u channels) would take more than %llu bytes "
                             "once decoded; scale it down",
                             name, header->width, header->height, header->channels,
                             (unsigned long long)LSF_IMAGE_MAX_BYTES);
    if (pixels > pixels_max)
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: claims %u x %u pixels, more than its %zu bytes can hold; it is "
                             "damaged or was made to exhaust memory",
                             name, header->width, header->height, length);
    uint64_t needed = length + pixels * header->channels * texel_bytes + header->working_bytes;
    if (needed > byte_limit)
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: to decode the image (%u x %u, %u channels) may take %llu bytes, "
                             "more than the %llu that the memory limit leaves; raise the limit "
                             "or scale the image down",
                             name, header->width, header->height, header->channels,
                             (unsigned long long)needed, (unsigned long long)byte_limit);
    return true;
}
