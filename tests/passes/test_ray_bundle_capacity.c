/* Room for nodes that runs out while a picture is made: the host learns of it late, and the picture
 * has the same bits as with ample room. */
#include <math.h>
#include <stdio.h>

#include "base/base.h"
#include "render_gl.h"

enum { SAMPLES = 10, SIDE = 64 };

typedef struct outcome {
    lsf_image *image;
    uint64_t nodes, chained, regrown;
} outcome;

/* A room that shines, and a sphere in it. */
static lsf_scene *room(void)
{
    lsf_scene *scene = build_scene();
    lsf_material *walls = build_material(scene, 0.5f, 0.5f, 0.5f);
    walls->emission[0] = walls->emission[1] = 1.0f;
    build_box(scene, lsf_f3(-1.5f, -1.5f, -3), lsf_f3(1.5f, 1.5f, 3), true);
    build_material(scene, 0.9f, 0.2f, 0.1f);
    build_sphere(scene, 3, false);
    finish_gl_scene(scene);
    return scene;
}

static uint64_t count_of(const lsf_renderer_stats *stats, const char *name)
{
    for (uint32_t i = 0; i < stats->pass_count; i++)
        for (uint32_t c = 0; c < stats->passes[i].count_count; c++)
            if (!strcmp(stats->passes[i].name, "ray_bundle_build") &&
                !strcmp(stats->passes[i].count_names[c], name))
                return stats->passes[i].counts[c];
    fail_msg("nothing counts %s", name);
    return 0;
}

/* With room for `chained` nodes; all of them are chained. `looks`: the picture is read after the
 * first sample and after the fourth, too. */
static outcome render(const lsf_scene *scene, uint32_t bounces, double chained, uint32_t samples,
                      bool looks)
{
    static const float eye[3] = {0.3f, 0.5f, 2.9f}, target[3] = {0, 0, 0};
    char text[64];
    snprintf(text, sizeof text, "bundle.capacity=%.9g", chained / (SIDE * SIDE));
    const char *const options[] = {text, "bundle.resolution=64", "bundle.slices=0"};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    lsf_error error = {0};
    params.technique = "bidirectional";
    params.width = 40;
    params.height = 30;
    params.samples = samples;
    params.bounces = bounces;
    params.camera_position = eye;
    params.camera_target = target;
    params.options = options;
    params.option_count = LSF_COUNT(options);
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    for (uint32_t i = 0; looks && i < samples; i++) {
        assert_true(lsf_renderer_iterate(renderer, &error));
        if (i == 0 || i == 3)
            lsf_image_destroy(lsf_renderer_read(renderer, &error));
    }
    if (!lsf_renderer_run(renderer, &error))
        fail_msg("%s", error.message);
    outcome result = {.image = lsf_renderer_read(renderer, &error)};
    const lsf_renderer_stats stats = lsf_renderer_get_stats(renderer);
    assert_non_null(result.image);
    assert_int_equal(stats.samples, samples);
    assert_int_equal(lsf_context_get_info(context).gl_bytes,
                     lsf_plan_bytes(lsf_renderer_plan(renderer)));
    result.nodes = count_of(&stats, "nodes");
    result.chained = count_of(&stats, "chained");
    result.regrown = count_of(&stats, "regrown");
    lsf_renderer_destroy(renderer);
    gl_test_check(context);
    lsf_context_destroy(context);
    return result;
}

static void same(const outcome *a, const outcome *b)
{
    assert_memory_equal(a->image->pixels, b->image->pixels,
                        sizeof(float) * a->image->width * a->image->height *
                            a->image->channel_count);
    assert_int_equal(a->nodes, b->nodes);
    assert_int_equal(a->chained, b->chained);
}

