#include "gl_test.h"

#include "base/base.h"
#include "gl/context.h"

#include <math.h>

static const char *const backend_names[] = {
    [LSF_BACKEND_EGL] = "egl", [LSF_BACKEND_OSMESA] = "osmesa", [LSF_BACKEND_GLFW] = "glfw"};

/* Clears a texture through a framebuffer and reads it back: functions, storage and state work. */
static void clear_and_read(lsf_context *context)
{
    lsf_error error = {0};
    lsf_texture_desc desc = {"cleared", GL_TEXTURE_2D, GL_RGBA32F, 8, 4, 1, 1};
    GLuint texture = lsf_texture_create(context, &desc, &error);
    assert_int_not_equal(texture, 0);
    lsf_framebuffer_desc target = {
        .label = "target", .color_count = 1, .colors = {texture}, .layer = -1};
    GLuint framebuffer = lsf_framebuffer_create(context, &target, &error);
    assert_int_not_equal(framebuffer, 0);
    const float color[4] = {0.25f, -2.0f, 1e6f, 1.0f};
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, color);
    float pixels[8 * 4][4];
    glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT, sizeof pixels, pixels);
    for (size_t i = 0; i < 8 * 4; i++)
        assert_memory_equal(pixels[i], color, sizeof color);
    lsf_framebuffer_destroy(context, &framebuffer);
    lsf_texture_destroy(context, &texture);
    gl_test_check(context);
}

static void check_conventions(void)
{
    GLint origin, depth, alignment;
    glGetIntegerv(GL_CLIP_ORIGIN, &origin);
    glGetIntegerv(GL_CLIP_DEPTH_MODE, &depth);
    glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
    assert_int_equal(origin, GL_LOWER_LEFT);
    assert_int_equal(depth, GL_ZERO_TO_ONE);
    assert_int_equal(alignment, 1);
    assert_false(glIsEnabled(GL_DITHER));
    assert_false(glIsEnabled(GL_FRAMEBUFFER_SRGB));
    assert_true(glIsEnabled(GL_TEXTURE_CUBE_MAP_SEAMLESS));
}

static void test_backend(void **state)
{
    lsf_backend backend = *(const lsf_backend *)*state;
    double start = lsf_now();
    lsf_context *context = gl_test_context(backend, NULL);
    lsf_context_info info = lsf_context_get_info(context);
    print_message("%s: %s, %s, %s%s%s in %.0f ms\n", info.backend, info.vendor, info.renderer,
                  info.version, info.software ? ", software" : "", info.robust ? ", robust" : "",
                  (lsf_now() - start) * 1e3);
    if (backend != LSF_BACKEND_AUTO)
        assert_string_equal(info.backend, backend_names[backend]);
    assert_int_equal(info.software,
                     strstr(info.renderer, "llvmpipe") || strstr(info.renderer, "softpipe"));
    assert_int_equal(info.gl_bytes, 0);
    check_conventions();
    clear_and_read(context);
    lsf_context_destroy(context);
}

/* Two Mesa platforms share one dispatch table per thread. */
static void test_two_platforms_take_turns(void **state)
{
    (void)state;
    lsf_context *osmesa = gl_test_context(LSF_BACKEND_OSMESA, NULL);
    lsf_context *egl = gl_test_context(LSF_BACKEND_EGL, NULL);
    lsf_error error = {0};
    for (int i = 0; i < 3; i++) {
        assert_true(lsf_context_make_current(osmesa, &error));
        clear_and_read(osmesa);
        assert_true(lsf_context_make_current(egl, &error));
        clear_and_read(egl);
    }
    lsf_context_destroy(osmesa);
    assert_true(lsf_context_make_current(egl, &error));
    clear_and_read(egl);
    lsf_context_destroy(egl);
}

static void test_two_contexts_of_one_platform(void **state)
{
    (void)state;
    lsf_context *first = gl_test_context(LSF_BACKEND_EGL, NULL);
    lsf_context *second = gl_test_context(LSF_BACKEND_EGL, NULL);
    lsf_error error = {0};
    assert_true(lsf_context_make_current(first, &error));
    clear_and_read(first);
    lsf_context_destroy(first);
    assert_true(lsf_context_make_current(second, &error));
    clear_and_read(second);
    lsf_context_destroy(second);
}

static void expect_no_gl(lsf_backend backend, const char *mention)
{
    lsf_context_params params = {LSF_CONTEXT_PARAMS_DEFAULTS};
    params.backend = backend;
    lsf_error error = {0};
    assert_null(lsf_context_create(&params, &error));
    assert_int_equal(error.code, LSF_ERROR_NO_GL);
    if (!strstr(error.message, mention))
        fail_msg("\"%s\" is not in: %s", mention, error.message);
}

