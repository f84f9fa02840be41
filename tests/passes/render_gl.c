#include "render_gl.h"

#include <math.h>

lsf_image *render_gl(lsf_backend backend, const lsf_scene *scene, const lsf_render_params *params)
{
    lsf_error error = {0};
    lsf_context *context = gl_test_context(backend, NULL);
    lsf_renderer *renderer = lsf_renderer_create(context, scene, params, &error);
    if (!renderer || !lsf_renderer_run(renderer, &error))
        fail_msg("%s", error.message);
    /* Rendering asked GL for what the plan lists, byte for byte. */
    assert_int_equal(lsf_context_get_info(context).gl_bytes,
                     lsf_plan_bytes(lsf_renderer_plan(renderer)));
    lsf_image *image = lsf_renderer_read(renderer, &error);
    if (!image)
        fail_msg("%s", error.message);
    lsf_renderer_destroy(renderer);
    assert_int_equal(lsf_context_get_info(context).gl_bytes, 0);
    gl_test_check(context);
    lsf_context_destroy(context);
    return image;
}

lsf_image *render_gl_in(lsf_context *context, const lsf_scene *scene,
                        const lsf_render_params *params)
{
    lsf_error error = {0};
    lsf_renderer *renderer = lsf_renderer_create(context, scene, params, &error);
    bool good = renderer && lsf_renderer_run(renderer, &error);
    lsf_image *image = good ? lsf_renderer_read(renderer, &error) : NULL;
    if (!image)
        fail_msg("%s", error.message);
    lsf_renderer_destroy(renderer);
    return image;
}

lsf_image *render_gl_from(const lsf_scene *scene, lsf_render_params params, uint32_t size,
                          lsf_float3 eye, lsf_float3 target)
{
    const float position[3] = {eye.x, eye.y, eye.z}, at[3] = {target.x, target.y, target.z};
    params.width = params.height = size;
    params.camera_position = position;
    params.camera_target = at;
    return render_gl(gl_test_backend(), scene, &params);
}

lsf_render_params corner_params(lsf_render_params params, uint32_t size)
{
    static const float eye[3] = {2.5f, 2, 3.5f}, target[3] = {-0.5f, 0.8f, -0.5f};
    params.width = params.height = size;
    params.camera_position = eye;
    params.camera_target = target;
    return params;
}

lsf_image *render_corner(const lsf_scene *scene, lsf_render_params params, uint32_t size)
{
    params = corner_params(params, size);
    return render_gl(gl_test_backend(), scene, &params);
}

void render_gl_point(const lsf_scene *scene, lsf_float3 eye, lsf_float3 target, uint32_t samples,
                     float rgb[3])
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true, .bounces = 1};
    params.technique = "direct";
    params.samples = samples;
    params.fov_y = 1e-3f;
    lsf_image *image = render_gl_from(scene, params, 1, eye, target);
    memcpy(rgb, image->pixels, 3 * sizeof *rgb);
    lsf_image_destroy(image);
}

void mean_rgb(const lsf_image *image, uint32_t first, double rgb[3])
{
    uint64_t pixels = (uint64_t)image->width * image->height;
    rgb[0] = rgb[1] = rgb[2] = 0.0;
    for (uint64_t i = 0; i < pixels; i++)
        for (uint32_t c = 0; c < 3; c++) {
            float value = image->pixels[i * image->channel_count + first + c];
            assert_true(isfinite(value) && value >= 0.0f);
            rgb[c] += (double)value / (double)pixels;
        }
}

static uint64_t value_count(const lsf_image *image)
{
    return (uint64_t)image->width * image->height * image->channel_count;
}

void assert_same_pixels(const lsf_image *image, const lsf_image *expected)
{
    assert_int_equal(value_count(image), value_count(expected));
    assert_memory_equal(image->pixels, expected->pixels, value_count(image) * sizeof(float));
}

void assert_scaled_pixels(const lsf_image *image, const lsf_image *expected, float scale)
{
    assert_int_equal(value_count(image), value_count(expected));
    for (uint64_t i = 0; i < value_count(image); i++)
        assert_true(image->pixels[i] == expected->pixels[i] * scale);
}

void assert_same_for_any_threads(const lsf_scene *scene, const lsf_render_params *params)
{
    static const char *const threads[] = {"0", "1", "8"};
    lsf_image *expected = render_gl(gl_test_backend(), scene, params);
    for (int i = 0; i < 3; i++) {
        setenv("LP_NUM_THREADS", threads[i], 1);
        lsf_image *image = render_gl(gl_test_backend(), scene, params);
        assert_same_pixels(image, expected);
        lsf_image_destroy(image);
    }
    unsetenv("LP_NUM_THREADS");
    lsf_image_destroy(expected);
}

void assert_finite_extremes(lsf_render_params params, float environment)
{
    for (int kind = 0; kind < 4; kind++) {
        lsf_scene *scene = build_scene();
        if (kind > 0) {
            build_material(scene, 0.8f, 0.8f, 0.8f)->roughness = kind == 2 ? 0.0f : 1.0f;
            const lsf_float3 corners[3] = {lsf_f3(-1, 0, 1), lsf_f3(1, 0, 1), lsf_f3(0, 0, -1)};
            build_triangles(scene, corners, 1);
        }
        build_light(scene, LSF_LIGHT_POINT, lsf_f3(0, kind == 3 ? 0.0f : 1.0f, 0), lsf_f3(0, -1, 0),
                    3.0f);
        if (environment > 0.0f)
            build_environment(scene, environment);
        finish_gl_scene(scene);
        params.width = kind == 0 ? 1 : 7;
        params.height = kind == 0 ? 1 : 13;
        const float eye[3] = {0, kind == 2 ? 0.0f : 0.8f, 0.9f}, target[3] = {0, 0, 0};
        params.camera_position = eye;
        params.camera_target = target;
        lsf_image *image = render_gl(gl_test_backend(), scene, &params);
        double rgb[3];
        mean_rgb(image, 0, rgb);
        lsf_image_destroy(image);
        lsf_scene_destroy(scene);
    }
}

void finish_gl_scene(lsf_scene *scene)
{
    finish_scene(scene);
    lsf_scene_compute_requirements(scene);
}

void assert_seen(const char *what, const double found[3], const double expected[3],
                 double tolerance)
{
    bool bad = false;
    for (int c = 0; c < 3; c++) {
        print_message("%s, channel %d: %.5f, expected %.5f\n", what, c, found[c], expected[c]);
        bad |= !(fabs(found[c] - expected[c]) <= tolerance * fabs(expected[c]) + 1e-6);
    }
    assert_false(bad);
}
