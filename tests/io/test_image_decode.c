/* Every kind of image file that is read, and files that are cut, damaged or made to do harm. */
#include "image_files.h"

#include "io/image_header.h"
#include "io/io.h"

#include <math.h>
#include <sys/resource.h>

static lsf_texture_image decode(const void *data, size_t length)
{
    lsf_texture_image image = {0};
    lsf_error error = {0};
    if (!lsf_texture_image_decode(&image, data, length, 1 << 27, "file", &error))
        fail_msg("%s", error.message);
    return image;
}

/* Refused with LSF_ERROR_FILE and a message that names the file and holds `cause`. */
static void refuse(const void *data, size_t length, const char *cause)
{
    lsf_texture_image image = {0};
    lsf_error error = {0};
    assert_false(
        lsf_texture_image_decode(&image, data, length, LSF_IMAGE_MAX_BYTES, "some file", &error));
    assert_null(image.texels);
    assert_int_equal(error.code, LSF_ERROR_FILE);
    assert_non_null(strstr(error.message, "some file"));
    if (!strstr(error.message, cause))
        fail_msg("\"%s\" does not hold \"%s\"", error.message, cause);
}

/* Must come to an end without harm, whatever it decides. */
static bool try_decode(const void *data, size_t length)
{
    lsf_texture_image image = {0};
    lsf_error error = {0};
    bool done = lsf_texture_image_decode(&image, data, length, 1 << 27, "file", &error);
    assert_true(done || (error.code == LSF_ERROR_FILE && error.message[0]));
    free(image.texels);
    return done;
}

/* Comes first: once loaded, the module stays. */
static void test_missing_module_is_named(void **state)
{
    (void)state;
    const char *folders = getenv("LIGHTSHEAF_MODULE_DIR");
    char *kept = folders ? strdup(folders) : NULL;
    unsetenv("LIGHTSHEAF_MODULE_DIR");
    lsf_texture_image image = {0};
    lsf_error error = {0};
    bool done =
        lsf_texture_image_decode(&image, jpeg_file, sizeof jpeg_file, 1 << 20, "a.jpg", &error);
    free(image.texels);
    if (kept)
        setenv("LIGHTSHEAF_MODULE_DIR", kept, 1);
    free(kept);
    if (done)
        skip(); /* an installed one was found */
    assert_int_equal(error.code, LSF_ERROR_FILE);
    assert_non_null(strstr(error.message, "a.jpg"));
    assert_non_null(strstr(error.message, "libopenimageio"));
}

static void test_png_kinds(void **state)
{
    (void)state;
    static const struct {
        png_description png;
        uint32_t channels;
        lsf_texel_type type;
        uint16_t texels[8];
    } cases[] = {
        {{4, 1, 1, 0, 0, 0, 0, 0, 0, "\0\xa0", 2}, 1, LSF_TEXEL_U8, {255, 0, 255, 0}},
        {{4, 1, 2, 0, 0, 0, 0, 0, 0, "\0\x1b", 2}, 1, LSF_TEXEL_U8, {0, 85, 170, 255}},
        {{2, 1, 4, 0, 0, 0, 0, 0, 0, "\0\x5f", 2}, 1, LSF_TEXEL_U8, {85, 255}},
        {{2, 1, 8, 0, 0, 0, 0, 0, 0, "\0\x12\x34", 3}, 1, LSF_TEXEL_U8, {18, 52}},
        {{2, 1, 16, 0, 0, 0, 0, 0, 0, "\0\x12\x34\xff\xff", 5}, 1, LSF_TEXEL_U16, {4660, 65535}},
        {{2, 1, 8, 0, 0, 0, "\0\1", 0, 2, "\0\1\2", 3}, 2, LSF_TEXEL_U8, {1, 0, 2, 255}},
        {{2, 1, 8, 4, 0, 0, 0, 0, 0, "\0\x50\0\xff\x80", 5}, 2, LSF_TEXEL_U8, {80, 0, 255, 128}},
        {{1, 1, 16, 4, 0, 0, 0, 0, 0, "\0\x12\x34\x56\x78", 5}, 2, LSF_TEXEL_U16, {4660, 22136}},
        {{2, 1, 8, 2, 0, 0, 0, 0, 0, "\0\1\2\3\4\5\6", 7}, 3, LSF_TEXEL_U8, {1, 2, 3, 4, 5, 6}},
        {{1, 1, 8, 2, 1, 0, 0, 0, 0, "\0\1\2\3", 4}, 3, LSF_TEXEL_U8, {1, 2, 3}},
        {{2, 1, 8, 2, 0, 0, "\0\1\0\2\0\3", 0, 6, "\0\1\2\3\4\5\6", 7},
         4,
         LSF_TEXEL_U8,
         {1, 2, 3, 0, 4, 5, 6, 255}},
        {{2, 1, 1, 3, 0, "\1\2\3\4\5\6", 0, 6, 0, "\0\x40", 2},
         3,
         LSF_TEXEL_U8,
         {1, 2, 3, 4, 5, 6}},
        {{2, 1, 8, 3, 0, "\1\2\3\4\5\6", "\7", 6, 1, "\0\0\1", 3},
         4,
         LSF_TEXEL_U8,
         {1, 2, 3, 7, 4, 5, 6, 255}},
        /* Colour under alpha 0 and 51 stays what it was: nothing is multiplied. */
        {{2, 1, 8, 6, 0, 0, 0, 0, 0, "\0\xc8\x64\x32\0\xc8\x64\x32\x33", 9},
         4,
         LSF_TEXEL_U8,
         {200, 100, 50, 0, 200, 100, 50, 51}},
        {{1, 1, 16, 6, 0, 0, 0, 0, 0, "\0\x12\x34\xff\xff\0\1\x80\0", 9},
         4,
         LSF_TEXEL_U16,
         {4660, 65535, 1, 32768}},
    };
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        bytes file = make_png(&cases[i].png);
        lsf_texture_image image = decode(file.data, file.length);
        assert_int_equal(image.width, cases[i].png.width);
        assert_int_equal(image.height, 1);
        assert_int_equal(image.channels, cases[i].channels);
        assert_int_equal(image.type, cases[i].type);
        for (uint32_t t = 0; t < image.width * image.channels; t++)
            assert_int_equal(image.type == LSF_TEXEL_U8 ? ((uint8_t *)image.texels)[t]
                                                        : ((uint16_t *)image.texels)[t],
                             cases[i].texels[t]);
        free(image.texels);
    }
}

