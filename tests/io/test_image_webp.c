/* WebP: four kinds of files that the library's encoder makes of the same 4 x 3 pixels. */
#include "image_files.h"
#include "io/image_header.h"
#include "io/io.h"

/* Pixel i is (20 i, 255 - 20 i, 60 (i mod 4)), its alpha 255 for i < 6, then 20 i. */
enum { WIDTH = 4, HEIGHT = 3 };

/* clang-format off */
/* VP8L with alpha */
static const uint8_t lossless_alpha[] = {
    0x52, 0x49, 0x46, 0x46, 0x4c, 0x00, 0x00, 0x00, 0x57, 0x45, 0x42, 0x50, 0x56, 0x50, 0x38, 0x4c,
    0x3f, 0x00, 0x00, 0x00, 0x2f, 0x03, 0x80, 0x00, 0x10, 0x5f, 0x20, 0x10, 0x48, 0xf0, 0x97, 0x1c,
    0x21, 0x20, 0x81, 0x40, 0x22, 0x11, 0xc2, 0x90, 0xe3, 0x0b, 0x04, 0x12, 0xb1, 0x10, 0x06, 0x1a,
    0x9f, 0x20, 0xdb, 0xa6, 0x10, 0x33, 0xb8, 0xe4, 0xf1, 0xa3, 0x3f, 0xa2, 0x10, 0x42, 0xd7, 0x00,
    0x80, 0x00, 0x08, 0x02, 0x48, 0x14, 0x62, 0x89, 0x65, 0x96, 0x59, 0x66, 0x99, 0x34, 0xa2, 0xff,
    0xd1, 0x1d, 0x03, 0x00,
};

/* VP8X, ALPH and VP8 */
static const uint8_t lossy_alpha[] = {
    0x52, 0x49, 0x46, 0x46, 0x86, 0x00, 0x00, 0x00, 0x57, 0x45, 0x42, 0x50, 0x56, 0x50, 0x38, 0x58,
    0x0a, 0x00, 0x00, 0x00, 0x10, 0x00, 0x00, 0x00, 0x03, 0x00, 0x00, 0x02, 0x00, 0x00, 0x41, 0x4c,
    0x50, 0x48, 0x0d, 0x00, 0x00, 0x00, 0x00, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x78, 0x8c, 0xa0,
    0xb4, 0xc8, 0xdc, 0x00, 0x56, 0x50, 0x38, 0x20, 0x52, 0x00, 0x00, 0x00, 0xb0, 0x01, 0x00, 0x9d,
    0x01, 0x2a, 0x04, 0x00, 0x03, 0x00, 0x01, 0x40, 0x26, 0x25, 0xb0, 0x02, 0x74, 0x01, 0x0e, 0xf8,
    0xa6, 0xd0, 0x00, 0xfd, 0x53, 0xcd, 0xb7, 0xee, 0xdb, 0xff, 0x7f, 0xbf, 0x9f, 0xbf, 0xff, 0x2b,
    0x83, 0xe3, 0xaa, 0x24, 0x12, 0x48, 0x8e, 0xf6, 0x2f, 0xbf, 0xff, 0x26, 0xf6, 0x35, 0xff, 0x93,
    0x65, 0xbf, 0x2b, 0xff, 0x51, 0x53, 0xb9, 0x9f, 0xd9, 0xbf, 0xfe, 0x9c, 0x5f, 0xfb, 0xff, 0xe9,
    0xc5, 0xaf, 0xf7, 0x37, 0xff, 0xfe, 0x98, 0x93, 0x5f, 0xb8, 0xbf, 0x54, 0x00, 0x00,
};

