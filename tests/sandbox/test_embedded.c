/* A sandbox in a program's own context, between what that draws itself. */
#include "../passes/embedding_rig.h"
#include "sandbox_rig.h"

static const char shader[] =
    "// @buffer a\n"
    "// @channel 0 a filter=nearest\n"
    "// @define voxel.resolution=32\n"
    "// @define bundle.resolution=32\n"
    "void mainImage(out vec4 c, in vec2 p)\n"
    "{\n"
    "    vec3 d, q = lsf_position(p), e = lsf_light(0, q, d);\n"
    "    ivec3 cell; float far;\n"
    "    c = texelFetch(iChannel0, ivec2(p), 0) + vec4(lsf_albedo(p) * e, 1.0);\n"
    "    c.r += lsf_visibility(q, lsf_normal(p)) + lsf_voxel_radiance(lsf_voxel_from(q), -d, "
    "1.0).g;\n"
    "    c.b += float(lsf_voxel_trace(q, d, 9.0, cell, far)) + lsf_picture(p).b;\n"
    "    c.g += 0.1 * float(lsf_bundle_count(ivec2(p) / 2));\n"
    "}\n"
    "// @image\n"
    "// @channel 0 a filter=nearest\n"
    "void mainImage(out vec4 c, in vec2 p) { c = 0.1 * texelFetch(iChannel0, ivec2(p), 0); }\n";

static lsf_sandbox_params rig(void)
{
    lsf_sandbox_params params = sandbox_params(shader);
    params.render.technique = "direct";
    return params;
}

static void (*get_proc_address(void *user, const char *name))(void)
{
    return (void (*)(void))rig_foreign_function(user, name);
}

/* As little as a program can leave in order. */
static void leave_a_mess(void)
{
    glEnable(GL_BLEND);
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glScissor(0, 0, 1, 1);
    glBlendFunc(GL_ZERO, GL_ZERO);
    glColorMask(GL_FALSE, GL_FALSE, GL_TRUE, GL_FALSE);
    glDepthFunc(GL_NEVER);
    glCullFace(GL_FRONT_AND_BACK);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 7);
    glPixelStorei(GL_PACK_SKIP_ROWS, 3);
}

static void test_in_a_foreign_context(void **state)
{
    (void)state;
    if (!sandbox_context)
        skip();
    lsf_scene *scene = rig_scene(1);
    const lsf_sandbox_params params = rig();
    lsf_image *expected = sandbox_picture(scene, &params, 3);
    lsf_context_release_current(sandbox_context, NULL);
    rig_foreign gl = rig_open_foreign(&lsf_backend_osmesa);
    const lsf_context_wrap_params wrap = {.get_proc_address = get_proc_address, .user = &gl};
    lsf_error error = {0};
    lsf_context *context = lsf_context_wrap(&wrap, &error);
    lsf_sandbox *sandbox = lsf_sandbox_create(context, scene, &params, &error);
    if (!sandbox)
        fail_msg("%s", error.message);
    glad_current = &gl.functions;
    for (uint32_t i = 0; i < 3; i++) {
        lsf_sandbox_frame frame = {LSF_SANDBOX_FRAME_DEFAULTS};
        frame.number = i;
        frame.time = i / 60.0;
        leave_a_mess();
        if (!lsf_sandbox_run(sandbox, &frame, &error))
            fail_msg("%s", error.message);
        assert_false(glIsEnabled(GL_DEPTH_TEST));
    }
    lsf_image *image = lsf_sandbox_read(sandbox, &error);
    assert_same_pixels(image, expected);
    /* Its texture is there for the program, and is drawn where that wants it. */
    GLuint target, framebuffer;
    float texel[4], shown[3];
    glCreateTextures(GL_TEXTURE_2D, 1, &target);
    glTextureStorage2D(target, 1, GL_RGBA32F, 128, 64);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, target, 0);
    const int32_t viewport[4] = {64, 0, 64, 64};
    leave_a_mess();
    assert_true(
        lsf_sandbox_present(sandbox, framebuffer, viewport, 0, LSF_TONE_CURVE_NONE, &error));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glReadPixels(64 + 20, 20, 1, 1, GL_RGB, GL_FLOAT, shown);
    glGetTextureSubImage(lsf_sandbox_texture(sandbox), 0, 20, 20, 0, 1, 1, 1, GL_RGBA, GL_FLOAT,
                         sizeof texel, texel);
    assert_memory_equal(shown, texel, sizeof shown);
    assert_int_equal(glGetError(), GL_NO_ERROR);
    lsf_image_destroy(image);
    lsf_image_destroy(expected);
    lsf_sandbox_destroy(sandbox);
    assert_int_equal(lsf_context_get_info(context).gl_bytes, 0);
    lsf_context_destroy(context);
    rig_close_foreign(&gl);
    lsf_scene_destroy(scene);
}

/* Whatever allocation fails, nothing is left, and the next try succeeds. */
static void test_failing_allocations(void **state)
{
    (void)state;
    if (!sandbox_context)
        skip();
    lsf_scene *scene = rig_scene(1);
    const lsf_sandbox_params params = rig();
    bool made = false;
    for (uint64_t n = 1; !made && n < 1000; n += 7) {
        lsf_error error = {0};
        lsf_context_fail_allocation(sandbox_context, n);
        lsf_sandbox *sandbox = lsf_sandbox_create(sandbox_context, scene, &params, &error);
        made = sandbox != NULL;
        if (!made)
            assert_int_equal(error.code, LSF_ERROR_RENDER);
        lsf_context_fail_allocation(sandbox_context, 0);
        lsf_sandbox_destroy(sandbox);
        assert_int_equal(lsf_context_get_info(sandbox_context).gl_bytes, 0);
    }
    assert_true(made);
    lsf_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_failing_allocations),
                                       cmocka_unit_test(test_in_a_foreign_context)};
    return cmocka_run_group_tests(tests, sandbox_setup, sandbox_teardown);
}
