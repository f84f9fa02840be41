/* The same bits: twice, through OSMesa and EGL, for any number of threads, at any scale by powers
 * of two; and stability at the extremes. */
#include <math.h>

#include "light_rules.h"

/* A floor, a box and a sphere under a point light, a spot and a sun; lengths times `scale`. */
static lsf_scene *extreme_scene(float scale)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.8f, 0.6f, 0.4f);
    build_floor(scene, 0.0f, 4.0f * scale);
    build_material(scene, 0.2f, 0.5f, 0.9f)->roughness = 0.3f;
    build_box(scene, lsf_f3(0.5f * scale, 0, 0.5f * scale), lsf_f3(scale, scale, scale), false);
    build_material(scene, 0.9f, 0.9f, 0.9f)->metallic = 1.0f;
    build_sphere(scene, 3, false);
    for (uint64_t i = 3 * scene->primitives[2].first_vertex; i < 3 * scene->vertices.count; i++)
        scene->vertices.position[i] *= 0.5f * scale;
    for (int i = 0; i < 3; i++) {
        scene->primitives[2].bounds_min[i] *= 0.5f * scale;
        scene->primitives[2].bounds_max[i] *= 0.5f * scale;
    }
    float squared = scale * scale;
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(-scale, 2 * scale, scale), lsf_f3(0, -1, 0),
                10.0f * squared);
    lsf_light *spot = build_light(scene, LSF_LIGHT_SPOT, lsf_f3(2 * scale, 2 * scale, 2 * scale),
                                  lsf_f3(-0.6f, -0.6f, -0.5f), 20.0f * squared);
    spot->inner_cone = 0.2f;
    spot->outer_cone = 0.5f;
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(0.3f, -0.9f, -0.2f), 1.0f);
    scene->cameras[0].near_plane *= scale;
    finish_gl_scene(scene);
    return scene;
}

static lsf_image *render_extreme(lsf_backend backend, const lsf_scene *scene, float scale,
                                 uint32_t width, uint32_t height)
{
    const float position[3] = {scale, 3 * scale, 5 * scale}, target[3] = {0, 0.3f * scale, 0};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "direct";
    params.width = width;
    params.height = height;
    params.samples = 4;
    params.seed = 7;
    params.camera_position = position;
    params.camera_target = target;
    params.aovs = LSF_AOV_NORMAL | LSF_AOV_ALBEDO;
    return render_gl(backend, scene, &params);
}

static void assert_finite_and_lit(const lsf_image *image)
{
    double sum = 0.0;
    for (uint64_t i = 0; i < (uint64_t)image->width * image->height * image->channel_count; i++) {
        assert_true(isfinite(image->pixels[i]));
        sum += (double)image->pixels[i];
    }
    assert_true(sum > 0.0);
}

static void same_bits_twice_and_on_each_backend(void **unused)
{
    (void)unused;
    lsf_scene *scene = extreme_scene(1.0f);
    lsf_image *first = render_extreme(gl_test_backend(), scene, 1.0f, 96, 64);
    lsf_image *second = render_extreme(gl_test_backend(), scene, 1.0f, 96, 64);
    lsf_image *egl = render_extreme(LSF_BACKEND_EGL, scene, 1.0f, 96, 64);
    assert_finite_and_lit(first);
    assert_same_pixels(first, second);
    assert_same_pixels(first, egl);
    lsf_image_destroy(first);
    lsf_image_destroy(second);
    lsf_image_destroy(egl);
    destroy_scene(scene);
}

static void same_bits_for_any_thread_count(void **unused)
{
    (void)unused;
    static const char *const threads[] = {"0", "1", "8"};
    lsf_scene *scene = extreme_scene(1.0f);
    lsf_image *images[3];
    for (int i = 0; i < 3; i++) {
        setenv("LP_NUM_THREADS", threads[i], 1);
        images[i] = render_extreme(gl_test_backend(), scene, 1.0f, 96, 64);
        assert_same_pixels(images[0], images[i]);
    }
    unsetenv("LP_NUM_THREADS");
    for (int i = 0; i < 3; i++)
        lsf_image_destroy(images[i]);
    destroy_scene(scene);
}

