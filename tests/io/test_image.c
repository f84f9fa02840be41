/* Images to files and back, and what is left when writing fails. */
#include "image_files.h"

#include "io/io.h"
#include "shared/tonemap.h"

#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

/* Values from 1e-6 to 1e4 in a fixed sequence. */
static float next_value(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return powf(10.0f, (float)(*state >> 8) / 16777216.0f * 10.0f - 6.0f);
}

static lsf_image *make_image(uint32_t width, uint32_t height, uint32_t channel_count)
{
    static const char *const names[] = {"R",        "G",        "B",        "albedo.R", "albedo.G",
                                        "albedo.B", "normal.X", "normal.Y", "normal.Z", "depth.Z"};
    lsf_image *image = lsf_image_create(width, height, channel_count, names, NULL);
    assert_non_null(image);
    uint32_t state = 1;
    for (uint64_t i = 0; i < (uint64_t)width * height * channel_count; i++)
        image->pixels[i] = next_value(&state);
    return image;
}

static float value_at(const lsf_image *image, uint64_t pixel, const char *name)
{
    int channel = lsf_image_channel(image, name);
    assert_true(channel >= 0);
    return image->pixels[pixel * image->channel_count + (uint32_t)channel];
}

static void save(const lsf_image *image, const char *path)
{
    lsf_error error = {0};
    if (!lsf_image_save(image, path, NULL, &error))
        fail_msg("%s", error.message);
}

static lsf_image *load(const char *path)
{
    lsf_error error = {0};
    lsf_image *image = lsf_image_load(path, &error);
    if (!image)
        fail_msg("%s", error.message);
    return image;
}

static char *read_file(const char *path, size_t *length)
{
    lsf_error error = {0};
    char *content = lsf_file_read(path, 1 << 24, length, &error);
    if (!content)
        fail_msg("%s", error.message);
    return content;
}

static void test_exr_keeps_every_bit_and_layer(void **state)
{
    (void)state;
    static const float odd[] = {NAN, INFINITY, -INFINITY, -0.0f, 1e-45f, -1e30f, 3.4e38f};
    lsf_image *image = make_image(37, 23, 10);
    memcpy(image->pixels, odd, sizeof odd);
    save(image, in_folder("layers.exr"));
    lsf_image *read = load(in_folder("layers.exr"));
    assert_int_equal(read->width, 37);
    assert_int_equal(read->height, 23);
    assert_int_equal(read->channel_count, 10);
    for (uint32_t c = 0; c < 10; c++) {
        int found = lsf_image_channel(read, image->channel_names[c]);
        assert_true(found >= 0);
        for (uint64_t i = 0; i < 37 * 23; i++)
            assert_memory_equal(&image->pixels[i * 10 + c], &read->pixels[i * 10 + (uint32_t)found],
                                4);
    }
    lsf_image_destroy(read);

    save(image, in_folder("again.exr"));
    size_t length, length_again;
    char *file = read_file(in_folder("layers.exr"), &length);
    char *again = read_file(in_folder("again.exr"), &length_again);
    assert_int_equal(length, length_again);
    assert_memory_equal(file, again, length);
    free(file);
    free(again);
    lsf_image_destroy(image);
}

static void test_hdr_is_rounded_to_its_precision(void **state)
{
    (void)state;
    lsf_image *image = make_image(64, 64, 3);
    image->pixels[0] = image->pixels[1] = image->pixels[2] = 255.9f; /* rounds to the next power */
    save(image, in_folder("a.hdr"));
    lsf_image *read = load(in_folder("a.hdr"));
    double error_sum = 0.0;
    for (uint64_t i = 0; i < 64 * 64; i++) {
        const float *x = image->pixels + 3 * i, *y = read->pixels + 3 * i;
        float peak = fmaxf(x[0], fmaxf(x[1], x[2]));
        for (int c = 0; c < 3; c++) {
            assert_true(fabsf(x[c] - y[c]) <= peak / 256.0f);
            error_sum += (y[c] - x[c]) / peak;
        }
    }
    /* Cutting instead of rounding would give about -0.0027 here. */
    assert_true(fabs(error_sum / (3 * 64 * 64)) < 1e-4);
    assert_true(read->pixels[0] == 256.0f);
    lsf_image_destroy(read);

    save(image, in_folder("b.hdr"));
    lsf_image_destroy(image);
}

