/* What a shader without a scene is given, and what becomes of what it writes. */
#include "sandbox_rig.h"

#include <math.h>
#include <unistd.h>

#include "base/base.h"

#define IMAGE "void mainImage(out vec4 c, in vec2 p)\n"

static void test_uniforms(void **state)
{
    (void)state;
    sandbox_assert_pixel(NULL, IMAGE "{ c = vec4(p / iResolution.xy, iResolution.z, 1.0); }", 1, 3,
                         5, 3.5f / 64, 5.5f / 64, 1, 1e-6f);
    sandbox_assert_pixel(NULL, IMAGE "{ c = vec4(iTime, iFrame, iTimeDelta * iFrameRate, 1.0); }",
                         4, 0, 0, 0.05f, 3, 1, 1e-6f);
    sandbox_assert_pixel(
        NULL, IMAGE "{ c = vec4(iSampleRate, iChannelTime[2], iChannelResolution[1].x, 1.0); }", 1,
        0, 0, 44100, 0, 1, 1e-6f);
}

static void test_main_of_its_own(void **state)
{
    (void)state;
    sandbox_assert_pixel(
        NULL,
        "#version 330\n"
        "precision highp float;\n"
        "uniform vec3 iResolution;\n"
        "out vec4 color;\n"
        "void main() { color = vec4(gl_FragCoord.xy / iResolution.xy, 2.0, 1.0); }",
        1, 31, 0, 31.5f / 64, 0.5f / 64, 2, 1e-6f);
    sandbox_assert_pixel(NULL,
                         "\xef\xbb\xbf// with a mark of UTF-8; says so behind #version, too\r\n"
                         "#extension GL_ARB_shader_ballot : enable\n"
                         "layout(location = 0) out vec4 color;\n"
                         "void main() { color = vec4(0.25); }",
                         1, 0, 0, 0.25f, 0.25f, 0.25f, 0);
}

static void test_compute(void **state)
{
    (void)state;
    lsf_sandbox_params params = sandbox_params("layout(local_size_x = 7, local_size_y = 3) in;\n"
                                               "void main() {\n"
                                               "    ivec2 p = ivec2(gl_GlobalInvocationID.xy);\n"
                                               "    imageStore(iOutput, p, vec4(p, iFrame, 1.0));\n"
                                               "}");
    params.path = "test.comp";
    lsf_image *image = sandbox_picture(NULL, &params, 2);
    const float *last = image->pixels + 3 * 63; /* upper right */
    assert_true(last[0] == 63 && last[1] == 63 && last[2] == 1);
    lsf_image_destroy(image);
}

/* A counts frames, B reads what A has just written, C what D wrote a frame before. */
static void test_buffers(void **state)
{
    (void)state;
    sandbox_assert_pixel(
        NULL,
        "vec4 read(sampler2D s) { return texelFetch(s, ivec2(0), 0); }\n"
        "// @buffer a\n"
        "// @channel 0 a\n" IMAGE "{ c = read(iChannel0) + 1.0; }\n"
        "// @buffer b\n"
        "// @channel 0 a\n" IMAGE "{ c = 10.0 * read(iChannel0); }\n"
        "// @buffer c\n"
        "// @channel 0 d\n" IMAGE "{ c = read(iChannel0); }\n"
        "// @buffer d\n" IMAGE "{ c = vec4(iFrame); }\n"
        "// @image\n"
        "// @channel 0 a\n// @channel 1 b\n// @channel 2 c\n" IMAGE
        "{ c = vec4(read(iChannel0).r, read(iChannel1).r, read(iChannel2).r, 1.0); }",
        5, 9, 9, 5, 50, 3, 0);
    sandbox_assert_pixel(
        NULL,
        "// @channel 3 previous filter=nearest wrap=mirror\n" IMAGE
        "{ c = vec4(texture(iChannel3, p / iResolution.xy).rg + vec2(1.0, p.x), 0.0, 1.0); }",
        3, 8, 0, 3, 25.5f, 0, 1e-4f);
}

static void test_keyboard(void **state)
{
    (void)state;
    const lsf_sandbox_params params = sandbox_params(
        "// @channel 0 keyboard\n" IMAGE
        "{ c = vec4(texelFetch(iChannel0, ivec2(65, 0), 0).r, texelFetch(iChannel0, ivec2(65, 1), "
        "0).r, texelFetch(iChannel0, ivec2(66, 2), 0).r, 1.0); }");
    lsf_sandbox *sandbox = sandbox_make(NULL, &params);
    uint8_t keys[3][LSF_SANDBOX_KEYS] = {{[65] = 1}, {[65] = 0}, {[66] = 1}};
    lsf_sandbox_frame frame = {LSF_SANDBOX_FRAME_DEFAULTS};
    frame.keys = (const uint8_t(*)[LSF_SANDBOX_KEYS])keys;
    uint8_t rgb[64 * 64 * 3];
    lsf_error error = {0};
    assert_true(lsf_sandbox_run(sandbox, &frame, &error));
    assert_true(lsf_sandbox_read_rgb8(sandbox, 0, LSF_TONE_CURVE_NONE, rgb, &error));
    assert_true(rgb[0] == 255 && rgb[1] == 0 && rgb[2] == 255);
    lsf_sandbox_destroy(sandbox);
}

