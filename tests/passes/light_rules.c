#include "light_rules.h"

#include <math.h>

#include "base/base.h"
#include "shared/brdf.h"

lsf_scene *furnace_scene(float albedo)
{
    lsf_scene *scene = build_scene();
    lsf_material *material = build_material(scene, albedo, albedo, albedo);
    for (int c = 0; c < 3; c++)
        material->emission[c] = 1.0f;
    build_box(scene, lsf_f3(-1, -1, -1), lsf_f3(1, 1, 1), true);
    scene->diffuse_only = true;
    finish_gl_scene(scene);
    return scene;
}

double furnace_radiance(float albedo, uint32_t bounces)
{
    double radiance = 1.0, power = 1.0;
    for (uint32_t k = 0; k <= bounces; k++)
        radiance += power *= (double)albedo;
    return radiance;
}

lsf_scene *white_sphere_scene(int subdivisions)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 1.0f, 1.0f, 1.0f);
    build_sphere(scene, subdivisions, false);
    scene->diffuse_only = true;
    build_environment(scene, 0.5f);
    finish_gl_scene(scene);
    return scene;
}

lsf_scene *lit_sphere_scene(float albedo)
{
    lsf_scene *scene = build_scene();
    build_material(scene, albedo, albedo, albedo);
    build_sphere(scene, 4, true);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0, 0, 0), lsf_f3(0, -1, 0), 3.0f);
    scene->diffuse_only = true;
    finish_gl_scene(scene);
    return scene;
}

double lit_sphere_radiance(float albedo, uint32_t bounces)
{
    double radiance = 0.0, power = (double)albedo / (double)LSF_PI * 3.0;
    for (uint32_t k = 0; k <= bounces; k++, power *= (double)albedo)
        radiance += power;
    return radiance;
}

lsf_scene *lit_room_scene(float intensity)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.7f, 0.6f, 0.5f);
    build_floor(scene, 0.0f, 2.0f);
    build_quad(scene, lsf_f3(-2, 0, -2), lsf_f3(2, 0, -2), lsf_f3(2, 3, -2), lsf_f3(-2, 3, -2));
    lsf_material *glossy = build_material(scene, 0.8f, 0.5f, 0.2f);
    glossy->roughness = 0.3f;
    glossy->metallic = 0.5f;
    glossy->anisotropy_strength = 0.6f;
    build_box(scene, lsf_f3(0.2f, 0, -1), lsf_f3(1.1f, 0.9f, -0.1f), false);
    lsf_material *lamp = build_material(scene, 0.1f, 0.1f, 0.1f);
    for (int c = 0; c < 3; c++)
        lamp->emission[c] = 4.0f * intensity;
    build_quad(scene, lsf_f3(-2, 0.5f, 1), lsf_f3(-2, 0.5f, -1), lsf_f3(-2, 2, -1),
               lsf_f3(-2, 2, 1));
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0.5f, 2, 0.5f), lsf_f3(0, -1, 0), 8.0f * intensity);
    finish_gl_scene(scene);
    return scene;
}

void assert_mean(const char *what, const lsf_image *image, double expected, double allowed)
{
    double rgb[3];
    mean_rgb(image, 0, rgb);
    print_message("%s: %.5f, expected %.5f\n", what, rgb[1], expected);
    for (int c = 0; c < 3; c++)
        assert_true(fabs(rgb[c] / expected - 1.0) <= allowed);
}

void assert_light_scales(lsf_render_params params)
{
    static const float scales[] = {0x1p-40f, 0x1p40f};
    lsf_scene *scene = lit_room_scene(1.0f);
    lsf_image *expected = render_corner(scene, params, 33);
    for (int i = 0; i < 2; i++) {
        lsf_scene *scaled = lit_room_scene(scales[i]);
        lsf_image *image = render_corner(scaled, params, 33);
        assert_scaled_pixels(image, expected, scales[i]);
        lsf_image_destroy(image);
        lsf_scene_destroy(scaled);
    }
    lsf_image_destroy(expected);
    lsf_scene_destroy(scene);
}

void assert_every_allocation_may_fail(const lsf_scene *scene, lsf_render_params params,
                                      uint32_t least)
{
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    params.width = params.height = 16;
    uint32_t failures = 0;
    for (bool created = false; !created; failures++) {
        lsf_error error = {0};
        lsf_context_fail_allocation(context, failures + 1);
        lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
        created = renderer != NULL;
        if (created) {
            assert_int_equal(lsf_context_get_info(context).gl_bytes,
                             lsf_plan_bytes(lsf_renderer_plan(renderer)));
        } else {
            assert_int_equal(error.code, LSF_ERROR_RENDER);
            assert_true(error.message[0] != '\0');
        }
        lsf_renderer_destroy(renderer);
        assert_int_equal(lsf_context_get_info(context).gl_bytes, 0);
    }
    print_message("%u allocations failed in turn\n", failures - 1);
    assert_true(failures > least);
    gl_test_check(context);
    lsf_context_destroy(context);
}