static void test_grey_files_become_rgb_images(void **state)
{
    (void)state;
    bytes file =
        make_png(&(png_description){2, 1, 16, 4, 0, 0, 0, 0, 0, "\0\x80\0\x40\0\xff\xff\0\0", 9});
    assert_true(lsf_file_write(in_folder("grey.png"), file.data, file.length, NULL));
    lsf_image *image = lsf_image_load(in_folder("grey.png"), NULL);
    assert_non_null(image);
    assert_int_equal(image->channel_count, 4);
    double s = 32768 / 65535.0;
    for (int c = 0; c < 3; c++)
        assert_true(fabs(image->pixels[c] - pow((s + 0.055) / 1.055, 2.4)) < 1e-7);
    assert_true(fabs(image->pixels[3] - 16384 / 65535.0) < 1e-7);
    assert_true(image->pixels[4] == 1.0f && image->pixels[7] == 0.0f);
    lsf_image_destroy(image);
}

static void test_jpeg(void **state)
{
    (void)state;
    lsf_texture_image image = decode(jpeg_file, sizeof jpeg_file);
    assert_int_equal(image.width, 16);
    assert_int_equal(image.height, 8);
    assert_int_equal(image.channels, 3);
    const uint8_t *texels = image.texels;
    assert_true(texels[0] > 200 && texels[1] < 40 && texels[2] < 60);
    const uint8_t *last = texels + 3 * (16 * 8 - 1);
    assert_true(last[0] < 60 && last[1] < 40 && last[2] > 200);
    free(image.texels);

    uint8_t changed[sizeof jpeg_file];
    uint8_t *frame =
        memmem(memcpy(changed, jpeg_file, sizeof changed), sizeof changed, "\xff\xc0\x00\x11", 4);
    assert_non_null(frame);
    frame[9] = 4;
    refuse(changed, sizeof changed, "CMYK");
    frame[9] = 3;
    frame[1] = 0xc9;
    refuse(changed, sizeof changed, "arithmetic");
    frame[1] = 0xc0;
    memcpy(frame + 5, "\xff\xff\xff\xff", 4);
    refuse(changed, sizeof changed, "would take more");
    memcpy(frame + 5, "\x20\x00\x20\x00", 4);
    refuse(changed, sizeof changed, "more than its");
}

static void add_segment(bytes *out, uint8_t marker, const char *content, size_t length)
{
    add(out, (uint8_t[]){0xff, marker, (uint8_t)((length + 2) >> 8), (uint8_t)(length + 2)}, 4);
    add(out, content, length);
}

/* An IPTC record that claims 65535 bytes and has 10. */
static const char iptc[] = "Photoshop 3.0\0"
                           "8BIM\4\4\0\0\0\0\xff\xff\x1c\2\5\xff\xff"
                           "AAAAAAAAAA";