static void same_bits_at_any_scale(void **unused)
{
    (void)unused;
    static const float scales[] = {1.0f, 0x1p20f, 0x1p-20f};
    lsf_image *images[3];
    for (int i = 0; i < 3; i++) {
        lsf_scene *scene = extreme_scene(scales[i]);
        images[i] = render_extreme(gl_test_backend(), scene, scales[i], 96, 64);
        assert_same_pixels(images[0], images[i]);
        destroy_scene(scene);
    }
    for (int i = 0; i < 3; i++)
        lsf_image_destroy(images[i]);
}

/* relMSE < 1e-6 against the unscaled scene, which differs by rounding only. */
static void nearly_the_same_at_scales_of_ten(void **unused)
{
    (void)unused;
    static const float scales[] = {1.0f, 1e6f, 1e-6f};
    lsf_image *images[3];
    for (int i = 0; i < 3; i++) {
        lsf_scene *scene = extreme_scene(scales[i]);
        images[i] = render_extreme(gl_test_backend(), scene, scales[i], 96, 64);
        lsf_compare_params params = {LSF_COMPARE_PARAMS_DEFAULTS};
        lsf_compare_result result;
        lsf_error error;
        assert_true(lsf_compare(images[i], images[0], &params, &result, &error));
        print_message("scale %g: relMSE %g\n", (double)scales[i], result.relmse);
        assert_true(result.relmse < 1e-6 && result.non_finite_test == 0);
        destroy_scene(scene);
    }
    for (int i = 0; i < 3; i++)
        lsf_image_destroy(images[i]);
}

static void light_intensity_scales_exactly(void **unused)
{
    (void)unused;
    static const float factors[] = {1.0f, 0x1p60f, 0x1p-60f};
    lsf_image *images[3];
    for (int i = 0; i < 3; i++) {
        lsf_scene *scene = extreme_scene(1.0f);
        for (uint32_t l = 0; l < scene->light_count; l++)
            for (int c = 0; c < 3; c++)
                scene->lights[l].intensity[c] *= factors[i];
        images[i] = render_extreme(gl_test_backend(), scene, 1.0f, 48, 32);
        for (uint32_t p = 0; p < 48 * 32 * images[i]->channel_count; p++)
            if (p % images[i]->channel_count < 3)
                assert_true(images[i]->pixels[p] == images[0]->pixels[p] * factors[i]);
        destroy_scene(scene);
    }
    for (int i = 0; i < 3; i++)
        lsf_image_destroy(images[i]);
}

static void odd_sizes(void **unused)
{
    (void)unused;
    static const uint32_t sizes[][2] = {{1, 1}, {7, 13}, {16384, 1}};
    lsf_scene *scene = extreme_scene(1.0f);
    for (int i = 0; i < 3; i++) {
        lsf_image *image = render_extreme(gl_test_backend(), scene, 1.0f, sizes[i][0], sizes[i][1]);
        assert_int_equal(image->width, sizes[i][0]);
        assert_finite_and_lit(image);
        lsf_image_destroy(image);
    }
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "direct";
    params.width = 1000000;
    params.height = 1;
    lsf_error error = {0};
    assert_null(lsf_renderer_create(context, scene, &params, &error));
    assert_int_equal(error.code, LSF_ERROR_RENDER);
    GLint most;
    char says[64];
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    snprintf(says, sizeof says, "%d,1 pixels", most);
    assert_non_null(strstr(error.message, says));
    gl_test_check(context);
    lsf_context_destroy(context);
    destroy_scene(scene);
}