static void test_machine_without_gl(void **state)
{
    (void)state;
    setenv("LIGHTSHEAF_EGL_LIBRARY", "/nonexistent/libEGL.so.1", 1);
    setenv("LIGHTSHEAF_OSMESA_LIBRARY", "/nonexistent/libOSMesa.so.8", 1);
    expect_no_gl(LSF_BACKEND_AUTO, "egl: LIGHTSHEAF_EGL_LIBRARY: /nonexistent/libEGL.so.1");
    expect_no_gl(LSF_BACKEND_AUTO, "osmesa: LIGHTSHEAF_OSMESA_LIBRARY: /nonexistent/libOSMesa");
    expect_no_gl(LSF_BACKEND_EGL, "libegl1 libgl1-mesa-dri");
    expect_no_gl(LSF_BACKEND_OSMESA, "libosmesa6");
    /* A library that is there, but is not the right one. */
    setenv("LIGHTSHEAF_OSMESA_LIBRARY", "libm.so.6", 1);
    expect_no_gl(LSF_BACKEND_OSMESA, "lacks OSMesaCreateContextAttribs");
    unsetenv("LIGHTSHEAF_OSMESA_LIBRARY");
    unsetenv("LIGHTSHEAF_EGL_LIBRARY");
}

static void test_auto_falls_back_to_osmesa(void **state)
{
    (void)state;
    lsf_context_destroy(gl_test_context(LSF_BACKEND_OSMESA, NULL)); /* skips where it is missing */
    setenv("LIGHTSHEAF_EGL_LIBRARY", "/nonexistent/libEGL.so.1", 1);
    lsf_context *context = gl_test_context(LSF_BACKEND_AUTO, NULL);
    unsetenv("LIGHTSHEAF_EGL_LIBRARY");
    assert_string_equal(lsf_context_get_info(context).backend, "osmesa");
    lsf_context_destroy(context);
}

static void test_environment_chooses_for_auto(void **state)
{
    (void)state;
    lsf_context_destroy(gl_test_context(LSF_BACKEND_OSMESA, NULL));
    setenv("LIGHTSHEAF_BACKEND", "osmesa", 1);
    lsf_context *context = gl_test_context(LSF_BACKEND_AUTO, NULL);
    assert_string_equal(lsf_context_get_info(context).backend, "osmesa");
    lsf_context_destroy(context);

    setenv("LIGHTSHEAF_BACKEND", "vulkan", 1);
    lsf_error error = {0};
    assert_null(lsf_context_create(NULL, &error));
    assert_int_equal(error.code, LSF_ERROR_USAGE);
    assert_non_null(strstr(error.message, "LIGHTSHEAF_BACKEND=vulkan"));
    unsetenv("LIGHTSHEAF_BACKEND");
}

static void test_gl_error_fails_the_check(void **state)
{
    lsf_context *context = gl_test_context(*(const lsf_backend *)*state, NULL);
    lsf_error error = {0};
    lsf_timer *timer = lsf_timer_create(context, "voxelise", &error);
    lsf_log_set_handler(NULL, NULL);
    lsf_timer_begin(timer);
    glNamedBufferSubData(4711, 0, 4, "abc"); /* no such buffer */
    lsf_timer_end(timer);
    assert_false(lsf_context_check(context, &error));
    assert_int_equal(error.code, LSF_ERROR_RENDER);
    print_message("%s\n", error.message);
    assert_non_null(strstr(error.message, "voxelise: "));
    gl_test_check(context); /* told once */
    lsf_timer_destroy(timer);
    lsf_context_destroy(context);
}

typedef struct captured {
    char text[512];
    lsf_log_level level;
    int count;
} captured;

static void capture(lsf_log_level level, const char *message, void *user)
{
    captured *c = user;
    if (!strstr(message, "sheaf-test"))
        return;
    snprintf(c->text, sizeof c->text, "%s", message);
    c->level = level;
    c->count++;
}

static void test_messages_reach_the_log(void **state)
{
    (void)state;
    static const struct {
        GLenum type, severity;
        lsf_log_level level;
        bool fails;
    } cases[] = {
        {GL_DEBUG_TYPE_ERROR, GL_DEBUG_SEVERITY_HIGH, LSF_LOG_ERROR, true},
        {GL_DEBUG_TYPE_OTHER, GL_DEBUG_SEVERITY_HIGH, LSF_LOG_WARNING, true},
        {GL_DEBUG_TYPE_PERFORMANCE, GL_DEBUG_SEVERITY_MEDIUM, LSF_LOG_INFO, false},
        {GL_DEBUG_TYPE_OTHER, GL_DEBUG_SEVERITY_NOTIFICATION, LSF_LOG_DEBUG, false},
    };
    lsf_context *context = gl_test_context(LSF_BACKEND_AUTO, NULL);
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        captured c = {0};
        lsf_log_set_handler(capture, &c);
        glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, cases[i].type, 1, cases[i].severity, -1,
                             "sheaf-test");
        lsf_log_set_handler(NULL, NULL);
        assert_int_equal(c.count, 1);
        assert_int_equal(c.level, cases[i].level);
        assert_string_equal(c.text, "OpenGL: sheaf-test");
        assert_int_equal(lsf_context_check(context, NULL), !cases[i].fails);
    }
    lsf_context_destroy(context);
}

