/* An application's own context: whatever state it leaves, the picture is right, and it finds its
 * state as lightsheaf/context.h says. */
#include "base/base.h"
#include "embedding_rig.h"

static const char *const techniques[] = {"direct", "bidirectional", "voxel_path", "cone",
                                         "substitute_tree"};

/* --- the application -------------------------------------------------------------------------- */

typedef struct application {
    rig_foreign gl;
    GLuint sampler, texture, buffer, framebuffer, renderbuffer, vertex_array, pipeline, program;
    uint32_t made_current;
} application;

static GLuint hostile_program(void)
{
    static const char *const source = "#version 450 core\nvoid main() { gl_Position = vec4(0); }";
    GLuint shader = glCreateShader(GL_VERTEX_SHADER), program = glCreateProgram();
    glShaderSource(shader, 1, &source, NULL);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glLinkProgram(program);
    glDeleteShader(shader);
    return program;
}

static application open_application(const lsf_backend_ops *ops)
{
    application app = {.gl = rig_open_foreign(ops)};
    glad_current = &app.gl.functions;
    glCreateSamplers(1, &app.sampler);
    glSamplerParameteri(app.sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glSamplerParameteri(app.sampler, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(app.sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glCreateTextures(GL_TEXTURE_2D, 1, &app.texture);
    glTextureStorage2D(app.texture, 1, GL_RGBA32F, 4, 4);
    glCreateBuffers(1, &app.buffer);
    glNamedBufferStorage(app.buffer, 1 << 16, NULL, 0);
    glCreateFramebuffers(1, &app.framebuffer);
    glNamedFramebufferTexture(app.framebuffer, GL_COLOR_ATTACHMENT0, app.texture, 0);
    glCreateRenderbuffers(1, &app.renderbuffer);
    glNamedRenderbufferStorage(app.renderbuffer, GL_RGBA8, 4, 4);
    glCreateVertexArrays(1, &app.vertex_array);
    glCreateProgramPipelines(1, &app.pipeline);
    app.program = hostile_program();
    return app;
}

static void close_application(application *app)
{
    assert_int_equal(glGetError(), GL_NO_ERROR);
    rig_close_foreign(&app->gl);
}

static bool make_current(void *user)
{
    application *app = user;
    app->made_current++;
    return app->gl.ops->make_current(app->gl.platform, NULL);
}

static void (*get_proc_address(void *user, const char *name))(void)
{
    return (void (*)(void))rig_foreign_function(&((application *)user)->gl, name);
}

static lsf_context *wrap(application *app)
{
    const lsf_context_wrap_params params = {
        .get_proc_address = get_proc_address, .make_current = make_current, .user = app};
    lsf_error error = {0};
    lsf_context *context = lsf_context_wrap(&params, &error);
    if (!context)
        fail_msg("%s", error.message);
    return context;
}

/* --- what it leaves -----------------------------------------------------------------------------
 */

static const GLenum switches[] = {GL_BLEND,
                                  GL_COLOR_LOGIC_OP,
                                  GL_CULL_FACE,
                                  GL_DEPTH_CLAMP,
                                  GL_DEPTH_TEST,
                                  GL_FRAMEBUFFER_SRGB,
                                  GL_LINE_SMOOTH,
                                  GL_POLYGON_OFFSET_FILL,
                                  GL_POLYGON_OFFSET_LINE,
                                  GL_POLYGON_OFFSET_POINT,
                                  GL_POLYGON_SMOOTH,
                                  GL_PRIMITIVE_RESTART,
                                  GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                  GL_PROGRAM_POINT_SIZE,
                                  GL_RASTERIZER_DISCARD,
                                  GL_SAMPLE_ALPHA_TO_COVERAGE,
                                  GL_SAMPLE_ALPHA_TO_ONE,
                                  GL_SAMPLE_COVERAGE,
                                  GL_SAMPLE_MASK,
                                  GL_SAMPLE_SHADING,
                                  GL_SCISSOR_TEST,
                                  GL_STENCIL_TEST,
                                  GL_TEXTURE_CUBE_MAP_SEAMLESS,
                                  GL_CLIP_DISTANCE0,
                                  GL_CLIP_DISTANCE0 + 7,
                                  GL_DITHER,
                                  GL_MULTISAMPLE};

static void scissor(const application *app)
{
    (void)app;
    glEnable(GL_SCISSOR_TEST);
    glScissor(1, 1, 1, 1);
}

static void stencil(const application *app)
{
    (void)app;
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_NEVER, 1, 1);
    glStencilOp(GL_INVERT, GL_INVERT, GL_INVERT);
    glStencilMask(2);
}

static void depth(const application *app)
{
    (void)app;
    glDepthFunc(GL_NEVER);
    glDepthMask(GL_FALSE);
    glDepthRange(0.9, 0.2);
}

static void color(const application *app)
{
    (void)app;
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_REVERSE_SUBTRACT);
    glBlendFunc(GL_DST_COLOR, GL_ONE_MINUS_SRC_ALPHA);
    glBlendColor(0.5f, 0.5f, 0.5f, 0.5f);
    glColorMask(GL_TRUE, GL_FALSE, GL_FALSE, GL_TRUE);
}

static void logic_operation(const application *app)
{
    (void)app;
    glEnable(GL_COLOR_LOGIC_OP);
    glLogicOp(GL_INVERT);
}

static void polygons(const application *app)
{
    (void)app;
    glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(3.0f, 100.0f);
}

static void faces(const application *app)
{
    (void)app;
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT_AND_BACK);
    glFrontFace(GL_CW);
}