static void test_png_is_tone_mapped(void **state)
{
    (void)state;
    lsf_image *image = make_image(40, 30, 3);
    image->pixels[0] = NAN;
    image->pixels[4] = INFINITY;
    image->pixels[8] = -3.0f;
    lsf_image_save_params params = {LSF_IMAGE_SAVE_PARAMS_DEFAULTS};
    params.exposure = -2.0f;
    assert_true(lsf_image_save(image, in_folder("a.png"), &params, NULL));
    size_t length;
    char *file = read_file(in_folder("a.png"), &length);
    lsf_texture_image texture = {0};
    assert_true(lsf_texture_image_decode(&texture, file, length, 1 << 20, "a.png", NULL));
    free(file);
    assert_int_equal(texture.channels, 3);
    assert_int_equal(texture.type, LSF_TEXEL_U8);
    const uint8_t *codes = texture.texels;
    for (uint64_t i = 0; i < 40 * 30; i++) {
        float rgb[3];
        for (int c = 0; c < 3; c++)
            rgb[c] = lsf_tonemap_expose(image->pixels[3 * i + (uint64_t)c], 0.25f);
        float smallest = fminf(rgb[0], fminf(rgb[1], rgb[2]));
        float largest = fmaxf(rgb[0], fmaxf(rgb[1], rgb[2]));
        for (int c = 0; c < 3; c++)
            assert_int_equal(codes[3 * i + (uint64_t)c],
                             (int)(lsf_tonemap_display(rgb[c], smallest, largest) * 255 + 0.5f));
    }
    uint8_t rgb8[40 * 30 * 3];
    assert_true(lsf_image_to_rgb8(image, -2.0f, LSF_TONE_CURVE_NEUTRAL, rgb8, NULL));
    assert_memory_equal(rgb8, codes, sizeof rgb8);
    free(texture.texels);
    lsf_image_destroy(image);
    static const char *const grey[] = {"Y"};
    lsf_error error = {0};
    image = lsf_image_create(1, 1, 1, grey, &error);
    assert_false(lsf_image_to_rgb8(image, 0.0f, LSF_TONE_CURVE_NEUTRAL, rgb8, &error));
    assert_int_equal(error.code, LSF_ERROR_FILE);
    lsf_image_destroy(image);
}

static void test_integers_are_decoded_from_srgb(void **state)
{
    (void)state;
    uint8_t codes[256 * 3];
    for (int i = 0; i < 256 * 3; i++)
        codes[i] = (uint8_t)(i / 3);
    assert_true(lsf_image_save_rgb8(codes, 16, 16, in_folder("ramp.png"), NULL, NULL));
    lsf_image *image = load(in_folder("ramp.png"));
    for (int i = 0; i < 256; i++) {
        double s = i / 255.0;
        double linear = s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
        for (int c = 0; c < 3; c++)
            assert_true(image->pixels[3 * i + c] == (float)linear);
    }
    lsf_image_destroy(image);
}