static void test_noise(void **state)
{
    (void)state;
    float rgb[3];
    sandbox_pixel(NULL,
                  "// @channel 0 noise\n" IMAGE
                  "{ vec4 s = vec4(0.0); for (int i = 0; i < 65536; i++) s += "
                  "texelFetch(iChannel0, ivec2(i & 255, i >> 8), 0); c = s / 65536.0; }",
                  1, 0, 0, rgb);
    for (int c = 0; c < 3; c++)
        assert_true(fabsf(rgb[c] - 0.5f) < 0.006f); /* five standard deviations of the mean */
}

static void test_uniforms_of_its_own(void **state)
{
    (void)state;
    static const char *const values[] = {"shift=0.5,0.25", "count=3"};
    lsf_sandbox_params params = sandbox_params("uniform float level = 0.125; // @slider 0 2\n"
                                               "// @slider -1 1\n"
                                               "uniform highp vec2 shift;\n"
                                               "uniform int count;\n" IMAGE
                                               "{ c = vec4(shift + float(count), level, 1.0); }");
    params.uniforms = values;
    params.uniform_count = 2;
    lsf_sandbox *sandbox = sandbox_make(NULL, &params);
    lsf_sandbox_uniform uniform;
    assert_true(lsf_sandbox_get_uniform(sandbox, 0, &uniform));
    assert_string_equal(uniform.name, "level");
    assert_true(uniform.slider && uniform.minimum == 0 && uniform.maximum == 2);
    assert_true(uniform.components == 1 && uniform.value[0] == 0.125f);
    assert_true(lsf_sandbox_get_uniform(sandbox, 1, &uniform));
    assert_true(uniform.slider && uniform.minimum == -1 && uniform.components == 2);
    assert_true(uniform.value[0] == 0.5f && uniform.value[1] == 0.25f);
    assert_true(lsf_sandbox_get_uniform(sandbox, 2, &uniform));
    assert_true(!uniform.slider && uniform.integer && uniform.value[0] == 3);
    assert_false(lsf_sandbox_get_uniform(sandbox, 3, &uniform));
    lsf_error error = {0};
    const float none[4] = {0};
    assert_false(lsf_sandbox_set_uniform(sandbox, "levl", none, &error));
    assert_non_null(strstr(error.message, "level, shift, count"));
    lsf_sandbox_destroy(sandbox);
    static const char *const wrong[] = {"shift=1"};
    params.uniforms = wrong;
    params.uniform_count = 1;
    sandbox_refuse(NULL, &params, "uniform shift=1: expected 2 numbers");
}

static void test_radiance(void **state)
{
    (void)state;
    const lsf_sandbox_params params =
        sandbox_params("// @output radiance\n" IMAGE "{ c = vec4(0.25); }");
    lsf_sandbox *sandbox = sandbox_make(NULL, &params);
    const lsf_sandbox_frame frame = {LSF_SANDBOX_FRAME_DEFAULTS};
    uint8_t rgb[64 * 64 * 3];
    lsf_error error = {0};
    assert_true(lsf_sandbox_writes_radiance(sandbox));
    assert_true(lsf_sandbox_run(sandbox, &frame, &error));
    assert_true(lsf_sandbox_read_rgb8(sandbox, 1, LSF_TONE_CURVE_NONE, rgb, &error));
    assert_int_equal(rgb[0], 188); /* sRGB of 0.5 */
    lsf_sandbox_destroy(sandbox);
}

/* Reads the shader from a file again when that changes; one that is wrong leaves the last good one.
 */
