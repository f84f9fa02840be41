/* The path tracer against closed forms. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "render_scene.h"

static void assert_near(const char *what, double found, double expected, double tolerance)
{
    double error = fabs(found - expected) / fmax(fabs(expected), 1e-30);
    print_message("%s: %.7g, expected %.7g (off by %.1e)\n", what, found, expected, error);
    if (!(error <= tolerance))
        fail_msg("%s is %.9g, not %.9g within %g", what, found, expected, tolerance);
}

/* L = rho / pi * I h / (h^2 + x^2)^(3/2) */
static void plane_under_point_light(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.8f, 0.8f, 0.8f);
    build_floor(scene, 0.0f, 10.0f);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
    finish_scene(scene);
    static const float offsets[] = {0.0f, 1.0f, 3.0f};
    for (int i = 0; i < 3; i++) {
        float rgb[3], x = offsets[i];
        render_point(scene, lsf_f3(0, 6, 5), lsf_f3(1 + x, 0, 1), 64, 0, rgb);
        double d2 = 4.0 + (double)x * (double)x;
        assert_near("point light", (double)rgb[0], 0.8 / M_PI * 5.0 * 2.0 / (d2 * sqrt(d2)), 1e-5);
    }
    destroy_scene(scene);
}

static void light_range(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 1.0f, 1.0f, 1.0f);
    build_floor(scene, 0.0f, 10.0f);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0, 2, 0), lsf_f3(0, -1, 0), 5.0f)->range = 4.0f;
    finish_scene(scene);
    float rgb[3];
    render_point(scene, lsf_f3(0, 6, 5), lsf_f3(0, 0, 0), 16, 0, rgb);
    assert_near("light with a range", (double)rgb[0], 5.0 / M_PI / 4.0 * (1.0 - 1.0 / 16.0), 1e-5);
    render_point(scene, lsf_f3(0, 6, 5), lsf_f3(4, 0, 0), 16, 0, rgb);
    assert_true(rgb[0] == 0.0f);
    destroy_scene(scene);
}

static void plane_under_directional_light(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.5f, 0.25f, 1.0f);
    build_floor(scene, 0.0f, 10.0f);
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(3, 3, 3), lsf_f3(1, -2, 0.5f), 7.0f);
    finish_scene(scene);
    float rgb[3];
    render_point(scene, lsf_f3(0, 6, 5), lsf_f3(1, 0, 1), 64, 0, rgb);
    double cosine = 2.0 / sqrt(5.25);
    assert_near("directional, R", (double)rgb[0], 0.5 / M_PI * 7.0 * cosine, 1e-5);
    assert_near("directional, G", (double)rgb[1], 0.25 / M_PI * 7.0 * cosine, 1e-5);
    /* Seen from below, in its shadow. */
    render_point(scene, lsf_f3(0, -6, 5), lsf_f3(1, 0, 1), 64, 0, rgb);
    assert_true(rgb[0] == 0.0f);
    destroy_scene(scene);
}

static void spot_penumbra(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 1.0f, 1.0f, 1.0f);
    build_floor(scene, 0.0f, 10.0f);
    lsf_light *light = build_light(scene, LSF_LIGHT_SPOT, lsf_f3(0, 2, 0), lsf_f3(0, -1, 0), 3.0f);
    light->inner_cone = 0.3f;
    light->outer_cone = 0.6f;
    finish_scene(scene);
    static const double angles[] = {0.0, 0.25, 0.4, 0.5, 0.57};
    for (int i = 0; i < 5; i++) {
        float rgb[3];
        double x = 2.0 * tan(angles[i]);
        render_point(scene, lsf_f3(0, 6, 5), lsf_f3((float)x, 0, 0), 64, 0, rgb);
        double a = (cos(angles[i]) - cos(0.6)) / (cos(0.3) - cos(0.6));
        a = fmin(fmax(a, 0.0), 1.0);
        double c = cos(angles[i]);
        assert_near("spot", (double)rgb[0], a * a * 3.0 / M_PI * c * c * c / 4.0, 1e-4);
    }
    float rgb[3];
    render_point(scene, lsf_f3(0, 6, 5), lsf_f3(1.5f, 0, 0), 64, 0, rgb);
    assert_true(rgb[0] == 0.0f);
    destroy_scene(scene);
}

/* Irradiance of a convex polygon on a plane: E = L / 2 sum of angle_i (n . edge normal_i)
 * (J. H. Lambert, 1760). */
static double polygon_irradiance(const lsf_float3 *corners, int count, lsf_float3 at, lsf_float3 n)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        lsf_float3 a = lsf_f3_normalize(lsf_f3_sub(corners[i], at));
        lsf_float3 b = lsf_f3_normalize(lsf_f3_sub(corners[(i + 1) % count], at));
        double angle = acos((double)lsf_f3_dot(a, b));
        sum += angle * (double)lsf_f3_dot(n, lsf_f3_normalize(lsf_f3_cross(a, b)));
    }
    return 0.5 * fabs(sum);
}