static void clip_control(const application *app)
{
    (void)app;
    glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}

static void primitives(const application *app)
{
    (void)app;
    glEnable(GL_PRIMITIVE_RESTART);
    glPrimitiveRestartIndex(1);
    glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    glPatchParameteri(GL_PATCH_VERTICES, 1);
    glHint(GL_FRAGMENT_SHADER_DERIVATIVE_HINT, GL_FASTEST);
}

static void viewport(const application *app)
{
    (void)app;
    glViewport(1, 1, 2, 2);
}

static void pixel_storage(const application *app)
{
    (void)app;
    static const GLenum names[] = {
        GL_PACK_SWAP_BYTES,    GL_PACK_ROW_LENGTH,   GL_PACK_SKIP_ROWS,      GL_PACK_SKIP_PIXELS,
        GL_UNPACK_SWAP_BYTES,  GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_ROWS,
        GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_IMAGES};
    for (size_t i = 0; i < LSF_COUNT(names); i++)
        glPixelStorei(names[i], 1);
    glPixelStorei(GL_PACK_ALIGNMENT, 8);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
}

static void buffers(const application *app)
{
    static const GLenum targets[] = {GL_ARRAY_BUFFER,
                                     GL_COPY_READ_BUFFER,
                                     GL_COPY_WRITE_BUFFER,
                                     GL_DRAW_INDIRECT_BUFFER,
                                     GL_DISPATCH_INDIRECT_BUFFER,
                                     GL_PIXEL_PACK_BUFFER,
                                     GL_PIXEL_UNPACK_BUFFER,
                                     GL_QUERY_BUFFER,
                                     GL_TEXTURE_BUFFER};
    for (size_t i = 0; i < LSF_COUNT(targets); i++)
        glBindBuffer(targets[i], app->buffer);
    for (GLuint i = 0; i < 8; i++) {
        glBindBufferBase(GL_UNIFORM_BUFFER, i, app->buffer);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, app->buffer);
    }
}

