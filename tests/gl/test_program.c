#include "shader_folder.h"

#include "shared/brdf.h"

static shader_folder folder;
static lsf_context *context;

static int setup(void **state)
{
    context = gl_test_open(*(const lsf_backend *)*state, folder.path);
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    lsf_context_destroy(context);
    context = NULL;
    return 0;
}

static void need_context(void)
{
    if (!context)
        skip();
}

static GLuint compute_program(const char *file, const lsf_define *defines, uint32_t count,
                              lsf_error *error)
{
    lsf_program_desc desc = {
        .label = "tested", .files = {file}, .defines = defines, .define_count = count};
    return lsf_program_get(context, &desc, error);
}

static void expect_compile_error(const char *file, const char *mention)
{
    lsf_error error = {0};
    assert_int_equal(compute_program(file, NULL, 0, &error), 0);
    assert_int_equal(error.code, LSF_ERROR_RENDER);
    if (!strstr(error.message, mention))
        fail_msg("\"%s\" is not in: %s", mention, error.message);
    gl_test_check(context); /* a shader error is told once, by the program */
}

#define COMPUTE_HEAD "layout(local_size_x = 1) in;\n"

static void test_errors_name_path_and_line(void **state)
{
    (void)state;
    need_context();
    shader_folder_write(&folder, "good.glsl", "float good()\n{\n    return 1.0;\n}\n");
    shader_folder_write(&folder, "bad.glsl", "\n\nfloat bad() { return undeclared_in_include; }\n");
    shader_folder_write(&folder, "x.comp.glsl",
                        COMPUTE_HEAD "void main() { undeclared_in_main = 1; }\n");
    expect_compile_error("x.comp.glsl", "\nx.comp.glsl:2: ");
    expect_compile_error("x.comp.glsl", "undeclared_in_main");
    shader_folder_write(&folder, "x.comp.glsl",
                        COMPUTE_HEAD "#include \"good.glsl\"\n#include \"bad.glsl\"\n"
                                     "void main() {}\n");
    expect_compile_error("x.comp.glsl", "\nbad.glsl:3: ");
    shader_folder_write(&folder, "x.comp.glsl",
                        COMPUTE_HEAD "#include \"good.glsl\"\n#include \"good.glsl\"\n\n"
                                     "void main() { undeclared_after = 1; }\n");
    expect_compile_error("x.comp.glsl", "\nx.comp.glsl:5: ");
    /* A broken line of the preprocessor. */
    shader_folder_write(&folder, "x.comp.glsl", COMPUTE_HEAD "#if 1 +\n#endif\nvoid main() {}\n");
    expect_compile_error("x.comp.glsl", "\nx.comp.glsl:2: ");
}

static size_t log_lines;

static void count_errors(lsf_log_level level, const char *message, void *user)
{
    (void)user;
    if (level == LSF_LOG_ERROR && strstr(message, "x.comp.glsl:"))
        log_lines++;
}

static void test_long_log_is_complete(void **state)
{
    (void)state;
    need_context();
    lsf_string text = {0};
    lsf_string_add(&text, COMPUTE_HEAD "void main()\n{\n");
    for (int i = 0; i < 200; i++)
        lsf_string_add(&text, "    unknown_identifier_number_%d = 1;\n", i);
    lsf_string_add(&text, "}\n");
    shader_folder_write(&folder, "x.comp.glsl", text.text);
    free(text.text);
    lsf_log_set_handler(count_errors, NULL);
    log_lines = 0;
    expect_compile_error("x.comp.glsl", "the whole text is in the log");
    lsf_log_set_handler(NULL, NULL);
    assert_true(log_lines >= 200);
}

static void test_link_error(void **state)
{
    (void)state;
    need_context();
    shader_folder_write(&folder, "x.vert.glsl", "out vec3 v;\nvoid main() { v = vec3(0); }\n");
    shader_folder_write(&folder, "x.frag.glsl",
                        "in vec4 v;\nout vec4 c;\nvoid main() { c = v; }\n");
    lsf_program_desc desc = {.label = "mismatched", .files = {"x.vert.glsl", "x.frag.glsl"}};
    lsf_error error = {0};
    assert_int_equal(lsf_program_get(context, &desc, &error), 0);
    assert_non_null(strstr(error.message, "program mismatched did not link:"));
    gl_test_check(context);
}

static void test_names(void **state)
{
    (void)state;
    need_context();
    expect_compile_error("x.glsl", "must end in .vert.glsl");
    lsf_error error = {0};
    lsf_program_desc empty = {.label = "empty"};
    assert_int_equal(lsf_program_get(context, &empty, &error), 0);
    assert_non_null(strstr(error.message, "names no shader"));
}

static void test_cache(void **state)
{
    (void)state;
    need_context();
    lsf_error error = {0};
    shader_folder_write(&folder, "inc.glsl", "const int value = WANTED;\n");
    shader_folder_write(&folder, "x.comp.glsl",
                        COMPUTE_HEAD "#include \"inc.glsl\"\n"
                                     "layout(std430, binding = 0) buffer B { int b; };\n"
                                     "void main() { b = value; }\n");
    const lsf_define one = {"WANTED", 1}, two = {"WANTED", 2};
    GLuint first = compute_program("x.comp.glsl", &one, 1, &error);
    assert_int_not_equal(first, 0);
    assert_int_equal(compute_program("x.comp.glsl", &one, 1, &error), first);
    GLuint second = compute_program("x.comp.glsl", &two, 1, &error);
    assert_int_not_equal(second, 0);
    assert_int_not_equal(second, first);

    int32_t result = 0;
    GLuint buffer = lsf_buffer_create(context, "result", sizeof result, NULL, 0, &error);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    glUseProgram(second);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer, 0, sizeof result, &result);
    assert_int_equal(result, 2);

    /* A change on disk is seen at the next call. */
    shader_folder_write(&folder, "inc.glsl", "const int value = 3 * WANTED;\n");
    assert_int_not_equal(compute_program("x.comp.glsl", &one, 1, &error), first);
    lsf_buffer_destroy(context, &buffer);
    gl_test_check(context);
}

