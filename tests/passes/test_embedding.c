/* Renderers in a program that has other contexts and other threads. */
#include <pthread.h>

#include "embedding_rig.h"

/* --- another context on the same thread --------------------------------------------------------
 */

/* Names of objects start from 1 in every context: what the library took for its own would be some
 * of these. */
enum { FOREIGN_TEXTURES = 64 };

static void foreign_context_between_calls(void **state)
{
    lsf_backend backend = *(const lsf_backend *)*state;
    lsf_context *context = gl_test_context(backend, NULL);
    lsf_scene *scene = rig_scene(5.0f);
    lsf_renderer *renderer = rig_renderer(context, scene, "direct");
    rig_foreign f = rig_open_foreign(context->ops);
    lsf_error error = {0};
    GLuint textures[FOREIGN_TEXTURES];
    f.functions.CreateTextures(GL_TEXTURE_2D, FOREIGN_TEXTURES, textures);

    assert_true(f.ops->make_current(f.platform, &error));
    rig_run(renderer);
    assert_true(f.ops->make_current(f.platform, &error));
    lsf_image *picture = lsf_renderer_read(renderer, &error);
    assert_non_null(picture);
    assert_true(f.ops->make_current(f.platform, &error));
    assert_int_equal(lsf_renderer_get_stats(renderer).samples, 2);
    assert_true(f.ops->make_current(f.platform, &error));
    lsf_renderer_destroy(renderer);
    assert_true(f.ops->make_current(f.platform, &error));
    assert_int_equal(lsf_context_get_info(context).gl_bytes, 0);
    lsf_context_destroy(context);

    assert_true(f.ops->make_current(f.platform, &error));
    for (int i = 0; i < FOREIGN_TEXTURES; i++)
        assert_true(f.functions.IsTexture(textures[i]));
    assert_int_equal(f.functions.GetError(), GL_NO_ERROR);
    rig_close_foreign(&f);

    lsf_image *expected = rig_alone(backend, scene, "direct");
    assert_same_pixels(picture, expected);
    lsf_image_destroy(picture);
    lsf_image_destroy(expected);
    lsf_scene_destroy(scene);
}

/* A renderer's functions need no call that makes its context current. */
static void two_contexts_on_a_thread(void **state)
{
    (void)state;
    static const lsf_backend backends[2][2] = {{LSF_BACKEND_OSMESA, LSF_BACKEND_OSMESA},
                                               {LSF_BACKEND_OSMESA, LSF_BACKEND_EGL}};
    lsf_scene *scenes[2] = {rig_scene(5.0f), rig_scene(2.0f)};
    for (int pair = 0; pair < 2; pair++) {
        lsf_context *contexts[2];
        lsf_renderer *renderers[2];
        lsf_image *expected[2];
        for (int i = 0; i < 2; i++)
            expected[i] = rig_alone(backends[pair][i], scenes[i], "direct");
        for (int i = 0; i < 2; i++) {
            contexts[i] = gl_test_context(backends[pair][i], NULL);
            renderers[i] = rig_renderer(contexts[i], scenes[i], "direct");
        }
        rig_run(renderers[0]);
        rig_run(renderers[1]);
        rig_check_picture(renderers[0], expected[0]);
        rig_check_picture(renderers[1], expected[1]);
        assert_int_equal(lsf_renderer_get_stats(renderers[0]).samples, 2);
        for (int i = 0; i < 2; i++) {
            lsf_renderer_destroy(renderers[i]);
            assert_int_equal(lsf_context_get_info(contexts[i]).gl_bytes, 0);
            gl_test_check(contexts[i]);
            lsf_image_destroy(expected[i]);
        }
        for (int i = 0; i < 2; i++)
            lsf_context_destroy(contexts[i]);
    }
    lsf_scene_destroy(scenes[0]);
    lsf_scene_destroy(scenes[1]);
}

/* --- pictures that stay on the GPU --- */

enum { FRAME = 40, LEFT = 5, BOTTOM = 3 };