static void empty_and_flat_scenes(void **unused)
{
    (void)unused;
    lsf_scene *empty = build_scene();
    empty->environment = (lsf_environment){.present = true, .radiance = {0.5f, 0.5f, 0.5f}};
    build_light(empty, LSF_LIGHT_POINT, lsf_f3(0, 2, 0), lsf_f3(0, -1, 0), 1.0f);
    finish_gl_scene(empty);
    lsf_image *image = render_extreme(gl_test_backend(), empty, 1.0f, 8, 8);
    assert_true(image->pixels[0] == 0.5f);
    lsf_image_destroy(image);
    destroy_scene(empty);

    /* One axis-aligned triangle: bounds without volume, under each kind of light. */
    const lsf_float3 corners[3] = {{-1, 0, 1}, {1, 0, 1}, {0, 0, -1}};
    lsf_scene *flat = build_scene();
    build_material(flat, 1, 1, 1);
    build_triangles(flat, corners, 1);
    build_light(flat, LSF_LIGHT_POINT, lsf_f3(0, 2, 0), lsf_f3(0, -1, 0), 1.0f);
    build_light(flat, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(0, -1, 0), 1.0f);
    build_light(flat, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(1, 0, 0), 1.0f);
    finish_gl_scene(flat);
    image = render_extreme(gl_test_backend(), flat, 1.0f, 32, 32);
    assert_finite_and_lit(image);
    lsf_image_destroy(image);
    destroy_scene(flat);
}

/* Zero-area, sliver and duplicate triangles change nothing. */
static void degenerate_triangles(void **unused)
{
    (void)unused;
    lsf_image *images[2];
    for (int i = 0; i < 2; i++) {
        lsf_scene *scene = extreme_scene(1.0f);
        if (i == 1) {
            const float *floor = scene->vertices.position;
            const lsf_float3 bad[] = {{1, 1, 1},    {1, 1, 1},      {1, 1, 1}, /* a point */
                                      {-1, 1, 0},   {0, 1, 0},      {1, 1, 0}, /* a line */
                                      {0, 0.9f, 0}, {1e-30f, 1, 0}, {0, 1, 1e-30f}};
            const lsf_float3 again[] = {lsf_f3_load(floor), lsf_f3_load(floor + 3),
                                        lsf_f3_load(floor + 6)};
            build_material(scene, 0.8f, 0.6f, 0.4f);
            build_triangles(scene, bad, 3);
            build_triangles(scene, again, 1);
            finish_gl_scene(scene);
        }
        images[i] = render_extreme(gl_test_backend(), scene, 1.0f, 96, 64);
        destroy_scene(scene);
    }
    assert_same_pixels(images[1], images[0]);
    lsf_image_destroy(images[0]);
    lsf_image_destroy(images[1]);
}

/* A near plane 1e-10 of the distance: the nearer of two planes is still seen. */
static void depth_range(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    build_material(scene, 0, 0, 0)->emission[0] = 1.0f;
    build_floor(scene, 0.0f, 1e4f);
    build_material(scene, 0, 0, 0)->emission[1] = 1.0f;
    build_floor(scene, 1.0f, 1e4f);
    scene->cameras[0].near_plane = 1e-6f;
    finish_gl_scene(scene);
    float rgb[3];
    render_gl_point(scene, lsf_f3(0, 1e4f, 10), lsf_f3(0, 0, 0), 4, rgb);
    assert_true(rgb[0] == 0.0f && rgb[1] == 1.0f);
    destroy_scene(scene);
}

static void every_allocation_may_fail(void **unused)
{
    (void)unused;
    lsf_scene *scene = extreme_scene(1.0f);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "direct";
    params.aovs = LSF_AOV_MOTION | LSF_AOV_EMISSION;
    params.rgb8 = true;
    assert_every_allocation_may_fail(scene, params, 20);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_bits_twice_and_on_each_backend),
        cmocka_unit_test(same_bits_for_any_thread_count),
        cmocka_unit_test(same_bits_at_any_scale),
        cmocka_unit_test(nearly_the_same_at_scales_of_ten),
        cmocka_unit_test(light_intensity_scales_exactly),
        cmocka_unit_test(odd_sizes),
        cmocka_unit_test(empty_and_flat_scenes),
        cmocka_unit_test(degenerate_triangles),
        cmocka_unit_test(depth_range),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
