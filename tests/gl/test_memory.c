#include "gl_test.h"

#include "base/base.h"

static lsf_context *context;

static int setup(void **state)
{
    context = gl_test_open(*(const lsf_backend *)*state, NULL);
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

static uint64_t live_bytes(void)
{
    return lsf_context_get_info(context).gl_bytes;
}

static void test_texture_bytes(void **state)
{
    (void)state;
    need_context();
    static const struct {
        lsf_texture_desc desc;
        uint64_t bytes;
    } cases[] = {
        {{"plain", GL_TEXTURE_2D, GL_RGBA32F, 5, 3, 1, 1}, 5 * 3 * 16},
        /* 5x3, 2x1, 1x1 */
        {{"mipped", GL_TEXTURE_2D, GL_RGBA16F, 5, 3, 1, 3}, (15 + 2 + 1) * 8},
        {{"array", GL_TEXTURE_2D_ARRAY, GL_R32UI, 4, 4, 7, 3}, (16 + 4 + 1) * 7 * 4},
        {{"cube", GL_TEXTURE_CUBE_MAP, GL_DEPTH_COMPONENT32F, 8, 8, 6, 1}, 8 * 8 * 6 * 4},
        {{"cube mips", GL_TEXTURE_CUBE_MAP, GL_RGBA8, 8, 8, 6, 4}, (64 + 16 + 4 + 1) * 6 * 4},
        {{"voxels", GL_TEXTURE_3D, GL_R11F_G11F_B10F, 8, 4, 2, 4}, (64 + 8 + 2 + 1) * 4},
    };
    lsf_error error = {0};
    uint64_t peak = 0;
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        assert_int_equal(lsf_texture_bytes(&cases[i].desc), cases[i].bytes);
        GLuint texture = lsf_texture_create(context, &cases[i].desc, &error);
        if (!texture)
            fail_msg("%s", error.message);
        assert_int_equal(live_bytes(), cases[i].bytes);
        peak = cases[i].bytes > peak ? cases[i].bytes : peak;
        assert_int_equal(lsf_context_get_info(context).gl_bytes_peak, peak);
        char label[64] = "";
        glGetObjectLabel(GL_TEXTURE, texture, sizeof label, NULL, label);
        assert_string_equal(label, cases[i].desc.label);
        lsf_texture_destroy(context, &texture);
        assert_int_equal(texture, 0);
        lsf_texture_destroy(context, &texture);
        assert_int_equal(live_bytes(), 0);
    }
    lsf_texture_desc huge = {"huge",     GL_TEXTURE_3D, GL_RGBA32F, UINT32_MAX,
                             UINT32_MAX, UINT32_MAX,    1};
    assert_true(lsf_texture_bytes(&huge) == UINT64_MAX);
    gl_test_check(context);
}

/* The table's formats are all known to GL, and at most padded beyond their components' bits. */
static void test_formats(void **state)
{
    (void)state;
    need_context();
    static const GLenum components[] = {
        GL_INTERNALFORMAT_RED_SIZE,   GL_INTERNALFORMAT_GREEN_SIZE, GL_INTERNALFORMAT_BLUE_SIZE,
        GL_INTERNALFORMAT_ALPHA_SIZE, GL_INTERNALFORMAT_DEPTH_SIZE, GL_INTERNALFORMAT_STENCIL_SIZE,
        GL_INTERNALFORMAT_SHARED_SIZE};
    static const GLenum samples[] = {GL_R8,
                                     GL_RG16F,
                                     GL_RGBA16,
                                     GL_RGBA32F,
                                     GL_R32UI,
                                     GL_SRGB8_ALPHA8,
                                     GL_RGB10_A2UI,
                                     GL_R11F_G11F_B10F,
                                     GL_DEPTH_COMPONENT16,
                                     GL_RGB9_E5,
                                     GL_DEPTH_COMPONENT32F};
    for (size_t i = 0; i < LSF_COUNT(samples); i++) {
        GLint bits = 0;
        for (size_t c = 0; c < LSF_COUNT(components); c++) {
            GLint size = 0;
            glGetInternalformativ(GL_TEXTURE_2D, samples[i], components[c], 1, &size);
            bits += size;
        }
        uint32_t bytes = lsf_format_bytes(samples[i]);
        if (samples[i] != GL_RGB9_E5) /* drivers differ in how they count the shared exponent */
            assert_int_equal(bits, bytes * 8);
    }
    assert_string_equal(lsf_format_name(GL_RGBA16F), "GL_RGBA16F");
    assert_int_equal(lsf_format_bytes(GL_RGBA), 0);
    gl_test_check(context);
}