/* Code values in a part of the framebuffer, and what was there around it. */
static void check_presented(const GLubyte (*texels)[4], uint32_t size, uint32_t scale,
                            const uint8_t *rgb)
{
    for (uint32_t y = 0; y < FRAME; y++)
        for (uint32_t x = 0; x < FRAME; x++) {
            const GLubyte *got = texels[y * FRAME + x];
            uint32_t u = (x - LEFT) / scale, v = (y - BOTTOM) / scale;
            bool within = x >= LEFT && y >= BOTTOM && u < size && v < size;
            const uint8_t around[3] = {255, 0, 255};
            assert_memory_equal(got, within ? rgb + 3 * ((size - 1 - v) * size + u) : around, 3);
        }
}

static void present(lsf_renderer *renderer, GLuint framebuffer, GLuint target, uint32_t size,
                    uint32_t scale, const uint8_t *rgb)
{
    static GLubyte texels[FRAME * FRAME][4];
    lsf_error error = {0};
    int32_t side = (int32_t)(size * scale);
    const int32_t viewport[4] = {LEFT, BOTTOM, side, side};
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, (const float[4]){1, 0, 1, 1});
    if (!lsf_renderer_present(renderer, framebuffer, viewport, 0.5f, LSF_TONE_CURVE_ACES, &error))
        fail_msg("%s", error.message);
    glGetTextureImage(target, 0, GL_RGBA, GL_UNSIGNED_BYTE, sizeof texels, texels);
    check_presented((const GLubyte(*)[4])texels, size, scale, rgb);
}

static void pictures_on_the_gpu(void **state)
{
    (void)state;
    lsf_error error = {0};
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    lsf_scene *scene = rig_scene(5.0f);
    lsf_render_params params = rig_params("direct");
    params.width = params.height = 16;
    params.present = params.rgb8 = true;
    params.aovs = LSF_AOV_NORMAL;
    lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
    assert_non_null(renderer);
    assert_int_equal(lsf_renderer_texture(renderer, 0, &error), 0); /* nothing was rendered */
    rig_run(renderer);

    lsf_image *image = lsf_renderer_read(renderer, &error);
    static float texels[16 * 16][4];
    for (uint32_t layer = 0; layer < 2; layer++) {
        GLuint texture = lsf_renderer_texture(renderer, layer ? LSF_AOV_NORMAL : 0, &error);
        assert_int_not_equal(texture, 0);
        glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT, sizeof texels, texels);
        for (uint32_t i = 0; i < 16 * 16; i++)
            assert_memory_equal(texels[(15 - i / 16) * 16 + i % 16],
                                image->pixels + (size_t)6 * i + 3 * layer, 12);
    }
    static float rows[16][20][3];
    assert_false(lsf_renderer_read_into(renderer, 0, rows[0][0], 16 * 12 - 1, &error));
    assert_int_equal(error.code, LSF_ERROR_USAGE);
    assert_true(
        lsf_renderer_read_into(renderer, LSF_AOV_NORMAL, rows[0][0], sizeof rows[0], &error));
    for (uint32_t i = 0; i < 16 * 16; i++)
        assert_memory_equal(rows[i / 16][i % 16], image->pixels + (size_t)6 * i + 3, 12);
    assert_int_equal(lsf_renderer_texture(renderer, LSF_AOV_DEPTH, &error), 0);
    assert_int_equal(error.code, LSF_ERROR_USAGE);
    lsf_image_destroy(image);

    uint8_t rgb[16 * 16 * 3];
    assert_true(lsf_renderer_read_rgb8(renderer, 0.5f, LSF_TONE_CURVE_ACES, rgb, &error));
    GLuint target, framebuffer;
    glCreateTextures(GL_TEXTURE_2D, 1, &target);
    glTextureStorage2D(target, 1, GL_RGBA8, FRAME, FRAME);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, target, 0);
    present(renderer, framebuffer, target, 16, 1, rgb);
    present(renderer, framebuffer, target, 16, 2, rgb);
    assert_false(lsf_renderer_present(renderer, framebuffer, NULL, 0, LSF_TONE_CURVE_NONE, &error));
    assert_int_equal(error.code, LSF_ERROR_USAGE);
    const int32_t viewport[4] = {0, 0, 16, 16};
    assert_false(lsf_renderer_present(renderer, 4711, viewport, 0, LSF_TONE_CURVE_NONE, &error));
    assert_non_null(strstr(error.message, "framebuffer 4711"));
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &target);
    lsf_renderer_destroy(renderer);
    gl_test_check(context);
    lsf_context_destroy(context);
    lsf_scene_destroy(scene);
}