/* As on a GPU, by timestamps that arrive later: what is polled never runs ahead of them, and all of
 * it arrives. */
static void test_timer_by_timestamps(void **state)
{
    lsf_context *context = gl_test_context(*(const lsf_backend *)*state, NULL);
    lsf_error error = {0};
    bool software = context->software;
    context->software = false;
    lsf_timer *timer = lsf_timer_create(context, "late", &error);
    assert_non_null(timer);
    double polled, sum = 0.0;
    uint64_t runs = lsf_timer_poll(timer, &polled);
    assert_int_equal(runs, 0);
    for (uint64_t i = 1; i <= 100; i++) {
        lsf_timer_begin(timer);
        lsf_timer_end(timer);
        runs += lsf_timer_poll(timer, &polled);
        sum += polled;
        assert_in_range(runs, 0, i);
    }
    glFinish();
    runs += lsf_timer_poll(timer, &polled);
    sum += polled;
    assert_int_equal(runs, 100);
    assert_true(fabs(sum - lsf_timer_milliseconds(timer)) <= 1e-9);
    lsf_timer_destroy(timer);
    context->software = software;
    lsf_context_destroy(context);
}

static void test_timer(void **state)
{
    lsf_context *context = gl_test_context(*(const lsf_backend *)*state, NULL);
    lsf_error error = {0};
    lsf_timer *outer = lsf_timer_create(context, "outer", &error);
    lsf_timer *inner = lsf_timer_create(context, "inner", &error);
    assert_non_null(outer);
    assert_non_null(inner);
    assert_string_equal(lsf_timer_name(outer), "outer");
    lsf_texture_desc desc = {"work", GL_TEXTURE_2D, GL_RGBA32F, 512, 512, 1, 1};
    GLuint texture = lsf_texture_create(context, &desc, &error);
    enum {
        RUNS = 150, /* more than a GPU timer keeps pending */
    };
    for (int i = 0; i < RUNS; i++) {
        lsf_timer_begin(outer);
        lsf_timer_begin(inner);
        if (i < 10)
            glClearTexImage(texture, 0, GL_RGBA, GL_FLOAT, (float[4]){(float)i});
        lsf_timer_end(inner);
        lsf_timer_end(outer);
    }
    double polled;
    glFinish();
    assert_int_equal(lsf_timer_poll(outer, &polled), RUNS);
    assert_true(polled == lsf_timer_milliseconds(outer));
    assert_int_equal(lsf_timer_poll(outer, &polled), 0);
    assert_true(polled == 0.0);
    assert_int_equal(lsf_timer_runs(outer), RUNS);
    assert_true(lsf_timer_milliseconds(inner) > 0.0);
    assert_true(lsf_timer_milliseconds(outer) >= lsf_timer_milliseconds(inner));
    lsf_timer_destroy(outer);
    lsf_timer_destroy(inner);
    lsf_timer_destroy(NULL);
    lsf_texture_destroy(context, &texture);
    gl_test_check(context);
    lsf_context_destroy(context);
}

int main(void)
{
    static lsf_backend backends[] = {LSF_BACKEND_AUTO, LSF_BACKEND_EGL, LSF_BACKEND_OSMESA,
                                     LSF_BACKEND_GLFW};
    const struct CMUnitTest tests[] = {
        {"auto", test_backend, NULL, NULL, &backends[0]},
        {"egl", test_backend, NULL, NULL, &backends[1]},
        {"osmesa", test_backend, NULL, NULL, &backends[2]},
        {"glfw", test_backend, NULL, NULL, &backends[3]},
        cmocka_unit_test(test_two_platforms_take_turns),
        cmocka_unit_test(test_two_contexts_of_one_platform),
        cmocka_unit_test(test_machine_without_gl),
        cmocka_unit_test(test_auto_falls_back_to_osmesa),
        cmocka_unit_test(test_environment_chooses_for_auto),
        {"gl error, egl", test_gl_error_fails_the_check, NULL, NULL, &backends[1]},
        {"gl error, osmesa", test_gl_error_fails_the_check, NULL, NULL, &backends[2]},
        cmocka_unit_test(test_messages_reach_the_log),
        {"timer, egl", test_timer, NULL, NULL, &backends[1]},
        {"timer, osmesa", test_timer, NULL, NULL, &backends[2]},
        {"timer by timestamps", test_timer_by_timestamps, NULL, NULL, &backends[2]},
    };
    return cmocka_run_group_tests_name("gl context", tests, NULL, NULL);
}