static void expect_refusal(const lsf_texture_desc *desc, const char *mention)
{
    lsf_error error = {0};
    assert_int_equal(lsf_texture_create(context, desc, &error), 0);
    assert_int_equal(error.code, LSF_ERROR_RENDER);
    if (!strstr(error.message, mention) || !strstr(error.message, desc->label))
        fail_msg("\"%s\" is not in: %s", mention, error.message);
    assert_int_equal(live_bytes(), 0);
    gl_test_check(context);
}

static void test_over_limit(void **state)
{
    (void)state;
    need_context();
    GLint limit_2d, limit_3d, limit_layers, limit_cube;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit_2d);
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &limit_3d);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &limit_layers);
    glGetIntegerv(GL_MAX_CUBE_MAP_TEXTURE_SIZE, &limit_cube);
    const lsf_texture_desc base = {"shadow map", GL_TEXTURE_2D, GL_R8, 4, 4, 1, 1};
    lsf_texture_desc desc = base;
    desc.width = (uint32_t)limit_2d + 1;
    expect_refusal(&desc, "GL_MAX_TEXTURE_SIZE");
    desc = base;
    desc.height = UINT32_MAX;
    expect_refusal(&desc, "height of 4294967295");
    desc = base;
    desc.width = 0;
    expect_refusal(&desc, "width of 0");
    desc = base;
    desc.depth = 2;
    expect_refusal(&desc, "a 2D texture");
    desc = base;
    desc.levels = 4;
    expect_refusal(&desc, "level count of 4");
    desc = base;
    desc.levels = 0;
    expect_refusal(&desc, "level count of 0");
    desc = base;
    desc.internal_format = GL_RGBA;
    expect_refusal(&desc, "not a sized one");
    desc = base;
    desc.target = GL_TEXTURE_RECTANGLE;
    expect_refusal(&desc, "not supported");
    desc = base;
    desc.target = GL_TEXTURE_3D;
    desc.depth = (uint32_t)limit_3d + 1;
    expect_refusal(&desc, "GL_MAX_3D_TEXTURE_SIZE");
    desc.target = GL_TEXTURE_2D_ARRAY;
    desc.depth = (uint32_t)limit_layers + 1;
    expect_refusal(&desc, "GL_MAX_ARRAY_TEXTURE_LAYERS");
    desc.target = GL_TEXTURE_CUBE_MAP;
    desc.depth = 1;
    expect_refusal(&desc, "six faces");
    desc.depth = 6;
    desc.width = desc.height = (uint32_t)limit_cube + 1;
    expect_refusal(&desc, "GL_MAX_CUBE_MAP_TEXTURE_SIZE");
}

/* Each side is within its limit, and the whole is more than any machine has. */
static void test_device_memory_runs_out(void **state)
{
    (void)state;
    need_context();
    GLint side, layers;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
    lsf_texture_desc desc = {"all of it",    GL_TEXTURE_2D_ARRAY, GL_RGBA32F, (uint32_t)side,
                             (uint32_t)side, (uint32_t)layers,    1};
    expect_refusal(&desc, "no memory left");
    lsf_error error = {0};
    assert_int_equal(lsf_buffer_create(context, "list", UINT64_C(1) << 62, NULL, 0, &error), 0);
    assert_non_null(strstr(error.message, "buffer list, 4611686018427387904 bytes"));
    gl_test_check(context);
}

static void test_buffers(void **state)
{
    (void)state;
    need_context();
    lsf_error error = {0};
    const float data[4] = {1, 2, 3, 4};
    GLuint buffer = lsf_buffer_create(context, "vertices", sizeof data, data, 0, &error);
    assert_int_not_equal(buffer, 0);
    assert_int_equal(live_bytes(), sizeof data);
    float read[4];
    glGetNamedBufferSubData(buffer, 0, sizeof read, read);
    assert_memory_equal(read, data, sizeof data);
    lsf_buffer_destroy(context, &buffer);
    assert_int_equal(live_bytes(), 0);
    assert_int_equal(lsf_buffer_create(context, "nothing", 0, NULL, 0, &error), 0);
    assert_non_null(strstr(error.message, "buffer nothing"));
    gl_test_check(context);
}