static void test_extension_line(void **state)
{
    (void)state;
    need_context();
    shader_folder_write(&folder, "inc.glsl", "int zero() { return 0; }\n");
    shader_folder_write(&folder, "x.vert.glsl",
                        "#extension GL_ARB_shader_draw_parameters : require\n"
                        "#include \"inc.glsl\"\n"
                        "void main() { gl_Position = vec4(gl_DrawIDARB + zero()); }\n");
    lsf_program_desc desc = {.label = "extended", .files = {"x.vert.glsl"}};
    lsf_error error = {0};
    if (!lsf_program_get(context, &desc, &error))
        fail_msg("%s", error.message);
}

/* The triangle covers every pixel once, and uv runs from 0 to 1. */
static void test_fullscreen(void **state)
{
    (void)state;
    need_context();
    lsf_error error = {0};
    shader_folder_write(&folder, "x.frag.glsl",
                        "in vec2 uv;\nlayout(location = 0) out vec4 color;\n"
                        "void main() { color = vec4(uv, 1.0, 0.0); }\n");
    lsf_program_desc desc = {.label = "uv", .files = {"lib/fullscreen.vert.glsl", "x.frag.glsl"}};
    GLuint program = lsf_program_get(context, &desc, &error);
    if (!program)
        fail_msg("%s", error.message);
    enum {
        WIDTH = 8,
        HEIGHT = 4,
    };
    lsf_texture_desc image = {"uv", GL_TEXTURE_2D, GL_RGBA32F, WIDTH, HEIGHT, 1, 1};
    GLuint texture = lsf_texture_create(context, &image, &error);
    lsf_framebuffer_desc target = {
        .label = "uv", .color_count = 1, .colors = {texture}, .layer = -1};
    GLuint framebuffer = lsf_framebuffer_create(context, &target, &error);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, WIDTH, HEIGHT);
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, (float[4]){0});
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glUseProgram(program);
    lsf_draw_fullscreen(context);
    glDisable(GL_BLEND);
    float pixels[HEIGHT][WIDTH][4];
    glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT, sizeof pixels, pixels);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            assert_float_equal(pixels[y][x][0], (x + 0.5f) / WIDTH, 1e-6f);
            assert_float_equal(pixels[y][x][1], (y + 0.5f) / HEIGHT, 1e-6f);
            assert_float_equal(pixels[y][x][2], 1.0f, 0.0f);
        }
    }
    lsf_framebuffer_destroy(context, &framebuffer);
    lsf_texture_destroy(context, &texture);
    gl_test_check(context);
}

/* One definition for C and GLSL: the same functions give the same numbers. */
static void test_shared_functions(void **state)
{
    (void)state;
    need_context();
    lsf_error error = {0};
    shader_folder_write(&folder, "x.comp.glsl",
                        COMPUTE_HEAD "#include \"shared/brdf.h\"\n#include \"shared/light.h\"\n"
                                     "layout(std430, binding = 0) buffer B { float b[3]; };\n"
                                     "void main()\n{\n"
                                     "    b[0] = lsf_ggx_d(0.9, 0.19, 0.3);\n"
                                     "    b[1] = lsf_ggx_v(0.5, 0.7, 0.3);\n"
                                     "    b[2] = lsf_fresnel_schlick(lsf_f0_from_ior(1.5), 0.4);\n"
                                     "}\n");
    GLuint program = compute_program("x.comp.glsl", NULL, 0, &error);
    if (!program)
        fail_msg("%s", error.message);
    float result[3] = {0};
    GLuint buffer = lsf_buffer_create(context, "result", sizeof result, NULL, 0, &error);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    glUseProgram(program);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer, 0, sizeof result, result);
    const float expected[3] = {lsf_ggx_d(0.9f, 0.19f, 0.3f), lsf_ggx_v(0.5f, 0.7f, 0.3f),
                               lsf_fresnel_schlick(lsf_f0_from_ior(1.5f), 0.4f)};
    for (int i = 0; i < 3; i++)
        assert_float_equal(result[i], expected[i], 1e-5f * expected[i]);
    lsf_buffer_destroy(context, &buffer);
    gl_test_check(context);
}

int main(void)
{
    static lsf_backend backends[] = {LSF_BACKEND_EGL, LSF_BACKEND_OSMESA};
    shader_folder_create(&folder);
    unsetenv("MESA_SHADER_DUMP_PATH"); /* for tests/shaders: what is wrong here is so on purpose */
    int failed = 0;
    for (size_t i = 0; i < LSF_COUNT(backends); i++) {
#define CASE(f)                                                                                    \
    {                                                                                              \
#f, f, setup, teardown, &backends[i]                                                       \
    }
        const struct CMUnitTest tests[] = {
            CASE(test_errors_name_path_and_line),
            CASE(test_long_log_is_complete),
            CASE(test_link_error),
            CASE(test_names),
            CASE(test_cache),
            CASE(test_extension_line),
            CASE(test_fullscreen),
            CASE(test_shared_functions),
        };
#undef CASE
        failed += cmocka_run_group_tests_name(i ? "programs, osmesa" : "programs, egl", tests, NULL,
                                              NULL);
    }
    shader_folder_destroy(&folder);
    return failed;
}