static void test_reload(void **state)
{
    (void)state;
    char folder[] = "/tmp/lightsheaf-sandbox-XXXXXX", path[64], part[64];
    unsetenv(
        "MESA_SHADER_DUMP_PATH"); /* for tests/shaders: from here on much is wrong on purpose */
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/live.frag", folder);
    snprintf(part, sizeof part, "%s/part.glsl", folder);
    lsf_error error = {0};
    const char good[] =
        "#include \"part.glsl\"\nuniform float gain = 1.0;\n" IMAGE "{ c = vec4(part() * gain); }";
    const struct {
        const char *path, *text, *says;
        float expected;
    } steps[] = {
        {path, "void mainImage(", "/live.frag:1: ", 3},
        {path, good, NULL, 3},
        {part, "float part() { return x; }\n", "/part.glsl:1: ", 3},
        {part, "float part() { return 7.0; }", NULL, 21},
    };
    assert_true(lsf_file_write(part, "float part() { return 1.0; }", 28, &error));
    assert_true(lsf_file_write(path, good, strlen(good), &error));
    lsf_sandbox_params params = sandbox_params(NULL);
    params.path = path;
    lsf_sandbox *sandbox = sandbox_make(NULL, &params);
    const float gain[4] = {3};
    assert_true(lsf_sandbox_set_uniform(sandbox, "gain", gain, &error));
    for (size_t i = 0; i < LSF_COUNT(steps); i++) {
        assert_false(lsf_sandbox_changed(sandbox));
        assert_true(lsf_file_write(steps[i].path, steps[i].text, strlen(steps[i].text), &error));
        assert_true(lsf_sandbox_changed(sandbox));
        assert_int_equal(lsf_sandbox_reload(sandbox, &error), steps[i].says == NULL);
        if (steps[i].says)
            assert_non_null(strstr(error.message, steps[i].says));
        const lsf_sandbox_frame frame = {LSF_SANDBOX_FRAME_DEFAULTS};
        assert_true(lsf_sandbox_run(sandbox, &frame, &error));
        lsf_image *image = lsf_sandbox_read(sandbox, &error);
        assert_true(image->pixels[0] == steps[i].expected);
        lsf_image_destroy(image);
    }
    unlink(path); /* gone while it runs */
    assert_true(lsf_sandbox_changed(sandbox));
    assert_false(lsf_sandbox_reload(sandbox, &error));
    assert_int_equal(error.code, LSF_ERROR_FILE);
    assert_true(lsf_sandbox_resize(sandbox, 64, 64, &error) == false); /* nothing to make it of */
    unlink(part);
    rmdir(folder);
    lsf_sandbox_destroy(sandbox);
}

static void test_errors(void **state)
{
    (void)state;
    static const struct {
        const char *text, *says;
    } cases[] = {
        {"\n" IMAGE "{\n    c = vec4(x);\n}",
         "test.frag:4: error: `x' undeclared\n    c = vec4(x);"},
        {"\nfloat f();\n" IMAGE "{ c = vec4(f()); }",
         "test.frag did not link:\ntest.frag:2: error: unresolved reference to function `f'\n    "
         "float f();"},
        {"void mainimage() {}", "test.frag:1: there is neither void mainImage("},
        {"#include \"none.glsl\"\n" IMAGE "{}", "test.frag:1: #include: none.glsl: "},
        {"\n#include <lightsheaf/none.glsl>\n" IMAGE "{}",
         "test.frag:2: #include <lightsheaf/none.glsl>: the library has no such file"},
        {"#include <stdio.h>\n" IMAGE "{}", "test.frag:1: write #include"},
        {"// @channel 4 noise\n" IMAGE "{}", "test.frag:1: @channel: write"},
        {"\n// @channel 0 none.png\n" IMAGE "{ c = texture(iChannel0, p); }",
         "test.frag:2: @channel: "},
        {"// @channel 0 b\n" IMAGE "{ c = texture(iChannel0, p); }",
         "test.frag:1: there is no buffer b"},
        {"// @channel 0 noise wrap=round\n" IMAGE "{ c = texture(iChannel0, p); }",
         "test.frag:1: wrap=round: expected wrap=repeat"},
        {"// @slider 1 0\nuniform float x;\n" IMAGE "{ c = vec4(x); }", "test.frag:1: @slider: "},
        {"uniform vec2 iResolution;\n" IMAGE "{ c = iResolution.xyxy; }",
         "test.frag:1: declare uniform vec3 iResolution;"},
        {IMAGE "{ c = vec4(lsf_depth(p)); }", "test.frag:2: lsf_depth needs a scene"},
        {"// @buffer a\n" IMAGE "{}", "test.frag: there are buffers, but no picture"},
        {"// @image\n" IMAGE "{}\n// @image\n" IMAGE "{}", "test.frag:4: image is there already"},
    };
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        const lsf_sandbox_params params = sandbox_params(cases[i].text);
        sandbox_refuse(NULL, &params, cases[i].says);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_uniforms),
        cmocka_unit_test(test_main_of_its_own),
        cmocka_unit_test(test_compute),
        cmocka_unit_test(test_buffers),
        cmocka_unit_test(test_keyboard),
        cmocka_unit_test(test_noise),
        cmocka_unit_test(test_uniforms_of_its_own),
        cmocka_unit_test(test_radiance),
        cmocka_unit_test(test_reload),
        cmocka_unit_test(test_errors),
    };
    return cmocka_run_group_tests(tests, sandbox_setup, sandbox_teardown);
}
