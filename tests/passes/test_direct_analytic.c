/* Direct light by GL against closed forms. */
#include <math.h>

#include "render_gl.h"

static void assert_near(const char *what, double found, double expected, double tolerance)
{
    double error = fabs(found - expected) / fmax(fabs(expected), 1e-30);
    print_message("%s: %.7g, expected %.7g (off by %.1e)\n", what, found, expected, error);
    if (!(error <= tolerance))
        fail_msg("%s is %.9g, not %.9g within %g", what, found, expected, tolerance);
}

static lsf_scene *floor_scene(float albedo)
{
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, albedo, albedo, albedo);
    build_floor(scene, 0.0f, 10.0f);
    return scene;
}

/* L = rho / pi * I h / (h^2 + x^2)^(3/2) */
static void plane_under_point_light(void **unused)
{
    (void)unused;
    lsf_scene *scene = floor_scene(0.8f);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
    finish_gl_scene(scene);
    static const float offsets[] = {0.0f, 1.0f, 3.0f};
    for (int i = 0; i < 3; i++) {
        float rgb[3], x = offsets[i];
        render_gl_point(scene, lsf_f3(0, 6, 5), lsf_f3(1 + x, 0, 1), 8, rgb);
        double d2 = 4.0 + (double)x * (double)x;
        assert_near("point light", (double)rgb[0], 0.8 / M_PI * 5.0 * 2.0 / (d2 * sqrt(d2)), 1e-3);
    }
    destroy_scene(scene);
}

/* L = rho / pi E cos */
static void plane_under_directional_light(void **unused)
{
    (void)unused;
    lsf_scene *scene = floor_scene(0.5f);
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(0.6f, -0.8f, 0), 3.0f);
    finish_gl_scene(scene);
    float rgb[3];
    render_gl_point(scene, lsf_f3(0, 6, 5), lsf_f3(1, 0, 1), 8, rgb);
    assert_near("directional light", (double)rgb[0], 0.5 / M_PI * 3.0 * 0.8, 1e-3);
    destroy_scene(scene);
}

/* glTF: ((cos theta - cos outer) / (cos inner - cos outer))^2 between the cones. */
static void spot_penumbra(void **unused)
{
    (void)unused;
    static const float outers[] = {0.6f, 1.4f}; /* one face; wide enough for a cube */
    for (int wide = 0; wide < 2; wide++) {
        lsf_scene *scene = floor_scene(1.0f);
        lsf_light *light =
            build_light(scene, LSF_LIGHT_SPOT, lsf_f3(0, 2, 0), lsf_f3(0, -1, 0), 4.0f);
        light->inner_cone = 0.2f;
        light->outer_cone = outers[wide];
        finish_gl_scene(scene);
        static const double angles[] = {0.0, 0.1, 0.3, 0.5};
        for (int i = 0; i < 4; i++) {
            float rgb[3];
            double x = 2.0 * tan(angles[i]), cosine = cos(angles[i]);
            render_gl_point(scene, lsf_f3(0, 6, 5), lsf_f3((float)x, 0, 0), 8, rgb);
            double ramp = (cosine - cos((double)outers[wide])) /
                          (cos((double)0.2f) - cos((double)outers[wide]));
            ramp = fmin(fmax(ramp, 0.0), 1.0);
            assert_near("spot", (double)rgb[0], 4.0 / M_PI * pow(cosine, 3.0) / 4.0 * ramp * ramp,
                        1e-3);
        }
        float rgb[3];
        render_gl_point(scene, lsf_f3(0, 6, 5), lsf_f3(2.0f * tanf(outers[wide] + 0.05f), 0, 0), 8,
                        rgb);
        assert_true(rgb[0] == 0.0f);
        destroy_scene(scene);
    }
}

static void light_range(void **unused)
{
    (void)unused;
    lsf_scene *scene = floor_scene(1.0f);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0, 2, 0), lsf_f3(0, -1, 0), 5.0f)->range = 4.0f;
    finish_gl_scene(scene);
    float rgb[3];
    render_gl_point(scene, lsf_f3(0, 6, 5), lsf_f3(0, 0, 0), 8, rgb);
    assert_near("light with a range", (double)rgb[0], 5.0 / M_PI / 4.0 * (1.0 - 1.0 / 16.0), 1e-3);
    render_gl_point(scene, lsf_f3(0, 6, 5), lsf_f3(4, 0, 0), 8, rgb);
    assert_true(rgb[0] == 0.0f);
    destroy_scene(scene);
}