/* VP8 */
static const uint8_t lossy[] = {
    0x52, 0x49, 0x46, 0x46, 0x5e, 0x00, 0x00, 0x00, 0x57, 0x45, 0x42, 0x50, 0x56, 0x50, 0x38, 0x20,
    0x52, 0x00, 0x00, 0x00, 0x30, 0x02, 0x00, 0x9d, 0x01, 0x2a, 0x04, 0x00, 0x03, 0x00, 0x01, 0x40,
    0x26, 0x25, 0xb0, 0x02, 0x74, 0x47, 0x00, 0x64, 0x80, 0x02, 0xcd, 0x9e, 0xd9, 0x52, 0x00, 0xfd,
    0x53, 0xcd, 0xb7, 0xee, 0xdb, 0xff, 0x74, 0xa7, 0x57, 0xff, 0x2b, 0x83, 0xe3, 0xa1, 0xa8, 0x3a,
    0xc5, 0x71, 0xc0, 0x7f, 0xf2, 0x6f, 0x63, 0x5f, 0xf9, 0x36, 0x5b, 0xf2, 0xbf, 0xf5, 0x15, 0x90,
    0x7f, 0x73, 0x7f, 0xfe, 0x58, 0xff, 0xc8, 0xff, 0xa7, 0x16, 0xbf, 0xdc, 0xdf, 0xff, 0xfa, 0x62,
    0x4d, 0x27, 0xfa, 0xf0, 0x00, 0x00,
};

/* VP8L */
static const uint8_t lossless[] = {
    0x52, 0x49, 0x46, 0x46, 0x3e, 0x00, 0x00, 0x00, 0x57, 0x45, 0x42, 0x50, 0x56, 0x50, 0x38, 0x4c,
    0x31, 0x00, 0x00, 0x00, 0x2f, 0x03, 0x80, 0x00, 0x00, 0x5f, 0xa0, 0xa0, 0x6d, 0x1b, 0x86, 0x3f,
    0x57, 0x73, 0x68, 0x77, 0x40, 0x0c, 0x85, 0x40, 0x20, 0xc5, 0x83, 0x85, 0xf0, 0xfc, 0x17, 0x21,
    0x2a, 0x22, 0xee, 0x5f, 0x40, 0x10, 0x40, 0xa2, 0x10, 0x4b, 0x2c, 0xb3, 0xcc, 0x32, 0xcb, 0xa4,
    0x11, 0xfd, 0x0f, 0x4c, 0x77, 0x00,
};

/* clang-format on */

static bool decode(lsf_texture_image *image, const void *file, size_t length, lsf_error *error)
{
    *image = (lsf_texture_image){0};
    return lsf_texture_image_decode(image, file, length, 1 << 20, "test", error);
}

static lsf_texture_image must_decode(const void *file, size_t length, uint32_t channels)
{
    lsf_texture_image image;
    lsf_error error = {0};
    if (!decode(&image, file, length, &error))
        fail_msg("%s", error.message);
    assert_int_equal(image.width, WIDTH);
    assert_int_equal(image.height, HEIGHT);
    assert_int_equal(image.type, LSF_TEXEL_U8);
    assert_int_equal(image.channels, channels);
    return image;
}

static void refuse(const void *file, size_t length, const char *part)
{
    lsf_texture_image image;
    lsf_error error = {0};
    assert_false(decode(&image, file, length, &error));
    assert_int_equal(error.code, LSF_ERROR_FILE);
    if (!strstr(error.message, part))
        fail_msg("\"%s\" lacks \"%s\"", error.message, part);
}

static void test_pixels(void **state)
{
    (void)state;
    lsf_texture_image images[] = {must_decode(lossless_alpha, sizeof lossless_alpha, 4),
                                  must_decode(lossless, sizeof lossless, 3),
                                  must_decode(lossy_alpha, sizeof lossy_alpha, 4),
                                  must_decode(lossy, sizeof lossy, 3)};
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int color[] = {20 * i, 255 - 20 * i, i % 4 * 60, i < 6 ? 255 : 20 * i};
        for (int c = 0; c < 4; c++) {
            assert_int_equal(((uint8_t *)images[0].texels)[4 * i + c], color[c]);
            if (c < 3)
                assert_int_equal(((uint8_t *)images[1].texels)[3 * i + c], color[c]);
        }
        /* Lossy files keep alpha as it is; of colours, two of three kinds at half the size. */
        assert_int_equal(((uint8_t *)images[2].texels)[4 * i + 3], color[3]);
    }
    for (size_t i = 0; i < LSF_COUNT(images); i++)
        free(images[i].texels);
}