static void textures(const application *app)
{
    for (GLuint unit = 0; unit < 32; unit++) {
        glBindTextureUnit(unit, app->texture);
        glBindSampler(unit, app->sampler);
    }
    for (GLuint unit = 0; unit < 8; unit++)
        glBindImageTexture(unit, app->texture, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    glActiveTexture(GL_TEXTURE5);
}

static void objects(const application *app)
{
    glBindFramebuffer(GL_FRAMEBUFFER, app->framebuffer);
    glBindRenderbuffer(GL_RENDERBUFFER, app->renderbuffer);
    glBindVertexArray(app->vertex_array);
    glBindProgramPipeline(app->pipeline);
    glUseProgram(app->program);
}

static void all_switches(const application *app)
{
    (void)app;
    for (size_t i = 0; i < LSF_COUNT(switches); i++)
        (glIsEnabled(switches[i]) ? glDisable : glEnable)(switches[i]);
}

typedef struct hostile_state {
    const char *name;
    void (*set)(const application *app);
} hostile_state;

static const hostile_state states[] = {
    {"scissor", scissor},
    {"stencil", stencil},
    {"depth", depth},
    {"color", color},
    {"logic operation", logic_operation},
    {"polygons", polygons},
    {"faces", faces},
    {"clip control", clip_control},
    {"primitives", primitives},
    {"viewport", viewport},
    {"pixel storage", pixel_storage},
    {"buffers", buffers},
    {"textures", textures},
    {"objects", objects},
    {"switches", all_switches},
};

/* --- what it finds ------------------------------------------------------------------------------
 */

static const GLenum numbers[] = {
    GL_ACTIVE_TEXTURE,
    GL_ARRAY_BUFFER_BINDING,
    GL_BLEND_COLOR,
    GL_BLEND_DST_ALPHA,
    GL_BLEND_DST_RGB,
    GL_BLEND_EQUATION_ALPHA,
    GL_BLEND_EQUATION_RGB,
    GL_BLEND_SRC_ALPHA,
    GL_BLEND_SRC_RGB,
    GL_CLIP_DEPTH_MODE,
    GL_CLIP_ORIGIN,
    GL_COLOR_WRITEMASK,
    GL_COPY_READ_BUFFER_BINDING,
    GL_COPY_WRITE_BUFFER_BINDING,
    GL_CULL_FACE_MODE,
    GL_CURRENT_PROGRAM,
    GL_DEPTH_FUNC,
    GL_DEPTH_RANGE,
    GL_DEPTH_WRITEMASK,
    GL_DISPATCH_INDIRECT_BUFFER_BINDING,
    GL_DRAW_FRAMEBUFFER_BINDING,
    GL_DRAW_INDIRECT_BUFFER_BINDING,
    GL_FRAGMENT_SHADER_DERIVATIVE_HINT,
    GL_FRONT_FACE,
    GL_LOGIC_OP_MODE,
    GL_PACK_ALIGNMENT,
    GL_PACK_ROW_LENGTH,
    GL_PACK_SKIP_PIXELS,
    GL_PACK_SKIP_ROWS,
    GL_PACK_SWAP_BYTES,
    GL_PATCH_VERTICES,
    GL_PIXEL_PACK_BUFFER_BINDING,
    GL_PIXEL_UNPACK_BUFFER_BINDING,
    GL_POLYGON_MODE,
    GL_POLYGON_OFFSET_FACTOR,
    GL_POLYGON_OFFSET_UNITS,
    GL_PRIMITIVE_RESTART_INDEX,
    GL_PROGRAM_PIPELINE_BINDING,
    GL_PROVOKING_VERTEX,
    GL_QUERY_BUFFER_BINDING,
    GL_READ_FRAMEBUFFER_BINDING,
    GL_RENDERBUFFER_BINDING,
    GL_SHADER_STORAGE_BUFFER_BINDING,
    GL_STENCIL_BACK_FAIL,
    GL_STENCIL_BACK_FUNC,
    GL_STENCIL_BACK_REF,
    GL_STENCIL_FAIL,
    GL_STENCIL_FUNC,
    GL_STENCIL_PASS_DEPTH_FAIL,
    GL_STENCIL_PASS_DEPTH_PASS,
    GL_STENCIL_REF,
    GL_TEXTURE_BUFFER_BINDING,
    GL_UNIFORM_BUFFER_BINDING,
    GL_UNPACK_ALIGNMENT,
    GL_UNPACK_IMAGE_HEIGHT,
    GL_UNPACK_ROW_LENGTH,
    GL_UNPACK_SKIP_IMAGES,
    GL_UNPACK_SKIP_PIXELS,
    GL_UNPACK_SKIP_ROWS,
    GL_UNPACK_SWAP_BYTES,
    GL_VERTEX_ARRAY_BINDING,
};

enum { UNITS = 8 }; /* numbered bindings that are looked at */

typedef struct found_state {
    GLboolean switched[LSF_COUNT(switches)];
    GLdouble numbers[LSF_COUNT(numbers)][4];
    GLint uniform_buffers[UNITS], storage_buffers[UNITS], images[UNITS];
    GLint textures[UNITS], samplers[UNITS];
    GLint stencil_masks[2]; /* of the eight bits that there are */
} found_state;

static found_state find_state(void)
{
    found_state found = {0};
    for (size_t i = 0; i < LSF_COUNT(switches); i++)
        found.switched[i] = glIsEnabled(switches[i]);
    for (size_t i = 0; i < LSF_COUNT(numbers); i++)
        glGetDoublev(numbers[i], found.numbers[i]);
    for (GLuint i = 0; i < UNITS; i++) {
        glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, i, &found.uniform_buffers[i]);
        glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, i, &found.storage_buffers[i]);
        glGetIntegeri_v(GL_IMAGE_BINDING_NAME, i, &found.images[i]);
        glGetIntegeri_v(GL_TEXTURE_BINDING_2D, i, &found.textures[i]);
        glGetIntegeri_v(GL_SAMPLER_BINDING, i, &found.samplers[i]);
    }
    glGetIntegerv(GL_STENCIL_VALUE_MASK, &found.stencil_masks[0]);
    glGetIntegerv(GL_STENCIL_WRITEMASK, &found.stencil_masks[1]);
    found.stencil_masks[0] &= 0xff;
    found.stencil_masks[1] &= 0xff;
    return found;
}