static void test_jpeg_metadata_is_not_decoded(void **state)
{
    (void)state;
    lsf_texture_image clean = decode(jpeg_file, sizeof jpeg_file);
    uint8_t copy[sizeof jpeg_file];
    memcpy(copy, jpeg_file, sizeof copy);
    size_t clean_length = lsf_jpeg_without_metadata(copy, sizeof copy);
    assert_int_equal(clean_length, sizeof jpeg_file);
    assert_memory_equal(copy, jpeg_file, clean_length);

    bytes files[4] = {0};
    for (int i = 0; i < 4; i++)
        add(&files[i], jpeg_file, 2);
    /* Every kind of metadata. */
    for (uint8_t marker = 0xe1; marker <= 0xef; marker++)
        if (marker != 0xee)
            add_segment(&files[0], marker, iptc, sizeof iptc - 1);
    add_segment(&files[0], 0xfe, iptc, sizeof iptc - 1);
    /* A marker that has no length, though one that would hide the next follows it. */
    add(&files[1], "\xff\x01\x00\x20", 4);
    add_segment(&files[1], 0xed, iptc, sizeof iptc - 1);
    /* A fill byte, before what would be a marker's code once the comment between is gone. */
    add(&files[2], "\xff", 1);
    add_segment(&files[2], 0xfe, "", 0);
    add(&files[2], "\xed\x00\x29", 3);
    add(&files[2], iptc, sizeof iptc - 1);
    for (int i = 0; i < 3; i++)
        add(&files[i], jpeg_file + 2, sizeof jpeg_file - 2);
    /* After the scan's data, and after the end of the image. */
    add(&files[3], jpeg_file + 2, sizeof jpeg_file - 4);
    add_segment(&files[3], 0xed, iptc, sizeof iptc - 1);
    add(&files[3], "\xff\xd9", 2);
    add_segment(&files[3], 0xed, iptc, sizeof iptc - 1);

    for (int i = 0; i < 4; i++) {
        bool stray_bytes = i == 1 || i == 2;
        if (stray_bytes) {
            try_decode(files[i].data, files[i].length);
        } else {
            lsf_texture_image image = decode(files[i].data, files[i].length);
            assert_memory_equal(image.texels, clean.texels, 16 * 8 * 3);
            free(image.texels);
        }
        size_t length = lsf_jpeg_without_metadata(files[i].data, files[i].length);
        assert_true(length <= sizeof jpeg_file + 64);
        assert_null(memmem(files[i].data, length, "\xff\xed", 2));
        assert_null(memmem(files[i].data, length, "\xff\xfe", 2));
    }
    free(clean.texels);
}

static void test_png_metadata_is_not_decoded(void **state)
{
    (void)state;
    bytes clean = make_png(&(png_description){2, 1, 8, 0, 0, 0, "\0\1", 0, 2, "\0\1\2", 3});
    bytes file = {.length = 0};
    add(&file, clean.data, 33);
    add_png_chunk(&file, "iTXt", "XML:com.adobe.xmp\0\0\0\0\0<a><a><a>", 31);
    add_png_chunk(&file, "iCCP", "profile\0\0not deflated", 21);
    add(&file, clean.data + 33, clean.length - 33);
    add(&file, "trailing", 8);
    lsf_texture_image image = decode(file.data, file.length);
    assert_int_equal(image.channels, 2);
    assert_memory_equal(image.texels, "\1\0\2\xff", 4);
    free(image.texels);
    assert_int_equal(lsf_png_without_metadata(file.data, file.length), clean.length);
    assert_memory_equal(file.data, clean.data, clean.length);
}

static void test_bombs_are_refused_before_memory_is_taken(void **state)
{
    (void)state;
    struct rusage before, after;
    getrusage(RUSAGE_SELF, &before);
    bytes png = make_png(&(png_description){60000, 60000, 8, 6, 0, 0, 0, 0, 0, "", 0});
    refuse(png.data, png.length, "would take more");
    png = make_png(&(png_description){20000, 20000, 8, 2, 0, 0, 0, 0, 0, "", 0});
    refuse(png.data, png.length, "more than its");
    png = make_png(&(png_description){70000, 1, 1, 0, 0, 0, 0, 0, 0, "", 0});
    refuse(png.data, png.length, "at most 65535");
    png = make_png(&(png_description){0, 5, 8, 2, 0, 0, 0, 0, 0, "", 0});
    refuse(png.data, png.length, "no pixels");
    const char *hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 20000 +X 8000\n";
    refuse(hdr, strlen(hdr), "more than its");
    getrusage(RUSAGE_SELF, &after);
    assert_true(after.ru_maxrss - before.ru_maxrss < 64 * 1024);
}

