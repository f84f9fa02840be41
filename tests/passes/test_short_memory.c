/* Each allocation of a rendering fails in its turn: an error that says so and nothing left behind,
 * or the same picture. What drivers and libraries allocate does not fail here. */
#include "base/base.h"
#include "render_gl.h"

enum { SIZE = 8 };

/* Of the allocations, so that the test takes seconds; 1: all. */
#ifndef STRIDE
#define STRIDE 61
#endif

static uint64_t allocations, fail_at = UINT64_MAX;

static bool fails(void)
{
    return allocations++ == fail_at;
}

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
char *__real_strdup(const char *text);
char *__real_strndup(const char *text, size_t most);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
char *__wrap_strdup(const char *text);
char *__wrap_strndup(const char *text, size_t most);

void *__wrap_malloc(size_t size)
{
    return fails() ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size)
{
    return fails() ? NULL : __real_calloc(count, size);
}

void *__wrap_realloc(void *block, size_t size)
{
    return fails() ? NULL : __real_realloc(block, size);
}

char *__wrap_strdup(const char *text)
{
    return fails() ? NULL : __real_strdup(text);
}

char *__wrap_strndup(const char *text, size_t most)
{
    return fails() ? NULL : __real_strndup(text, most);
}

/* A glossy corner with glass, a lamp and a textured wall, under a sky. */
static lsf_scene *full_scene(void)
{
    static const uint8_t texels[4 * 3] = {255, 180, 120, 100, 200, 255,
                                          220, 255, 140, 128, 128, 255};
    lsf_scene *scene = build_scene();
    build_lit_corner(scene);
    build_environment(scene, 1.0f);
    scene->vertices.uv0 = calloc(scene->vertices.count, 2 * sizeof *scene->vertices.uv0);
    uint32_t texture = build_texture(scene, 2, 2, 3, texels, true);
    scene->materials[0].base_color_texture.texture = texture;
    finish_gl_scene(scene);
    return scene;
}

static bool same_pixels(const lsf_image *a, const lsf_image *b)
{
    return memcmp(a->pixels, b->pixels,
                  (size_t)a->width * a->height * a->channel_count * sizeof *a->pixels) == 0;
}

static lsf_image *render(lsf_context *context, const lsf_scene *scene,
                         const lsf_render_params *params, lsf_error *error)
{
    lsf_renderer *renderer = lsf_renderer_create(context, scene, params, error);
    lsf_image *image = NULL;
    if (renderer && lsf_renderer_run(renderer, error))
        image = lsf_renderer_read(renderer, error);
    lsf_renderer_destroy(renderer);
    return image;
}

static void check(const char *technique)
{
    static const char *const options[] = {"voxel.resolution=16",      "rsm.resolution=16",
                                          "vpl.shadow_resolution=16", "bundle.resolution=16",
                                          "environment.directions=1", "cloud.count=8192"};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .bounces = 1};
    params.technique = technique;
    params.samples = 1;
    params.aovs = LSF_AOV_ALL;
    params.options = options;
    params.option_count = LSF_COUNT(options);
    params = corner_params(params, SIZE);
    lsf_scene *scene = full_scene();
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    lsf_error error = {0};
    lsf_image *expected = render(context, scene, &params, &error);
    if (!expected)
        fail_msg("%s", error.message);
    uint64_t refused = 0, done = 0, bad = 0;
    for (uint64_t n = 0;; n += STRIDE) {
        error = (lsf_error){0};
        allocations = 0;
        fail_at = n;
        lsf_image *image = render(context, scene, &params, &error);
        fail_at = UINT64_MAX;
        assert_int_equal(lsf_context_get_info(context).gl_bytes, 0);
        gl_test_check(context);
        bool good = image ? same_pixels(image, expected)
                          : error.code == LSF_ERROR_RENDER && error.message[0] != '\0';
        if (!good)
            print_message("allocation %llu: %s, \"%s\"\n", (unsigned long long)n,
                          image ? "another picture" : "no reason", error.message);
        bad += !good;
        refused += !image;
        done += image != NULL;
        lsf_image_destroy(image);
        if (allocations <= n)
            break;
    }
    print_message("%s: %llu errors, %llu pictures, %llu allocations\n", technique,
                  (unsigned long long)refused, (unsigned long long)done,
                  (unsigned long long)allocations);
    assert_true(bad == 0 && refused > done);
    lsf_image_destroy(expected);
    lsf_context_destroy(context);
    destroy_scene(scene);
}

static void allocations_fail(void **unused)
{
    (void)unused;
    static const char *const techniques[] = {"direct", "bidirectional", "voxel_path", "cone",
                                             "substitute_tree"};
    for (size_t i = 0; i < LSF_COUNT(techniques); i++)
        check(techniques[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(allocations_fail)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