/* Emission is seen exactly, from the front; from behind only when double-sided. */
static void emissive_quad(void **unused)
{
    (void)unused;
    for (int double_sided = 0; double_sided < 2; double_sided++) {
        lsf_scene *scene = build_scene();
        lsf_material *material = build_material(scene, 0, 0, 0);
        material->emission[0] = 17.0f;
        material->emission[1] = 0.1f;
        material->emission[2] = 1e-4f;
        material->double_sided = double_sided != 0;
        build_floor(scene, 0.0f, 1.0f);
        finish_gl_scene(scene);
        float rgb[3];
        render_gl_point(scene, lsf_f3(0.3f, 2, 0), lsf_f3(0, 0, 0.2f), 4, rgb);
        assert_true(rgb[0] == 17.0f && rgb[1] == 0.1f && rgb[2] == 1e-4f);
        render_gl_point(scene, lsf_f3(0.3f, -2, 0), lsf_f3(0, 0, 0.2f), 4, rgb);
        assert_true(rgb[0] == (double_sided ? 17.0f : 0.0f));
        destroy_scene(scene);
    }
}

/* The background of a uniform environment; an unlit surface shows its colour. */
static void environment_and_unlit(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    build_material(scene, 0.25f, 0.5f, 0.75f)->unlit = true;
    build_floor(scene, 0.0f, 1.0f);
    scene->environment = (lsf_environment){.present = true, .radiance = {0.5f, 1.0f, 2.0f}};
    finish_gl_scene(scene);
    float rgb[3];
    render_gl_point(scene, lsf_f3(0, 2, 0), lsf_f3(0, 5, 1), 4, rgb);
    assert_true(rgb[0] == 0.5f && rgb[1] == 1.0f && rgb[2] == 2.0f);
    render_gl_point(scene, lsf_f3(0.1f, 2, 0), lsf_f3(0, 0, 0), 4, rgb);
    assert_true(rgb[0] == 0.25f && rgb[1] == 0.5f && rgb[2] == 0.75f);
    destroy_scene(scene);
}

/* A box casts a shadow whose border is where geometry puts it; inside it is black. */
static void shadow_of_a_box(void **unused)
{
    (void)unused;
    static const lsf_light_type types[] = {LSF_LIGHT_POINT, LSF_LIGHT_SPOT, LSF_LIGHT_DIRECTIONAL};
    for (int i = 0; i < 3; i++) {
        lsf_scene *scene = floor_scene(1.0f);
        build_box(scene, lsf_f3(-1, 1, -1), lsf_f3(1, 1.5f, 1), false);
        lsf_light *light = build_light(scene, types[i], lsf_f3(0, 3, 0), lsf_f3(0, -1, 0), 9.0f);
        light->outer_cone = light->inner_cone = 0.9f;
        finish_gl_scene(scene);
        float rgb[3];
        /* The upper edge, 1.5 above the floor and below the light, shades to x = 2; parallel light
         * only to x = 1. */
        float border = types[i] == LSF_LIGHT_DIRECTIONAL ? 1.0f : 2.0f;
        render_gl_point(scene, lsf_f3(0, 0.5f, 8), lsf_f3(border - 0.1f, 0, 0), 32, rgb);
        assert_true(rgb[0] == 0.0f);
        render_gl_point(scene, lsf_f3(0, 0.5f, 8), lsf_f3(border + 0.1f, 0, 0), 32, rgb);
        assert_true(rgb[0] > 0.1f);
        destroy_scene(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plane_under_point_light), cmocka_unit_test(plane_under_directional_light),
        cmocka_unit_test(spot_penumbra),           cmocka_unit_test(light_range),
        cmocka_unit_test(emissive_quad),           cmocka_unit_test(environment_and_unlit),
        cmocka_unit_test(shadow_of_a_box),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