static void test_decoding_respects_the_limit(void **state)
{
    (void)state;
    lsf_image_header header;
    assert_true(lsf_image_header_read(&header, jpeg_file, sizeof jpeg_file, 1 << 20, "", NULL));
    assert_true(header.working_bytes == 0);
    uint8_t progressive[sizeof jpeg_file];
    memcpy(progressive, jpeg_file, sizeof progressive);
    uint8_t *frame = memmem(progressive, sizeof progressive, "\xff\xc0\x00\x11", 4);
    assert_non_null(frame);
    frame[1] = 0xc2;
    uint64_t coefficients = 32 * 32 * 3 * 2; /* 16 x 8 pixels, as if in 4 x 4 blocks */
    uint64_t needed = sizeof jpeg_file + 16 * 8 * 3 + coefficients;
    assert_true(lsf_image_header_read(&header, progressive, sizeof progressive, needed, "", NULL));
    assert_true(header.working_bytes == coefficients);
    lsf_error error = {0};
    assert_false(
        lsf_image_header_read(&header, progressive, sizeof progressive, needed - 1, "", &error));
    assert_non_null(strstr(error.message, "memory limit"));

    bytes png = make_png(&(png_description){8, 8, 8, 2, 1, 0, 0, 0, 0, "", 0});
    assert_true(lsf_image_header_read(&header, png.data, png.length, 1 << 20, "", NULL));
    assert_true(header.working_bytes == 8 * 8 * 3);

    static const char *const names[] = {"R", "G", "B"};
    lsf_image *image = lsf_image_create(4, 2, 3, names, NULL);
    assert_non_null(image);
    assert_true(lsf_image_save(image, in_folder("limit.exr"), NULL, NULL));
    lsf_image_destroy(image);
    lsf_environment environment = {0};
    uint64_t repaired;
    assert_false(
        lsf_environment_load(&environment, in_folder("limit.exr"), 1 << 20, &repaired, &error));
    assert_non_null(strstr(error.message, "memory limit"));
    assert_null(environment.texels);
}

static void test_other_kinds_are_refused(void **state)
{
    (void)state;
    refuse("", 0, "not a PNG, JPEG, WebP, HDR or EXR");
    refuse("GIF89a", 6, "not a PNG, JPEG, WebP, HDR or EXR");
    refuse("II*\0aaaaaaaa", 12, "not a PNG, JPEG, WebP, HDR or EXR");
    const char *xyze = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd";
    refuse(xyze, strlen(xyze), "xyze");
    const char *turned = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n+X 1 -Y 1\nabcd";
    refuse(turned, strlen(turned), "row order");
}

/* A picture saved in `format`, as bytes; the caller frees. */
static char *saved_file(const char *name, size_t *length)
{
    static const char *const names[] = {"R", "G", "B", "depth.Z"};
    lsf_image *image = lsf_image_create(31, 40, strstr(name, ".exr") ? 4 : 3, names, NULL);
    assert_non_null(image);
    for (uint32_t i = 0; i < 31 * 40 * image->channel_count; i++)
        image->pixels[i] = (float)(i * 7919 % 1009) / 500.0f;
    lsf_error error = {0};
    if (!lsf_image_save(image, in_folder(name), NULL, &error))
        fail_msg("%s", error.message);
    lsf_image_destroy(image);
    char *file = lsf_file_read(in_folder(name), 1 << 24, length, NULL);
    assert_non_null(file);
    return file;
}

static void test_exr_kinds(void **state)
{
    (void)state;
    size_t length;
    char *file = saved_file("a.exr", &length);
    lsf_texture_image image = decode(file, length);
    assert_int_equal(image.channels, 3); /* depth is no colour */
    assert_int_equal(image.type, LSF_TEXEL_F32);
    assert_true(((float *)image.texels)[1] == 7919 % 1009 / 500.0f);
    free(image.texels);

    file[5] |= 0x08;
    refuse(file, length, "deep data");
    file[5] = 0x10;
    refuse(file, length, "several parts");
    file[5] = 0;
    file[4] = 3;
    refuse(file, length, "version 3");
    file[4] = 2;
    char *window = memmem(file, length, "dataWindow", 10);
    assert_non_null(window);
    window += strlen("dataWindow.box2i.") + 4;
    int32_t corner[2] = {19999, 19999};
    memcpy(window + 8, corner, 8);
    refuse(file, length, "table of chunks");
    memcpy(window + 8, (int32_t[]){30, -5}, 8);
    refuse(file, length, "empty data window");
    memcpy(window, (int32_t[]){INT32_MIN, INT32_MIN, INT32_MAX, INT32_MAX}, 16);
    refuse(file, length, "");
    free(file);
}