/* From the first iteration on, with one bundle and with several an iteration. */
static void too_little_at_first(void **unused)
{
    (void)unused;
    lsf_scene *scene = room();
    for (uint32_t bounces = 0; bounces <= 2; bounces += 2) {
        outcome ample = render(scene, bounces, 64.0 * SIDE * SIDE, SAMPLES, false);
        assert_true(ample.regrown == 0 && ample.chained == ample.nodes && ample.nodes > 10000);
        for (int looks = 0; looks < 2; looks++) {
            outcome scarce = render(scene, bounces, 1.0, SAMPLES, looks);
            assert_true(scarce.regrown > 0);
            same(&scarce, &ample);
            lsf_image_destroy(scarce.image);
        }
        lsf_image_destroy(ample.image);
    }
    destroy_scene(scene);
}

/* Room for exactly the nodes of the first iteration, of which a later one has more. */
static void too_little_later(void **unused)
{
    (void)unused;
    lsf_scene *scene = room();
    uint64_t before = 0, first = 0, most = 0;
    for (uint32_t samples = 1; samples <= SAMPLES; samples++) {
        outcome ample = render(scene, 0, 64.0 * SIDE * SIDE, samples, false);
        uint64_t needed = ample.chained - before;
        before = ample.chained;
        first = samples == 1 ? needed : first;
        most = needed > most ? needed : most;
        if (samples == SAMPLES) {
            print_message("%llu nodes at first, %llu at most\n", (unsigned long long)first,
                          (unsigned long long)most);
            assert_true(most > first + 1);
            for (int looks = 0; looks < 2; looks++) {
                outcome scarce = render(scene, 0, (double)first, SAMPLES, looks);
                assert_int_equal(scarce.regrown, 1);
                same(&scarce, &ample);
                lsf_image_destroy(scarce.image);
            }
        }
        lsf_image_destroy(ample.image);
    }
    destroy_scene(scene);
}

/* A floor below `layers` coincident ceilings that shine. */
static lsf_scene *under_layers(uint32_t layers)
{
    const lsf_float3 quad[6] = {{-2, 1, -2}, {2, 1, -2}, {2, 1, 2},
                                {-2, 1, -2}, {2, 1, 2},  {-2, 1, 2}};
    lsf_scene *scene = build_scene();
    build_material(scene, 0.8f, 0.6f, 0.4f);
    build_floor(scene, 0.0f, 2.0f);
    build_material(scene, 0, 0, 0)->emission[1] = 1.0f;
    lsf_float3 *corners = lsf_alloc(layers, sizeof quad);
    assert_non_null(corners);
    for (uint32_t i = 0; i < layers; i++)
        memcpy(corners + 6 * (size_t)i, quad, sizeof quad);
    build_triangles(scene, corners, 2 * layers);
    free(corners);
    finish_gl_scene(scene);
    return scene;
}

/* More surfaces than any storage block of 128 MiB holds: fewer texels are used, and as many layers
 * seen as one. */
static void thousands_of_layers(void **unused)
{
    (void)unused;
    double mean[2];
    for (int many = 0; many < 2; many++) {
        lsf_scene *scene = under_layers(many ? 3200 : 1);
        const char *const options[] = {"bundle.resolution=64", "bundle.slices=0", "vpl.count=0"};
        lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
        params.technique = "bidirectional";
        params.samples = 6;
        params.bounces = 0;
        params.options = options;
        params.option_count = LSF_COUNT(options);
        lsf_image *image = render_gl_from(scene, params, 8, lsf_f3(0, 0.9f, 0.1f), lsf_f3(0, 0, 0));
        double rgb[3];
        mean_rgb(image, 0, rgb);
        mean[many] = rgb[1];
        lsf_image_destroy(image);
        destroy_scene(scene);
    }
    print_message("%g by 1 layer, %g by 3200\n", mean[0], mean[1]);
    assert_true(mean[0] > 0.1 && fabs(mean[1] / mean[0] - 1.0) < 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(too_little_at_first),
        cmocka_unit_test(too_little_later),
        cmocka_unit_test(thousands_of_layers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
