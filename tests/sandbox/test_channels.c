/* Pictures and cube maps as channels. */
#include "sandbox_rig.h"

#include <math.h>
#include <unistd.h>

#include "base/base.h"

static char folder[64];

static int make_folder(void **state)
{
    snprintf(folder, sizeof folder, "/tmp/lightsheaf-channels-XXXXXX");
    return mkdtemp(folder) ? sandbox_setup(state) : -1;
}

static int remove_folder(void **state)
{
    char command[128];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command) == 0 ? sandbox_teardown(state) : -1;
}

static char *location(const char *name)
{
    return lsf_format("%s/%s", folder, name);
}

/* 2 x 2: black and red above green and blue. */
static void write_png(const char *name, uint8_t red)
{
    const uint8_t rgb[] = {0, 0, 0, red, 0, 0, 0, 128, 0, 0, 0, 255};
    char *path = location(name);
    lsf_error error;
    if (!lsf_image_save_rgb8(rgb, 2, 2, path, NULL, &error))
        fail_msg("%s", error.message);
    free(path);
}

/* Its place in the picture, from the upper left, in R and G; 10 in B. */
static void write_exr(const char *name, uint32_t width, uint32_t height, float scale)
{
    static const char *const channels[] = {"R", "G", "B"};
    lsf_error error;
    lsf_image *image = lsf_image_create(width, height, 3, channels, &error);
    for (uint32_t i = 0; i < width * height; i++) {
        image->pixels[3 * i] = scale * ((float)(i % width) + 0.5f) / (float)width;
        image->pixels[3 * i + 1] = scale * ((float)(i / width) + 0.5f) / (float)height;
        image->pixels[3 * i + 2] = 10;
    }
    char *path = location(name);
    if (!lsf_image_save(image, path, NULL, &error))
        fail_msg("%s", error.message);
    lsf_image_destroy(image);
    free(path);
}

static lsf_sandbox_params params_of(const char *text)
{
    static char path[96];
    lsf_sandbox_params params = sandbox_params(text);
    snprintf(path, sizeof path, "%s/test.frag", folder);
    params.path = path;
    return params;
}

static void check(const char *text, float r, float g, float b, float tolerance)
{
    const float expected[3] = {r, g, b};
    const lsf_sandbox_params params = params_of(text);
    lsf_image *image = sandbox_picture(NULL, &params, 1);
    for (int c = 0; c < 3; c++)
        if (!(fabsf(image->pixels[c] - expected[c]) <= tolerance))
            fail_msg("%s\n%g %g %g is not %g %g %g", text, (double)image->pixels[0],
                     (double)image->pixels[1], (double)image->pixels[2], (double)r, (double)g,
                     (double)b);
    lsf_image_destroy(image);
}

#define IMAGE "void mainImage(out vec4 c, in vec2 p) "

static void test_pictures(void **state)
{
    (void)state;
    write_png("four.png", 64);
    write_exr("ramp.exr", 8, 4, 1);
    /* As code values, the lower row first; without a flip the upper one. */
    check(
        "// @channel 0 four.png\n" IMAGE "{ c = vec4(texelFetch(iChannel0, ivec2(1, 1), 0).r, "
        "texelFetch(iChannel0, ivec2(0, 0), 0).g, texelFetch(iChannel0, ivec2(1, 0), 0).b, 1.0); }",
        64 / 255.0f, 128 / 255.0f, 1, 1e-6f);
    check("// @channel 2 four.png flip=no\n" IMAGE
          "{ c = texelFetch(iChannel2, ivec2(1, 0), 0) + vec4(0.0, 0.0, iChannelResolution[2].x, "
          "0.0); }",
          64 / 255.0f, 0, 2, 1e-6f);
    /* Beyond the edge, by each way to wrap. */
    check(
        "// @channel 0 four.png filter=nearest\n// @channel 1 four.png filter=nearest wrap=clamp\n"
        "// @channel 2 four.png filter=nearest wrap=mirror\n" IMAGE
        "{ vec2 q = vec2(1.25, 0.25); c = vec4(texture(iChannel0, q).g, texture(iChannel1, q).b, "
        "texture(iChannel2, q).b, 1.0); }",
        128 / 255.0f, 1, 1, 1e-6f);
    /* The mean of all texels. */
    check("// @channel 0 four.png\n" IMAGE "{ c = textureLod(iChannel0, vec2(0.5), 9.0); }",
          16 / 255.0f, 32 / 255.0f, 64 / 255.0f, 0.004f);
    check("// @channel 3 ramp.exr filter=linear wrap=clamp\n" IMAGE
          "{ c = texture(iChannel3, vec2(0.5, 0.75)); }",
          0.5f, 0.25f, 10, 1e-5f);
}