static void test_cut_and_changed(void **state)
{
    (void)state;
    const struct {
        const uint8_t *bytes;
        size_t length;
    } files[] = {{lossless_alpha, sizeof lossless_alpha},
                 {lossy_alpha, sizeof lossy_alpha},
                 {lossy, sizeof lossy},
                 {lossless, sizeof lossless}};
    for (size_t f = 0; f < LSF_COUNT(files); f++) {
        size_t length = files[f].length;
        for (size_t cut = 0; cut < length; cut++) {
            uint8_t *part = malloc(cut ? cut : 1); /* its end is the block's: sanitizers see */
            assert_non_null(part);
            memcpy(part, files[f].bytes, cut);
            refuse(part, cut, cut < 12 ? "not a PNG" : "ends too early");
            free(part);
        }
        uint32_t random = 1;
        for (size_t i = 0; i < length; i++) {
            uint8_t *changed = malloc(length);
            assert_non_null(changed);
            memcpy(changed, files[f].bytes, length);
            random = random * 1664525u + 1013904223u;
            changed[i] = (uint8_t)(random >> 24);
            lsf_texture_image image;
            lsf_error error = {0};
            assert_true(decode(&image, changed, length, &error) || error.code == LSF_ERROR_FILE);
            free(image.texels);
            free(changed);
        }
    }
}

static void test_what_is_not_read(void **state)
{
    (void)state;
    uint8_t file[sizeof lossy_alpha];
    memcpy(file, lossy_alpha, sizeof file);
    file[20] |= 0x02;
    refuse(file, sizeof file, "animated");
    memcpy(file, lossy_alpha, sizeof file);
    file[24]++; /* the canvas is wider than the picture */
    refuse(file, sizeof file, "another size");
    memcpy(file, lossy_alpha, sizeof file);
    file[16] = 0xff;
    refuse(file, sizeof file, "cut");
    refuse("RIFF\4\0\0\0WEBP", 12, "no picture");
    refuse("\xabKTX 20\xbb\r\n\x1a\n", 12, "KTX2");

    /* One colour takes few bytes at any size: only the limit bounds it. */
    uint8_t large[sizeof lossless];
    memcpy(large, lossless, sizeof large);
    memcpy(large + 21, "\xff\xff\xff\x0f", 4); /* 16384 x 16384 */
    refuse(large, sizeof large, "memory limit");
}

static void test_metadata_is_dropped(void **state)
{
    (void)state;
    static const char extra[] = "EXIF\5\0\0\0hello\0XMP \4\0\0\0<x/>";
    size_t length = sizeof lossy_alpha + sizeof extra - 1;
    uint8_t file[sizeof lossy_alpha + sizeof extra];
    memcpy(file, lossy_alpha, sizeof lossy_alpha);
    memcpy(file + sizeof lossy_alpha, extra, sizeof extra);
    file[4] = (uint8_t)(length - 8);
    file[20] |= 0x0c; /* Exif and XMP are there */
    lsf_texture_image image = must_decode(file, length, 4);
    free(image.texels);
    assert_int_equal(lsf_webp_without_metadata(file, length), sizeof lossy_alpha);
    assert_memory_equal(file, lossy_alpha, sizeof lossy_alpha);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pixels),
        cmocka_unit_test(test_cut_and_changed),
        cmocka_unit_test(test_what_is_not_read),
        cmocka_unit_test(test_metadata_is_dropped),
    };
    return cmocka_run_group_tests_name("image webp", tests, make_test_folder, remove_test_folder);
}
