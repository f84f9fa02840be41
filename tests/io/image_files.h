/* Small image files made byte by byte, and a folder to write in. */
#ifndef LSF_TEST_IMAGE_FILES_H
#define LSF_TEST_IMAGE_FILES_H

#include "base/base.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char test_folder[64];

static inline int make_test_folder(void **state)
{
    (void)state;
    strcpy(test_folder, "/tmp/lightsheaf-test-XXXXXX");
    return mkdtemp(test_folder) ? 0 : -1;
}

/* A path in the test's folder; valid until the eighth call from here. */
static inline const char *in_folder(const char *name)
{
    static char paths[8][512];
    static unsigned next;
    char *path = paths[next++ % 8];
    snprintf(path, sizeof paths[0], "%s/%s", test_folder, name);
    return path;
}

/* Names in the test's folder, hidden ones included. */
static inline unsigned count_files(void)
{
    unsigned count = 0;
    DIR *folder = opendir(test_folder);
    assert_non_null(folder);
    for (struct dirent *entry; (entry = readdir(folder));)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(folder);
    return count;
}

static inline int remove_test_folder(void **state)
{
    (void)state;
    DIR *folder = opendir(test_folder);
    for (struct dirent *entry; folder && (entry = readdir(folder));)
        unlink(in_folder(entry->d_name));
    if (folder)
        closedir(folder);
    return rmdir(test_folder);
}

typedef struct bytes {
    uint8_t data[4096];
    size_t length;
} bytes;

static inline void add(bytes *out, const void *data, size_t length)
{
    assert_true(out->length + length <= sizeof out->data);
    memcpy(out->data + out->length, data, length);
    out->length += length;
}

static inline void add_u32(bytes *out, uint32_t value)
{
    uint8_t data[4] = {(uint8_t)(value >> 24), (uint8_t)(value >> 16), (uint8_t)(value >> 8),
                       (uint8_t)value};
    add(out, data, 4);
}

static inline uint32_t crc32_of(const uint8_t *data, size_t length)
{
    uint32_t crc = 0xffffffffu;
    for (size_t i = 0; i < length; i++) {
        crc ^= data[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    return ~crc;
}

static inline void add_png_chunk(bytes *out, const char *type, const void *data, size_t length)
{
    add_u32(out, (uint32_t)length);
    size_t start = out->length;
    add(out, type, 4);
    add(out, data, length);
    add_u32(out, crc32_of(out->data + start, length + 4));
}

typedef struct png_description {
    uint32_t width, height, depth, colour, interlace;
    const char *palette, *transparency; /* NULL: none */
    size_t palette_length, transparency_length;
    const char *rows; /* each begins with its filter type, 0 */
    size_t row_bytes;
} png_description;

/* A PNG whose data is deflated without compression. */
static inline bytes make_png(const png_description *png)
{
    bytes out = {.length = 0}, header = {.length = 0}, data = {.length = 0};
    add(&out, "\x89PNG\r\n\x1a\n", 8);
    add_u32(&header, png->width);
    add_u32(&header, png->height);
    add(&header,
        (uint8_t[]){(uint8_t)png->depth, (uint8_t)png->colour, 0, 0, (uint8_t)png->interlace}, 5);
    add_png_chunk(&out, "IHDR", header.data, header.length);
    if (png->palette)
        add_png_chunk(&out, "PLTE", png->palette, png->palette_length);
    if (png->transparency)
        add_png_chunk(&out, "tRNS", png->transparency, png->transparency_length);
    uint32_t length = (uint32_t)png->row_bytes, a = 1, b = 0;
    for (size_t i = 0; i < length; i++) {
        a = (a + (uint8_t)png->rows[i]) % 65521;
        b = (b + a) % 65521;
    }
    add(&data,
        (uint8_t[]){0x78, 0x01, 1, (uint8_t)length, (uint8_t)(length >> 8), (uint8_t)~length,
                    (uint8_t)(~length >> 8)},
        7);
    add(&data, png->rows, length);
    add_u32(&data, b << 16 | a);
    add_png_chunk(&out, "IDAT", data.data, data.length);
    add_png_chunk(&out, "IEND", "", 0);
    return out;
}

/* 16 x 8 pixels from red to blue, baseline, 4:2:0. */
static const uint8_t jpeg_file[] = {
#include "gradient_jpeg.inc"
};

#endif