/* --- threads -----------------------------------------------------------------------------------
 */

typedef struct job {
    lsf_context *context; /* NULL: the thread makes one */
    lsf_renderer *renderer;
    const lsf_scene *scene;
    const char *technique;
    lsf_image *image;
    lsf_error error;
} job;

/* cmocka fails on its own thread alone: what is wrong comes back in `error`. */
static void *work(void *user)
{
    job *j = user;
    const lsf_context_params context_params = {LSF_CONTEXT_PARAMS_DEFAULTS,
                                               .backend = gl_test_backend()};
    const lsf_render_params params = rig_params(j->technique);
    bool own = !j->context;
    if (own)
        j->context = lsf_context_create(&context_params, &j->error);
    if (own && j->context)
        j->renderer = lsf_renderer_create(j->context, j->scene, &params, &j->error);
    if (j->renderer && lsf_renderer_run(j->renderer, &j->error))
        j->image = lsf_renderer_read(j->renderer, &j->error);
    if (own) {
        lsf_renderer_destroy(j->renderer);
        lsf_context_destroy(j->context);
    } else {
        lsf_context_release_current(j->context, &j->error);
    }
    return NULL;
}

static void finish_job(job *j, const lsf_image *expected)
{
    if (!j->image)
        fail_msg("%s: %s", j->technique, j->error.message);
    assert_same_pixels(j->image, expected);
    lsf_image_destroy(j->image);
}

static void threads_with_a_context_each(void **state)
{
    (void)state;
    static const char *const techniques[] = {"direct", "bidirectional", "voxel_path"};
    enum { THREADS = LSF_COUNT(techniques) };
    lsf_scene *scene = rig_scene(5.0f);
    lsf_image *expected[THREADS];
    pthread_t threads[THREADS];
    job jobs[THREADS];
    for (int i = 0; i < THREADS; i++) {
        expected[i] = rig_alone(gl_test_backend(), scene, techniques[i]);
        jobs[i] = (job){.scene = scene, .technique = techniques[i]};
    }
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, work, &jobs[i]), 0);
    for (int i = 0; i < THREADS; i++)
        pthread_join(threads[i], NULL);
    for (int i = 0; i < THREADS; i++) {
        finish_job(&jobs[i], expected[i]);
        lsf_image_destroy(expected[i]);
    }
    lsf_scene_destroy(scene);
}

static void context_goes_to_another_thread(void **state)
{
    lsf_backend backend = *(const lsf_backend *)*state;
    lsf_scene *scene = rig_scene(5.0f);
    lsf_image *expected = rig_alone(backend, scene, "direct");
    lsf_context *context = gl_test_context(backend, NULL);
    lsf_error error = {0};
    job j = {.context = context, .scene = scene, .technique = "direct"};
    j.renderer = rig_renderer(context, scene, "direct");
    assert_true(lsf_context_release_current(context, &error));
    assert_false(lsf_context_release_current(context, &error));
    assert_int_equal(error.code, LSF_ERROR_USAGE);
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, work, &j), 0);
    pthread_join(thread, NULL);
    finish_job(&j, expected);
    rig_check_picture(j.renderer, expected);
    lsf_renderer_destroy(j.renderer);
    gl_test_check(context);
    lsf_context_destroy(context);
    lsf_image_destroy(expected);
    lsf_scene_destroy(scene);
}

int main(void)
{
    static lsf_backend backends[] = {LSF_BACKEND_EGL, LSF_BACKEND_OSMESA};
    const struct CMUnitTest tests[] = {
        {"foreign context, egl", foreign_context_between_calls, NULL, NULL, &backends[0]},
        {"foreign context, osmesa", foreign_context_between_calls, NULL, NULL, &backends[1]},
        cmocka_unit_test(two_contexts_on_a_thread),
        cmocka_unit_test(pictures_on_the_gpu),
        cmocka_unit_test(threads_with_a_context_each),
        {"another thread, egl", context_goes_to_another_thread, NULL, NULL, &backends[0]},
        {"another thread, osmesa", context_goes_to_another_thread, NULL, NULL, &backends[1]},
    };
    return cmocka_run_group_tests_name("embedding", tests, NULL, NULL);
}