static void check_state(const char *name, const found_state *expected)
{
    found_state found = find_state();
    for (size_t i = 0; i < LSF_COUNT(switches); i++)
        if (found.switched[i] != expected->switched[i])
            fail_msg("%s: switch 0x%04x is not as it was in a new context", name, switches[i]);
    for (size_t i = 0; i < LSF_COUNT(numbers); i++)
        if (memcmp(found.numbers[i], expected->numbers[i], sizeof found.numbers[i]) != 0)
            fail_msg("%s: 0x%04x is %g, in a new context %g", name, numbers[i], found.numbers[i][0],
                     expected->numbers[i][0]);
    assert_memory_equal(found.uniform_buffers, expected->uniform_buffers,
                        sizeof found.uniform_buffers);
    assert_memory_equal(found.storage_buffers, expected->storage_buffers,
                        sizeof found.storage_buffers);
    assert_memory_equal(found.images, expected->images, sizeof found.images);
    assert_memory_equal(found.textures, expected->textures, sizeof found.textures);
    assert_memory_equal(found.stencil_masks, expected->stencil_masks, sizeof found.stencil_masks);
    assert_memory_equal(found.samplers, expected->samplers, sizeof found.samplers);
    assert_int_equal(glGetError(), GL_NO_ERROR);
}

/* --- torture ------------------------------------------------------------------------------------
 */

typedef struct torture {
    application app;
    found_state fresh;
    lsf_context *context;
    lsf_renderer *renderer;
    const lsf_image *expected;
} torture;

/* Before each of a frame's calls; `state` NULL: all states at once. */
static void leave_wrong(const torture *t, const hostile_state *state)
{
    for (size_t i = 0; i < LSF_COUNT(states); i++)
        if (!state || state == &states[i])
            states[i].set(&t->app);
}

static void check_call(const torture *t, bool good, const lsf_error *error, const char *name)
{
    if (!good)
        fail_msg("%s: %s", name, error->message);
    check_state(name, &t->fresh);
}

static void torture_frame(const torture *t, const hostile_state *state)
{
    const char *name = state ? state->name : "all";
    const lsf_frame frame = {LSF_FRAME_DEFAULTS};
    lsf_error error = {0};
    leave_wrong(t, state);
    check_call(t, lsf_renderer_begin_frame(t->renderer, &frame, &error), &error, name);
    for (uint32_t i = 0; i < 2; i++) {
        leave_wrong(t, state);
        check_call(t, lsf_renderer_iterate(t->renderer, &error), &error, name);
    }
    leave_wrong(t, state);
    lsf_image *image = lsf_renderer_read(t->renderer, &error);
    check_call(t, image != NULL, &error, name);
    print_message("%s\n", name);
    assert_same_pixels(image, t->expected);
    lsf_image_destroy(image);
}

static const lsf_backend_ops *ops_of(lsf_backend backend)
{
    lsf_context_destroy(gl_test_context(backend, NULL)); /* skips where it is missing */
    return backend == LSF_BACKEND_EGL ? &lsf_backend_egl : &lsf_backend_osmesa;
}

