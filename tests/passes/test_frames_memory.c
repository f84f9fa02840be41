/* Frames, renderers and contexts come and go, and memory stays what it was. */
#include <malloc.h>

#include "base/base.h"
#include "render_gl.h"

#include <lightsheaf/edit.h>

/* What the driver holds now and then, of work that it has not done yet. */
#define DRIVER_BYTES ((uint64_t)3 << 20)

/* Of the C library's heap, in use; 0 where a sanitizer brings a heap of its own, which tells of
 * leaks itself. */
static uint64_t heap_bytes(void)
{
    return mallinfo2().uordblks;
}

static lsf_scene *moving_scene(void)
{
    lsf_scene *scene = build_scene();
    build_corner(scene);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
    finish_gl_scene(scene);
    return scene;
}

static lsf_render_params tiny_params(const char *technique)
{
    static const char *const options[] = {"rsm.resolution=32", "vpl.shadow_resolution=32",
                                          "bundle.resolution=32"};
    return (lsf_render_params){LSF_RENDER_PARAMS_DEFAULTS,
                               .technique = technique,
                               .bounces = 1,
                               .width = 4,
                               .height = 4,
                               .samples = 1,
                               .options = options,
                               .option_count = LSF_COUNT(options)};
}

static void require(bool good, const lsf_error *error)
{
    if (!good)
        fail_msg("%s", error->message);
}

static void run_frames(lsf_renderer *renderer, lsf_scene *scene, uint32_t first, uint32_t count)
{
    lsf_error error = {0};
    for (uint32_t k = first; k < first + count; k++) {
        const double matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.001 * (k % 100), 0, 0, 1};
        const lsf_frame frame = {.first_sample = k};
        require(lsf_scene_set_node(scene, scene->node_count - 2, matrix, &error) &&
                    lsf_renderer_begin_frame(renderer, &frame, &error) &&
                    lsf_renderer_iterate(renderer, &error),
                &error);
    }
}

static void frames_allocate_nothing(void **unused)
{
    (void)unused;
    static const char *const techniques[] = {"direct", "bidirectional"};
    const char *wanted = getenv("LSF_FRAMES");
    const uint32_t count = wanted ? (uint32_t)atoi(wanted) : 1000;
    for (size_t t = 0; t < LSF_COUNT(techniques); t++) {
        lsf_error error = {0};
        lsf_scene *scene = moving_scene();
        lsf_context *context = gl_test_context(gl_test_backend(), NULL);
        lsf_render_params params = tiny_params(techniques[t]);
        lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
        require(renderer != NULL, &error);
        run_frames(renderer, scene, 0, 50); /* the driver compiles, and lists grow to their size */
        uint64_t heap = heap_bytes(), gl = lsf_context_get_info(context).gl_bytes;
        run_frames(renderer, scene, 50, count);
        uint64_t more = heap_bytes() > heap ? heap_bytes() - heap : 0;
        if (more > DRIVER_BYTES)
            fail_msg("%s: %llu bytes more after %u frames", techniques[t], (unsigned long long)more,
                     count);
        assert_int_equal(lsf_context_get_info(context).gl_bytes, gl);
        lsf_renderer_destroy(renderer);
        gl_test_check(context);
        lsf_context_destroy(context);
        lsf_scene_destroy(scene);
    }
}

static void renderers_and_contexts_give_back_all(void **unused)
{
    (void)unused;
    const char *wanted = getenv("LSF_CONTEXTS");
    const uint32_t count = wanted ? (uint32_t)atoi(wanted) : 10, warm = 4;
    lsf_scene *scene = moving_scene();
    uint64_t heap = 0;
    for (uint32_t i = 0; i < warm + count; i++) {
        lsf_error error = {0};
        if (i == warm)
            heap = heap_bytes();
        lsf_context *context = gl_test_context(gl_test_backend(), NULL);
        lsf_render_params params = tiny_params("direct");
        lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
        require(renderer && lsf_renderer_run(renderer, &error), &error);
        lsf_renderer_destroy(renderer);
        lsf_context_destroy(context);
    }
    uint64_t more = heap_bytes() > heap ? heap_bytes() - heap : 0;
    if (more > (uint64_t)4096 * count)
        fail_msg("%llu bytes more after %u contexts", (unsigned long long)more, count);
    lsf_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_allocate_nothing),
        cmocka_unit_test(renderers_and_contexts_give_back_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