static void test_cut_files_are_refused(void **state)
{
    (void)state;
    for (size_t cut = 0; cut < sizeof jpeg_file; cut++)
        refuse(jpeg_file, cut, "");
    static const char *const names[] = {"cut.png", "cut.hdr", "cut.exr"};
    for (size_t n = 0; n < LSF_COUNT(names); n++) {
        size_t length;
        char *file = saved_file(names[n], &length);
        for (size_t cut = 0; cut < length; cut += cut < 400 ? 1 : 97) {
            char *part = malloc(cut + 1); /* so that the sanitizer sees each byte too many */
            assert_non_null(part);
            memcpy(part, file, cut);
            refuse(part, cut, "");
            free(part);
        }
        refuse(file, length - 1, "");
        free(file);
    }
}

static void test_damaged_files_end_well(void **state)
{
    (void)state;
    static const char *const names[] = {"bad.png", "bad.hdr", "bad.exr", NULL};
    uint32_t random = 7;
    for (size_t n = 0; n < LSF_COUNT(names); n++) {
        size_t length = sizeof jpeg_file;
        char *file =
            names[n] ? saved_file(names[n], &length) : memcpy(malloc(length), jpeg_file, length);
        for (int round = 0; round < 150; round++) {
            random = random * 1664525u + 1013904223u;
            /* Half of the damage goes into the header. */
            size_t at = (random >> 8) % (round % 2 && length > 400 ? 400 : length);
            char kept = file[at];
            file[at] = (char)(kept ^ (round % 3 ? 1 << (random >> 5 & 7) : 0xff));
            try_decode(file, length);
            file[at] = kept;
        }
        assert_true(try_decode(file, length));
        free(file);
    }
}

static void test_bad_values_are_repaired_and_counted(void **state)
{
    (void)state;
    static const char *const names[] = {"R", "G", "B"};
    lsf_image *image = lsf_image_create(4, 2, 3, names, NULL);
    assert_non_null(image);
    for (int i = 0; i < 24; i++)
        image->pixels[i] = 1.0f;
    image->pixels[3] = NAN;
    image->pixels[7] = -INFINITY;
    image->pixels[11] = -2.0f;
    assert_true(lsf_image_save(image, in_folder("sky.exr"), NULL, NULL));
    lsf_image_destroy(image);

    lsf_environment environment = {0};
    uint64_t repaired = 0;
    assert_true(lsf_environment_load(&environment, in_folder("sky.exr"), 1 << 27, &repaired, NULL));
    assert_true(environment.present);
    assert_int_equal(repaired, 3);
    assert_true(environment.texels[3] == 0 && environment.texels[11] == 0);
    assert_true(environment.texels[23] == 1);
    free(environment.texels);

    size_t length;
    char *file = lsf_file_read(in_folder("sky.exr"), 1 << 20, &length, NULL);
    lsf_texture_image texture = decode(file, length);
    free(file);
    assert_int_equal(texture.non_finite, 2);
    assert_true(((float *)texture.texels)[11] == -2.0f);
    free(texture.texels);
}

static void test_paths_that_are_no_files(void **state)
{
    (void)state;
    lsf_error error = {0};
    assert_null(lsf_image_load(test_folder, &error));
    assert_int_equal(error.code, LSF_ERROR_FILE);
    assert_null(lsf_image_load("/dev/zero", &error));
    assert_null(lsf_image_load(in_folder("missing.png"), &error));
    assert_non_null(strstr(error.message, "missing.png"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_missing_module_is_named),
        cmocka_unit_test(test_png_kinds),
        cmocka_unit_test(test_grey_files_become_rgb_images),
        cmocka_unit_test(test_jpeg),
        cmocka_unit_test(test_jpeg_metadata_is_not_decoded),
        cmocka_unit_test(test_png_metadata_is_not_decoded),
        cmocka_unit_test(test_bombs_are_refused_before_memory_is_taken),
        cmocka_unit_test(test_decoding_respects_the_limit),
        cmocka_unit_test(test_other_kinds_are_refused),
        cmocka_unit_test(test_exr_kinds),
        cmocka_unit_test(test_cut_files_are_refused),
        cmocka_unit_test(test_damaged_files_end_well),
        cmocka_unit_test(test_bad_values_are_repaired_and_counted),
        cmocka_unit_test(test_paths_that_are_no_files),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