static void test_cubes(void **state)
{
    (void)state;
    /* u = 0.5 + atan2(z, x) / 2 pi, v = 0 above. */
    write_exr("sky.exr", 64, 32, 1);
    check("// @channel 0 cube sky.exr filter=linear\n" IMAGE
          "{ c = vec4(texture(iChannel0, vec3(1.0, 0.0, 0.0)).r, texture(iChannel0, vec3(0.0, 0.0, "
          "1.0)).r, texture(iChannel0, vec3(0.0, 1.0, 0.0)).g, 1.0); }",
          0.5f, 0.75f, 0, 0.04f);
    check(
        "// @channel 0 cube sky.exr filter=linear\n" IMAGE
        "{ c = vec4(texture(iChannel0, vec3(0.0, 0.0, -1.0)).r, texture(iChannel0, vec3(0.0, -1.0, "
        "0.0)).g, texture(iChannel0, vec3(1.0, 1.0, 0.0)).g, 1.0); }",
        0.25f, 1, 0.25f, 0.04f);
    static const char *const faces[] = {"px", "nx", "py", "ny", "pz", "nz"};
    for (int i = 0; i < 6; i++) {
        char name[32];
        snprintf(name, sizeof name, "face_%s.exr", faces[i]);
        write_exr(name, 4, 4, (float)i);
    }
    check(
        "// @channel 0 cube face_%s.exr filter=linear\n" IMAGE
        "{ c = vec4(texture(iChannel0, vec3(-1.0, 0.0, 0.0)).r, texture(iChannel0, vec3(0.0, -1.0, "
        "0.0)).r, texture(iChannel0, vec3(0.0, 0.0, -1.0)).g, 1.0); }",
        0.5f, 1.5f, 2.5f, 1e-5f);
}

static void test_what_the_caller_says(void **state)
{
    (void)state;
    static const char *const channels[] = {"0=noise", "0=previous"};
    write_png("four.png", 64);
    lsf_sandbox_params params =
        params_of("// @channel 0 four.png\n" IMAGE "{ c = texture(iChannel0, p) + 1.0; }");
    params.channels = channels;
    params.channel_count = 2;
    lsf_image *image = sandbox_picture(NULL, &params, 3);
    assert_true(image->pixels[0] == 3);
    lsf_image_destroy(image);
    static const char *const wrong[] = {"4=noise", "e:0=noise", "noise", "0=", "a:"};
    for (size_t i = 0; i < LSF_COUNT(wrong); i++) {
        params.channels = &wrong[i];
        params.channel_count = 1;
        sandbox_refuse(NULL, &params, "channel ");
    }
}

/* A picture that is saved anew is read anew; one that is gone leaves the last one. */
static void test_changes(void **state)
{
    (void)state;
    write_png("four.png", 64);
    const lsf_sandbox_params params = params_of("// @channel 0 four.png\n" IMAGE
                                                "{ c = texelFetch(iChannel0, ivec2(1, 1), 0); }");
    lsf_sandbox *sandbox = sandbox_make(NULL, &params);
    const lsf_sandbox_frame frame = {LSF_SANDBOX_FRAME_DEFAULTS};
    uint8_t rgb[64 * 64 * 3];
    lsf_error error;
    for (int i = 0; i < 3; i++) {
        uint8_t red = i == 0 ? 64 : 192;
        if (i == 1)
            write_png("four.png", red);
        char *path = location("four.png");
        if (i == 2)
            unlink(path);
        free(path);
        assert_int_equal(lsf_sandbox_changed(sandbox), i > 0);
        assert_int_equal(i == 0 || lsf_sandbox_reload(sandbox, &error), i < 2);
        assert_true(lsf_sandbox_run(sandbox, &frame, &error));
        assert_true(lsf_sandbox_read_rgb8(sandbox, 0, LSF_TONE_CURVE_NONE, rgb, &error));
        assert_int_equal(rgb[0], red);
    }
    lsf_sandbox_destroy(sandbox);
    assert_int_equal(lsf_context_get_info(sandbox_context).gl_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pictures), cmocka_unit_test(test_cubes),
        cmocka_unit_test(test_what_the_caller_says), cmocka_unit_test(test_changes)};
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