static void emissive_quad(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.6f, 0.6f, 0.6f);
    build_floor(scene, 0.0f, 10.0f);
    scene->show_back_faces = true;
    lsf_material *light = build_material(scene, 0.0f, 0.0f, 0.0f);
    light->emission[0] = 3.0f;
    light->emission[1] = 2.0f;
    light->emission[2] = 0.5f;
    const lsf_float3 corners[4] = {
        {-1, 2, -0.5f}, {1, 2, -0.5f}, {1, 2.5f, 0.5f}, {-1, 2.5f, 0.5f}};
    build_quad(scene, corners[0], corners[1], corners[2], corners[3]);
    finish_scene(scene);
    float rgb[3];
    render_point(scene, lsf_f3(0, 0.5f, 0.2f), lsf_f3(0.1f, 2.25f, 0), 16, 0, rgb);
    assert_true(rgb[0] == 3.0f && rgb[1] == 2.0f && rgb[2] == 0.5f);
    render_point(scene, lsf_f3(0, 5, 0.2f), lsf_f3(0.1f, 2.25f, 0), 16, 0, rgb);
    assert_true(rgb[0] == 0.0f); /* its back is dark */
    static const float places[][2] = {{0, 0}, {1.5f, 0.5f}, {-0.3f, 3}};
    for (int i = 0; i < 3; i++) {
        lsf_float3 at = lsf_f3(places[i][0], 0, places[i][1]);
        double e = polygon_irradiance(corners, 4, at, lsf_f3(0, 1, 0));
        render_point(scene, lsf_f3(4, 1, 4), at, 65536, 0, rgb);
        assert_near("form factor", (double)rgb[0], 0.6 / M_PI * 3.0 * e, 5e-4);
    }
    /* Light from both sides. */
    scene->materials[1].double_sided = true;
    render_point(scene, lsf_f3(0, 5, 0.2f), lsf_f3(0.1f, 2.25f, 0), 16, 0, rgb);
    assert_true(rgb[0] == 3.0f);
    destroy_scene(scene);
}

/* A Lambertian body in uniform light: rho seen directly; convex, so that nothing else comes. */
static void furnace(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    scene->environment = (lsf_environment){.present = true, .radiance = {1.0f, 0.5f, 2.0f}};
    build_material(scene, 0.7f, 0.7f, 0.7f);
    build_sphere(scene, 2, false);
    finish_scene(scene);
    float rgb[3];
    for (uint32_t bounces = 0; bounces <= 2; bounces += 2) {
        render_point(scene, lsf_f3(1, 2, 5), lsf_f3(0.1f, 0.2f, 0.7f), 64, bounces, rgb);
        assert_near("furnace, R", (double)rgb[0], 0.7, 1e-5);
        assert_near("furnace, G", (double)rgb[1], 0.35, 1e-5);
        assert_near("furnace, B", (double)rgb[2], 1.4, 1e-5);
    }
    destroy_scene(scene);
}

/* L = Le sum of rho^k, k = 0 .. bounces + 1, wherever one looks in a closed emissive body. */
static void closed_emissive_body(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    lsf_material *material = build_material(scene, 0.8f, 0.5f, 1.0f);
    material->double_sided = true;
    for (int c = 0; c < 3; c++)
        material->emission[c] = 1.5f;
    build_sphere(scene, 2, true);
    finish_scene(scene);
    const double albedo[3] = {(double)0.8f, 0.5, 1.0};
    static const uint32_t all_bounces[] = {0, 1, 2, 3, 8};
    static const float eye[3] = {0.2f, -0.1f, 0.3f}, target[3] = {1, 0.5f, -0.2f};
    for (int i = 0; i < 5; i++) {
        lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
        params.width = params.height = 16;
        params.samples = 256;
        params.bounces = all_bounces[i];
        params.camera_position = eye;
        params.camera_target = target;
        params.fov_y = 90.0f;
        lsf_image *image = render_scene(scene, &params, 0, 0);
        double mean[3];
        image_mean(image, 0, mean);
        lsf_image_destroy(image);
        for (int c = 0; c < 3; c++) {
            double expected = 0.0;
            for (uint32_t k = 0; k <= all_bounces[i] + 1; k++)
                expected += 1.5 * pow(albedo[c], k);
            assert_near("closed body", mean[c], expected, 1e-3);
        }
    }
    destroy_scene(scene);
}

/* The same without NEE's help: emission leaves the front only and the front is outside, so that
 * the inside of a body of unlit walls is what every ray finds. */
static void unlit_shines_both_ways(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_floor(scene, -0.5f, 0.2f);
    scene->show_back_faces = true;
    lsf_material *wall = build_material(scene, 0.25f, 0.5f, 0.75f);
    wall->unlit = true;
    build_box(scene, lsf_f3(-1, -1, -1), lsf_f3(1, 1, 1), false);
    finish_scene(scene);
    float rgb[3];
    render_point(scene, lsf_f3(0, 0.5f, 0.1f), lsf_f3(0.05f, -0.5f, 0), 65536, 2, rgb);
    assert_near("lit by unlit walls, R", (double)rgb[0], 0.125, 2e-3);
    assert_near("lit by unlit walls, B", (double)rgb[2], 0.375, 2e-3);
    render_point(scene, lsf_f3(0, 0.5f, 0.1f), lsf_f3(1, 0.4f, 0), 16, 2, rgb);
    assert_true(rgb[0] == 0.25f && rgb[1] == 0.5f && rgb[2] == 0.75f);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plane_under_point_light),
        cmocka_unit_test(light_range),
        cmocka_unit_test(plane_under_directional_light),
        cmocka_unit_test(spot_penumbra),
        cmocka_unit_test(emissive_quad),
        cmocka_unit_test(furnace),
        cmocka_unit_test(closed_emissive_body),
        cmocka_unit_test(unlit_shines_both_ways),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