static void test_standard_output_and_pipes(void **state)
{
    (void)state;
    lsf_image *image = make_image(9, 7, 3);
    save(image, in_folder("file.exr"));
    fflush(stdout);
    int kept = dup(STDOUT_FILENO);
    int file = open(in_folder("stdout.exr"), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(file, STDOUT_FILENO);
    close(file);
    bool saved = lsf_image_save(image, "-", NULL, NULL);
    dup2(kept, STDOUT_FILENO);
    close(kept);
    assert_true(saved);
    size_t length, piped_length;
    char *expected = read_file(in_folder("file.exr"), &length);
    char *piped = read_file(in_folder("stdout.exr"), &piped_length);
    assert_int_equal(length, piped_length);
    assert_memory_equal(expected, piped, length);
    free(piped);

    int ends[2];
    char path[32];
    assert_int_equal(pipe(ends), 0);
    snprintf(path, sizeof path, "/dev/fd/%d", ends[1]);
    assert_true(lsf_file_write(path, expected, length, NULL));
    piped = malloc(length);
    assert_non_null(piped);
    assert_int_equal(read(ends[0], piped, length), length);
    assert_memory_equal(expected, piped, length);
    close(ends[0]);
    close(ends[1]);
    free(piped);
    free(expected);
    lsf_image_destroy(image);
    assert_true(lsf_file_write("/dev/null", "x", 1, NULL));
}

static void expect_failure(const lsf_image *image, const char *path, const char *cause)
{
    lsf_error error = {0};
    assert_false(lsf_image_save(image, path, NULL, &error));
    assert_int_equal(error.code, LSF_ERROR_FILE);
    assert_non_null(strstr(error.message, cause));
}

static void test_failures_leave_nothing_behind(void **state)
{
    (void)state;
    lsf_image *image = make_image(200, 100, 3);
    assert_true(lsf_file_write(in_folder("old.exr"), "old", 3, NULL));
    unsigned before = count_files();

    expect_failure(image, test_folder, "no image format");
    expect_failure(image, in_folder("missing/a.exr"), "create the folder");
    expect_failure(image, in_folder("a.tiff"), ".exr, .hdr or .png");
    mkdir(in_folder("folder.exr"), 0700);
    expect_failure(image, in_folder("folder.exr"), "it is a folder");
    rmdir(in_folder("folder.exr"));
    symlink("nowhere/file", in_folder("dangling.exr"));
    expect_failure(image, in_folder("dangling.exr"), "leads nowhere");
    unlink(in_folder("dangling.exr"));
    lsf_error error = {0};
    assert_false(lsf_file_write("/dev/full", "x", 1, &error));
    assert_non_null(strstr(error.message, "free some space"));

    /* The disk fills up half way. */
    struct rlimit limit, small;
    getrlimit(RLIMIT_FSIZE, &limit);
    small = limit;
    small.rlim_cur = 10000;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    bool saved = lsf_image_save(image, in_folder("old.exr"), NULL, &error);
    setrlimit(RLIMIT_FSIZE, &limit);
    assert_false(saved);
    assert_int_equal(count_files(), before);
    size_t length;
    char *old = read_file(in_folder("old.exr"), &length);
    assert_string_equal(old, "old");
    free(old);
    lsf_image_destroy(image);
}

static void test_interrupt_removes_temporaries(void **state)
{
    (void)state;
    unsigned before = count_files();
    lsf_atomic_file files[3];
    for (int i = 0; i < 3; i++)
        assert_true(lsf_atomic_file_begin(&files[i], in_folder("out"), NULL));
    assert_int_equal(count_files(), before + 3);
    lsf_atomic_file_abort(&files[0]);
    assert_int_equal(count_files(), before + 2);
    lsf_atomic_file_abort_all();
    assert_int_equal(count_files(), before);
    lsf_error error = {0};
    assert_false(lsf_atomic_file_commit(&files[1], &error));
    lsf_atomic_file_abort(&files[1]);
    lsf_atomic_file_abort(&files[2]);
}

static void test_links_stay_and_mode_follows_umask(void **state)
{
    (void)state;
    assert_true(lsf_file_write(in_folder("target"), "old", 3, NULL));
    symlink("target", in_folder("link"));
    assert_true(lsf_file_write(in_folder("link"), "new", 3, NULL));
    struct stat status;
    assert_int_equal(lstat(in_folder("link"), &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    size_t length;
    char *content = read_file(in_folder("target"), &length);
    assert_string_equal(content, "new");
    free(content);

    mode_t old = umask(027);
    assert_true(lsf_file_write(in_folder("mode"), "x", 1, NULL));
    umask(old);
    stat(in_folder("mode"), &status);
    assert_int_equal(status.st_mode & 0777, 0640);
}

/* Means that came with the pictures, or that OpenImageIO's own tool prints. */
static void test_foreign_files(void **state)
{
    (void)state;
    static const struct {
        const char *path;
        uint32_t width, height;
        double mean[3];
    } files[] = {
        {"scenes/reference/cornell_point_b0.exr", 256, 256, {0.209468, 0.178494, 0.136513}},
        {"scenes/reference/atrium_sun_b8.exr", 480, 270, {0.239185, 0.173835, 0.105422}},
        {"scenes/environments/dancing_hall_1k.hdr", 1024, 512, {0.735319, 0.699531, 0.696525}},
    };
    const char *shared = getenv("LSF_SHARED");
    for (size_t f = 0; f < LSF_COUNT(files); f++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", shared ? shared : "", files[f].path);
        if (access(path, R_OK) != 0)
            skip();
        lsf_image *image = load(path);
        assert_int_equal(image->width, files[f].width);
        assert_int_equal(image->height, files[f].height);
        uint64_t count = (uint64_t)image->width * image->height;
        for (int c = 0; c < 3; c++) {
            double sum = 0.0;
            for (uint64_t i = 0; i < count; i++)
                sum += (double)value_at(image, i, (const char *[]){"R", "G", "B"}[c]);
            assert_true(fabs(sum / (double)count - files[f].mean[c]) < 2e-6);
        }
        lsf_image_destroy(image);
    }
}

static void keep_message(lsf_log_level level, const char *message, void *user)
{
    (void)level;
    snprintf(user, 256, "%s", message);
}

/* Pixels that are not finite are counted, each once; an infinite depth is one. */
static void test_lost_pixels_are_counted(void **state)
{
    (void)state;
    char message[256] = "";
    const char *const names[4] = {"R", "G", "B", "depth.Z"};
    lsf_image *image = lsf_image_create(4, 2, 4, names, NULL);
    assert_non_null(image);
    image->pixels[3] = INFINITY;
    lsf_log_set_handler(keep_message, message);
    save(image, in_folder("finite.exr"));
    assert_string_equal(message, "");
    image->pixels[4] = NAN;
    image->pixels[5] = INFINITY;
    image->pixels[8] = -INFINITY;
    save(image, in_folder("lost.exr"));
    assert_non_null(strstr(message, "2 of 8 pixels are not finite"));
    message[0] = '\0';
    save(image, in_folder("lost.png"));
    assert_non_null(strstr(message, "2 of 8 pixels are not finite"));
    lsf_log_set_handler(NULL, NULL);
    lsf_image_destroy(image);
}

/* Half covered by what has radiance 0.5, and not covered at all. */
static void test_png_has_alpha_of_its_own(void **state)
{
    (void)state;
    static const char *const names[] = {"R", "G", "B", "A"};
    static const float pixels[8] = {0.25f, 0.125f, 0.05f, 0.5f, 0, 0, 0, 0};
    lsf_image *image = lsf_image_create(2, 1, 4, names, NULL);
    memcpy(image->pixels, pixels, sizeof pixels);
    save(image, in_folder("alpha.png"));
    save(image, in_folder("alpha.exr"));
    size_t length;
    char *file = read_file(in_folder("alpha.png"), &length);
    lsf_texture_image texture = {0};
    assert_true(lsf_texture_image_decode(&texture, file, length, 1 << 20, "alpha.png", NULL));
    free(file);
    assert_int_equal(texture.channels, 4);
    const uint8_t *codes = texture.texels;
    for (int c = 0; c < 3; c++) {
        float shown = lsf_tonemap_display(2 * pixels[c], 0.1f, 0.5f);
        assert_int_equal(codes[c], (int)(shown * 255 + 0.5f));
    }
    assert_int_equal(codes[3], 128);
    assert_int_equal(codes[7], 0);
    free(texture.texels);

    lsf_image *read = load(in_folder("alpha.exr"));
    for (uint64_t i = 0; i < 2; i++)
        for (int c = 0; c < 4; c++)
            assert_true(value_at(read, i, names[c]) == pixels[4 * i + (uint64_t)c]);
    lsf_image_destroy(read);
    lsf_image_destroy(image);
}

static void test_what_cannot_be_saved_is_known_before(void **state)
{
    (void)state;
    lsf_error error = {0};
    assert_true(lsf_image_can_save(65535, 1, in_folder("a.exr"), NULL, &error));
    assert_false(lsf_image_can_save(65536, 1, in_folder("a.exr"), NULL, &error));
    assert_non_null(strstr(error.message, "65536 x 1"));
    assert_false(lsf_image_can_save(4, 4, in_folder("a.tiff"), NULL, &error));
    assert_int_equal(error.code, LSF_ERROR_FILE);
}

static float exposure_of(const float (*rgba)[4], uint32_t count, bool alpha)
{
    static const char *const names[] = {"R", "G", "B", "A"};
    lsf_image *image = lsf_image_create(count, 1, alpha ? 4 : 3, names, NULL);
    for (uint32_t i = 0; i < count; i++)
        memcpy(image->pixels + i * image->channel_count, rgba[i],
               image->channel_count * sizeof(float));
    float exposure = lsf_image_auto_exposure(image);
    lsf_image_destroy(image);
    return exposure;
}

static void test_auto_exposure(void **state)
{
    (void)state;
    const float grey[2][4] = {{0.18f, 0.18f, 0.18f, 1}, {0.18f, 0.18f, 0.18f, 1}};
    assert_true(fabsf(exposure_of(grey, 2, false)) < 1e-6f);
    /* The geometric mean of 0.09 and 1.44 is 0.36: one stop too bright. */
    const float two[2][4] = {{0.09f, 0.09f, 0.09f, 1}, {1.44f, 1.44f, 1.44f, 1}};
    assert_true(fabsf(exposure_of(two, 2, false) + 1) < 1e-5f);
    /* Green alone has 0.7152 of the luminance. */
    const float green[1][4] = {{0, 1, 0, 1}};
    assert_true(fabsf(exposure_of(green, 1, false) - log2f(0.18f / 0.7152f)) < 1e-5f);
    /* Half a pixel of 0.36 is a pixel of 0.36, nothing is nothing, and what is lost is not there.
     */
    const float half[3][4] = {{0.18f, 0.18f, 0.18f, 0.5f}, {0, 0, 0, 0}, {NAN, 1, 1, 1}};
    assert_true(fabsf(exposure_of(half, 3, true) + 1) < 1e-5f);
    /* A little beside 0.36 counts as code value 1 at the mean's exposure, 0, and black not at all.
     */
    const float dark[4][4] = {
        {1e-9f, 1e-9f, 1e-9f, 1}, {0.36f, 0.36f, 0.36f, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}};
    float expected = log2f(0.18f) - 0.5f * log2f(0.36f * lsf_srgb_decode(1.0f / 255));
    assert_true(fabsf(exposure_of(dark, 4, false) - expected) < 1e-4f);
    assert_true(exposure_of((const float[1][4]){{0, 0, 0, 0}}, 1, false) == 0.0f);
    assert_true(exposure_of((const float[1][4]){{-1, -1, -1, 1}}, 1, false) == 0.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exr_keeps_every_bit_and_layer),
        cmocka_unit_test(test_hdr_is_rounded_to_its_precision),
        cmocka_unit_test(test_png_is_tone_mapped),
        cmocka_unit_test(test_auto_exposure),
        cmocka_unit_test(test_lost_pixels_are_counted),
        cmocka_unit_test(test_png_has_alpha_of_its_own),
        cmocka_unit_test(test_integers_are_decoded_from_srgb),
        cmocka_unit_test(test_standard_output_and_pipes),
        cmocka_unit_test(test_failures_leave_nothing_behind),
        cmocka_unit_test(test_interrupt_removes_temporaries),
        cmocka_unit_test(test_links_stay_and_mode_follows_umask),
        cmocka_unit_test(test_foreign_files),
        cmocka_unit_test(test_what_cannot_be_saved_is_known_before),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