static void test_framebuffers(void **state)
{
    (void)state;
    need_context();
    lsf_error error = {0};
    lsf_texture_desc cube = {"cube", GL_TEXTURE_CUBE_MAP, GL_DEPTH_COMPONENT32F, 4, 4, 6, 1};
    lsf_texture_desc plain = {"plain", GL_TEXTURE_2D, GL_RGBA16F, 4, 4, 1, 1};
    GLuint depth = lsf_texture_create(context, &cube, &error);
    GLuint color = lsf_texture_create(context, &plain, &error);
    /* Depth only, one face; then all faces at once. */
    for (int32_t layer = -1; layer < 6; layer += 6) {
        lsf_framebuffer_desc desc = {.label = "shadow", .depth = depth, .layer = layer};
        GLuint framebuffer = lsf_framebuffer_create(context, &desc, &error);
        if (!framebuffer)
            fail_msg("%s", error.message);
        glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, (float[]){layer < 0 ? 0.25f : 0.75f});
        lsf_framebuffer_destroy(context, &framebuffer);
    }
    float faces[6][4 * 4];
    glGetTextureImage(depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, sizeof faces, faces);
    assert_float_equal(faces[0][0], 0.25f, 0.0f);
    assert_float_equal(faces[5][15], 0.75f, 0.0f);

    lsf_framebuffer_desc mixed = {
        .label = "mixed", .color_count = 1, .colors = {color}, .depth = depth, .layer = -1};
    assert_int_equal(lsf_framebuffer_create(context, &mixed, &error), 0);
    assert_non_null(strstr(error.message, "framebuffer mixed: "));
    lsf_framebuffer_desc empty = {.label = "empty", .layer = -1};
    assert_int_equal(lsf_framebuffer_create(context, &empty, &error), 0);
    assert_non_null(strstr(error.message, "no attachment"));
    lsf_framebuffer_desc many = {.label = "many", .color_count = 9, .layer = -1};
    assert_int_equal(lsf_framebuffer_create(context, &many, &error), 0);
    assert_non_null(strstr(error.message, "9 colour attachments"));
    lsf_texture_destroy(context, &depth);
    lsf_texture_destroy(context, &color);
    gl_test_check(context);
}

/* What a pass does, with one allocation of each kind. */
static bool allocate_everything(lsf_error *error)
{
    GLuint texture = 0, buffer = 0, framebuffer = 0;
    lsf_timer *timer = NULL;
    lsf_texture_desc image = {"image", GL_TEXTURE_2D, GL_RGBA8, 4, 4, 1, 1};
    lsf_framebuffer_desc target = {.label = "target", .color_count = 1, .layer = -1};
    lsf_program_desc program = {.label = "program", .files = {"lib/fullscreen.vert.glsl"}};
    bool made = (texture = lsf_texture_create(context, &image, error)) != 0;
    target.colors[0] = texture;
    made = made && (framebuffer = lsf_framebuffer_create(context, &target, error)) != 0;
    made = made && (buffer = lsf_buffer_create(context, "buffer", 64, NULL, 0, error)) != 0;
    made = made && (timer = lsf_timer_create(context, "timer", error)) != NULL;
    made = made && lsf_program_get(context, &program, error) != 0;
    lsf_timer_destroy(timer);
    lsf_buffer_destroy(context, &buffer);
    lsf_framebuffer_destroy(context, &framebuffer);
    lsf_texture_destroy(context, &texture);
    return made;
}

static void test_every_allocation_can_fail(void **state)
{
    (void)state;
    need_context();
    static const char *const mentions[] = {"texture image", "framebuffer target", "buffer buffer",
                                           "timer", "program program"};
    uint64_t n = 1;
    for (;; n++) {
        lsf_error error = {0};
        lsf_context_fail_allocation(context, n);
        if (allocate_everything(&error))
            break;
        assert_int_equal(error.code, LSF_ERROR_RENDER);
        assert_true(n <= LSF_COUNT(mentions));
        assert_non_null(strstr(error.message, mentions[n - 1]));
        assert_int_equal(live_bytes(), 0);
        gl_test_check(context);
    }
    assert_int_equal(n, LSF_COUNT(mentions) + 1);
    lsf_context_fail_allocation(context, 0);
}

int main(void)
{
    static lsf_backend backends[] = {LSF_BACKEND_EGL, LSF_BACKEND_OSMESA};
    int failed = 0;
    for (size_t i = 0; i < LSF_COUNT(backends); i++) {
#define CASE(f)                                                                                    \
    {                                                                                              \
#f, f, setup, teardown, &backends[i]                                                       \
    }
        const struct CMUnitTest tests[] = {
            CASE(test_texture_bytes),
            CASE(test_formats),
            CASE(test_over_limit),
            CASE(test_device_memory_runs_out),
            CASE(test_buffers),
            CASE(test_framebuffers),
            CASE(test_every_allocation_can_fail),
        };
#undef CASE
        failed +=
            cmocka_run_group_tests_name(i ? "memory, osmesa" : "memory, egl", tests, NULL, NULL);
    }
    return failed;
}