static void hostile_application(void **user)
{
    lsf_backend backend = *(const lsf_backend *)*user;
    lsf_scene *scene = rig_scene(5.0f);
    size_t count = backend == LSF_BACKEND_EGL ? LSF_COUNT(techniques) : 1;
    for (size_t i = 0; i < count; i++) {
        lsf_image *expected = rig_alone(backend, scene, techniques[i]);
        torture t = {.app = open_application(ops_of(backend)), .expected = expected};
        assert_true(make_current(&t.app));
        glad_current = &t.app.gl.functions;
        t.fresh = find_state();
        leave_wrong(&t, NULL);
        t.context = wrap(&t.app);
        check_state("wrap", &t.fresh);
        leave_wrong(&t, NULL);
        t.renderer = rig_renderer(t.context, scene, techniques[i]);
        check_state("create", &t.fresh);
        for (size_t s = 0; i == 0 && s < LSF_COUNT(states); s++)
            torture_frame(&t, &states[s]);
        torture_frame(&t, NULL);
        leave_wrong(&t, NULL);
        assert_int_equal(lsf_renderer_get_stats(t.renderer).samples, 2);
        check_state("statistics", &t.fresh);
        leave_wrong(&t, NULL);
        lsf_renderer_destroy(t.renderer);
        check_state("destroy", &t.fresh);
        assert_int_equal(lsf_context_get_info(t.context).gl_bytes, 0);
        assert_true(t.app.made_current > 5);
        lsf_context_destroy(t.context);
        glad_current = &t.app.gl.functions;
        assert_true(glIsTexture(t.app.texture) && glIsBuffer(t.app.buffer));
        close_application(&t.app);
        lsf_image_destroy(expected);
    }
    lsf_scene_destroy(scene);
}

/* What the contract demands is asked for. */
static void refused(void **user)
{
    (void)user;
    lsf_error error = {0};
    const lsf_context_wrap_params nothing = {LSF_CONTEXT_WRAP_PARAMS_DEFAULTS};
    assert_null(lsf_context_wrap(NULL, &error));
    assert_int_equal(error.code, LSF_ERROR_USAGE);
    assert_null(lsf_context_wrap(&nothing, &error));
    assert_int_equal(error.code, LSF_ERROR_USAGE);

    lsf_scene *scene = rig_scene(5.0f);
    application app = open_application(ops_of(gl_test_backend()));
    lsf_context *context = wrap(&app);
    lsf_renderer *renderer = rig_renderer(context, scene, "direct");
    static const char *const varying = "gl_Position";
    GLuint program = hostile_program();
    glTransformFeedbackVaryings(program, 1, &varying, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(program);
    glUseProgram(program);
    glBindVertexArray(app.vertex_array);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, app.buffer);
    glBeginTransformFeedback(GL_POINTS);
    assert_false(lsf_renderer_iterate(renderer, &error));
    assert_int_equal(error.code, LSF_ERROR_USAGE);
    assert_non_null(strstr(error.message, "transform feedback"));
    glEndTransformFeedback();
    assert_true(lsf_renderer_iterate(renderer, &error));
    lsf_renderer_destroy(renderer);
    lsf_context_destroy(context);
    glad_current = &app.gl.functions;
    close_application(&app);
    lsf_scene_destroy(scene);
}

/* Shaders are read where the application says. */
static void shader_folder(void **user)
{
    (void)user;
    lsf_error error = {0};
    lsf_scene *scene = rig_scene(5.0f);
    application app = open_application(ops_of(gl_test_backend()));
    const lsf_context_wrap_params params = {.get_proc_address = get_proc_address,
                                            .make_current = make_current,
                                            .user = &app,
                                            .shader_dir = "no-such-folder"};
    lsf_context *context = lsf_context_wrap(&params, &error);
    const lsf_render_params direct = rig_params("direct");
    assert_null(lsf_renderer_create(context, scene, &direct, &error));
    assert_non_null(strstr(error.message, "no-such-folder/"));
    lsf_context_destroy(context);
    glad_current = &app.gl.functions;
    close_application(&app);
    lsf_scene_destroy(scene);
}

int main(void)
{
    static lsf_backend backends[] = {LSF_BACKEND_EGL, LSF_BACKEND_OSMESA};
    const struct CMUnitTest tests[] = {
        {"hostile application, egl", hostile_application, NULL, NULL, &backends[0]},
        {"hostile application, osmesa", hostile_application, NULL, NULL, &backends[1]},
        cmocka_unit_test(refused),
        cmocka_unit_test(shader_folder),
    };
    return cmocka_run_group_tests_name("wrapped", tests, NULL, NULL);
}
