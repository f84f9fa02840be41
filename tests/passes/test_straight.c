/* Light straight through surfaces that transmit, against closed forms: to the eye, and from lamps.
 */
#include <math.h>

#include "base/base.h"
#include "render_gl.h"

static double schlick(double f0, double cosine)
{
    return f0 + (1.0 - f0) * pow(1.0 - cosine, 5.0);
}

/* Whether a surface is there is chance in each texel and iteration: with a probability of 0.04, the
 * share of 1024 of them is off by 0.6 %. */
static void look(const lsf_scene *scene, const char *technique, uint32_t samples, lsf_float3 eye,
                 lsf_float3 target, double rgb[3])
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = technique;
    params.bounces = 0;
    params.samples = samples;
    params.fov_y = 2.0f;
    lsf_image *image = render_gl_from(scene, params, 16, eye, target);
    mean_rgb(image, 0, rgb);
    lsf_image_destroy(image);
}

static void build_dull_floor(lsf_scene *scene, float albedo, float height)
{
    build_material(scene, albedo, albedo, albedo)->ior = 1.0f;
    build_floor(scene, height, 4.0f);
}

/* A floor under two panes, lit through both by a lamp of each kind and seen through one. */
static void lamps_shine_through_panes(void **unused)
{
    (void)unused;
    static const char *const techniques[] = {"direct", "bidirectional", "cone"};
    static const lsf_light_type types[] = {LSF_LIGHT_DIRECTIONAL, LSF_LIGHT_POINT, LSF_LIGHT_SPOT};
    const double tints[2][3] = {{0.9, 0.5, 0.2}, {0.3, 0.8, 1.0}};
    const lsf_float3 target = {0.4f, 0, 0}, eye = {-0.4f, 1.7f, 0.0f}, lamp = {0, 3, 0};
    for (int k = 0; k < 3; k++) {
        lsf_scene *scene = build_scene();
        build_dull_floor(scene, 0.5f, 0.0f);
        for (int pane = 0; pane < 2; pane++) {
            lsf_material *glass = build_glass(scene, 1.0f, 0.0f, 0.0f);
            for (int c = 0; c < 3; c++)
                glass->base_color[c] = (float)tints[pane][c];
            build_floor(scene, 1.0f + (float)pane, 4.0f);
        }
        lsf_light *light = build_light(scene, types[k], lamp, lsf_f3_sub(target, lamp), 10.0f);
        light->outer_cone = 0.5f;
        light->inner_cone = 0.4f;
        finish_gl_scene(scene);
        double rgb[3], expected[3];
        look(scene, techniques[k], 64, eye, target, rgb);
        lsf_float3 view = lsf_f3_normalize(lsf_f3_sub(eye, target));
        double d2 = 0.4 * 0.4 + 9.0, cosine = 3.0 / sqrt(d2), pass = 1.0 - schlick(0.04, cosine);
        double lit = types[k] == LSF_LIGHT_DIRECTIONAL ? 10.0 : 10.0 / d2;
        for (int c = 0; c < 3; c++)
            expected[c] = 0.5 / M_PI * lit * cosine * tints[0][c] * tints[1][c] * pass * pass *
                          tints[0][c] * (1.0 - schlick(0.04, (double)view.y));
        assert_seen(techniques[k], rgb, expected, 0.03);
        destroy_scene(scene);
    }
}

/* A glowing floor under two panes that are closer than a voxel and reflect nothing. */
static void floors_glow_through_panes(void **unused)
{
    (void)unused;
    static const char *const techniques[] = {"direct", "bidirectional", "cone", "voxel_path",
                                             "substitute_tree"};
    static const double tint[3] = {0.9, 0.5, 0.2};
    for (size_t k = 0; k < LSF_COUNT(techniques); k++) {
        lsf_scene *scene = build_scene();
        lsf_material *glowing = build_material(scene, 0, 0, 0);
        glowing->emission[0] = glowing->emission[1] = glowing->emission[2] = 1.0f;
        glowing->ior = 1.0f;
        build_floor(scene, 0.0f, 4.0f);
        lsf_material *glass = build_glass(scene, 1.0f, 0.0f, 0.0f);
        glass->ior = 1.0f;
        for (int c = 0; c < 3; c++)
            glass->base_color[c] = (float)tint[c];
        for (int pane = 0; pane < 2; pane++)
            build_floor(scene, 1.0f + 0.01f * (float)pane, 4.0f);
        finish_gl_scene(scene);
        double rgb[3], expected[3];
        look(scene, techniques[k], 32, lsf_f3(0, 3, 0.1f), lsf_f3(0, 0, 0), rgb);
        for (int c = 0; c < 3; c++)
            expected[c] = tint[c] * tint[c];
        assert_seen(techniques[k], rgb, expected, 0.02);
        destroy_scene(scene);
    }
}

/* The diffuse part of a pane that transmits half, before a black floor. */
static void panes_reflect(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    build_dull_floor(scene, 0.0f, -1.0f);
    lsf_material *glass = build_glass(scene, 0.8f, 1.0f, 0.0f);
    glass->transmission = 0.5f;
    glass->ior = 1.0f;
    glass->base_color[1] = 0.2f;
    build_floor(scene, 0.0f, 4.0f);
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(0, -1, 0), 3.0f);
    finish_gl_scene(scene);
    double rgb[3];
    look(scene, "direct", 32, lsf_f3(0, 3, 0.1f), lsf_f3(0, 0, 0), rgb);
    const double lit = 3.0 / M_PI * 0.5, expected[3] = {lit * 0.8, lit * 0.2, lit * 0.8};
    assert_seen("half a pane", rgb, expected, 0.02);
    destroy_scene(scene);
}

/* A lamp of radiance 1 behind a slab of tinted glass, and within it. */
static void slabs_absorb(void **unused)
{
    (void)unused;
    for (int within = 0; within < 2; within++) {
        lsf_scene *scene = build_scene();
        lsf_material *shining = build_material(scene, 0, 0, 0);
        shining->emission[0] = shining->emission[1] = shining->emission[2] = 1.0f;
        build_floor(scene, within ? -1.0f : -3.0f, 8.0f);
        lsf_material *glass = build_glass(scene, 0.9f, 0.0f, 1.5f);
        glass->attenuation_distance = 2.5f;
        glass->attenuation_color[0] = 0.1f;
        glass->attenuation_color[1] = 0.5f;
        build_box(scene, lsf_f3(-8, -2, -8), lsf_f3(8, 0, 8), false);
        finish_gl_scene(scene);
        double rgb[3], expected[3];
        look(scene, "direct", 32, lsf_f3(0, 3, 4), lsf_f3(0, 0, 0), rgb);
        double cosine = 0.6, pass = 0.9 * (1.0 - schlick(0.04, cosine));
        double length = (within ? 1.0 : 2.0) / cosine;
        const double left[3] = {0.1, 0.5, 1.0};
        for (int c = 0; c < 3; c++)
            expected[c] = (within ? pass : pass * pass) * pow(left[c], length / 2.5);
        assert_seen(within ? "within a slab" : "behind a slab", rgb, expected, 0.015);
        destroy_scene(scene);
    }
}

/* A floor close under a wide tinted pane, seen from between: by the sky, which ray-bundles find,
 * and by a small lamp straight above, which they share with VPLs. */
static void bundles_and_vpls_pass(void **unused)
{
    (void)unused;
    static const double tint[3] = {0.9, 0.5, 0.2};
    static const char *const strategies[] = {"bidirectional.strategy=both",
                                             "bidirectional.strategy=vpl"};
    for (int k = 0; k < 3; k++) {
        double rgb[2][3];
        bool sky = k == 0;
        for (int pane = 0; pane < 2; pane++) {
            lsf_scene *scene = build_scene();
            build_dull_floor(scene, 0.5f, 0.0f);
            if (sky) {
                build_environment(scene, 1.0f);
            } else {
                lsf_material *lamp = build_material(scene, 0, 0, 0);
                lamp->emission[0] = lamp->emission[1] = lamp->emission[2] = 50.0f;
                build_quad(scene, lsf_f3(-0.1f, 2, -0.1f), lsf_f3(0.1f, 2, -0.1f),
                           lsf_f3(0.1f, 2, 0.1f), lsf_f3(-0.1f, 2, 0.1f));
            }
            lsf_material *glass = build_glass(scene, 1.0f, 0.0f, 0.0f);
            for (int c = 0; c < 3; c++)
                glass->base_color[c] = (float)tint[c];
            if (pane)
                build_floor(scene, 0.15f, 4.0f);
            finish_gl_scene(scene);
            lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
            params.bounces = 0;
            params.samples = 32;
            params.fov_y = 2.0f;
            params.options = &strategies[k == 2];
            params.option_count = 1;
            lsf_image *image =
                render_gl_from(scene, params, 16, lsf_f3(0, 0.1f, 0), lsf_f3(0.1f, 0, 0));
            mean_rgb(image, 0, rgb[pane]);
            lsf_image_destroy(image);
            destroy_scene(scene);
        }
        double expected[3], share = 1.0 - (sky ? 0.04 + 0.96 / 21.0 : 0.04);
        for (int c = 0; c < 3; c++)
            expected[c] = rgb[0][c] * tint[c] * share;
        assert_seen(sky ? "sky" : strategies[k == 2], rgb[1], expected, 0.03);
    }
}

/* A rough pane before a clear tinted one in a white world: rays of cones, and what they meet, see
 * the sky in that tint. The rough pane scatters light of all directions, of which the other lets
 * the same share through but for Fresnel's term. */
static void cones_are_tinted(void **unused)
{
    (void)unused;
    static const double tint[3] = {1.0, 0.5, 0.2};
    double rgb[2][3], expected[3];
    for (int pane = 0; pane < 2; pane++) {
        lsf_scene *scene = build_scene();
        build_glass(scene, 1.0f, 0.3f, 0.0f)->ior = 1.0f;
        build_floor(scene, 0.0f, 4.0f);
        lsf_material *glass = build_glass(scene, 1.0f, 0.0f, 0.0f);
        glass->ior = 1.0f;
        for (int c = 0; c < 3; c++)
            glass->base_color[c] = (float)tint[c];
        build_floor(scene, pane ? -1.0f : 0.5f, 4.0f);
        build_environment(scene, 1.0f);
        finish_gl_scene(scene);
        lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
        params.technique = "cone";
        params.bounces = 0;
        params.samples = 32;
        params.fov_y = 2.0f;
        lsf_image *image =
            render_gl_from(scene, params, 16, lsf_f3(0, 0.3f, 0.05f), lsf_f3(0, 0, 0));
        mean_rgb(image, 0, rgb[pane]);
        lsf_image_destroy(image);
        destroy_scene(scene);
    }
    for (int c = 0; c < 3; c++)
        expected[c] = rgb[0][c] * tint[c];
    assert_seen("cones through a pane", rgb[1], expected, 0.03);
}

static const double cover_tint[3] = {0.9, 0.5, 0.2};

/* What is seen of a floor in a white room, or under a white sky: with `covered` under a pane, or
 * under a slab, 0.5 thick, of a medium that absorbs. */
static void look_below(const char *technique, uint32_t samples, bool sky, bool slab, bool covered,
                       double rgb[3])
{
    lsf_scene *scene = build_scene();
    build_dull_floor(scene, 0.5f, 0.0f);
    if (sky) {
        build_environment(scene, 1.0f);
    } else {
        lsf_material *lamp = build_material(scene, 0, 0, 0);
        lamp->emission[0] = lamp->emission[1] = lamp->emission[2] = 1.0f;
        build_box(scene, lsf_f3(-4, -1, -4), lsf_f3(4, 3, 4), true);
    }
    lsf_material *pane = build_glass(scene, 1.0f, 0.0f, slab ? 1.0f : 0.0f);
    pane->ior = 1.0f;
    if (slab)
        pane->attenuation_distance = 1.0f;
    for (int c = 0; c < 3; c++)
        *(slab ? &pane->attenuation_color[c] : &pane->base_color[c]) = (float)cover_tint[c];
    if (covered && slab)
        build_box(scene, lsf_f3(-4, 0.25f, -4), lsf_f3(4, 0.75f, 4), false);
    else if (covered)
        build_floor(scene, 0.25f, 4.0f);
    finish_gl_scene(scene);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    static const char *const options[] = {"voxel.resolution=64", "cloud.count=8192"};
    params.technique = technique;
    params.bounces = 0;
    params.samples = samples;
    params.options = options;
    params.option_count = LSF_COUNT(options);
    params.fov_y = 2.0f;
    lsf_image *image = render_gl_from(scene, params, 16, lsf_f3(0, 0.2f, 0), lsf_f3(0.2f, 0, 0));
    mean_rgb(image, 0, rgb);
    lsf_image_destroy(image);
    destroy_scene(scene);
}

/* The floor's light is the mean over the hemisphere, by the cosine, of what the cover lets pass. */
static void assert_covered(const char *technique, uint32_t samples, bool sky, bool slab)
{
    double open[3], covered[3], expected[3];
    look_below(technique, samples, sky, slab, false, open);
    look_below(technique, samples, sky, slab, true, covered);
    for (int c = 0; c < 3; c++) {
        double share = 0.0;
        for (int i = 0; i < 1000; i++) {
            double cosine = sqrt((i + 0.5) / 1000.0), pass = 1.0 - schlick(0.0, cosine);
            share += slab ? pass * pass * pow(cover_tint[c], 0.5 / cosine) : pass * cover_tint[c];
        }
        expected[c] = open[c] * share / 1000.0;
    }
    assert_seen(technique, covered, expected, 0.03);
}

static void rays_through_voxels_are_tinted(void **unused)
{
    (void)unused;
    for (int slab = 0; slab < 2; slab++) {
        assert_covered("cone", 32, false, slab);
        assert_covered("substitute_tree", 32, false, slab);
    }
}

/* Light of the sky passes maps, light of surfaces maps of VPLs and bundles. (A hundredth of the
 * darkest colour's sky comes in beside the cover.) */
static void maps_and_bundles_are_tinted(void **unused)
{
    (void)unused;
    assert_covered("direct", 128, true, false);
    assert_covered("direct", 128, true, true);
    assert_covered("bidirectional", 128, false, true);
}

/* Veils of bundles, tints of maps and chance do not depend on who draws what first. */
static void bits_are_the_same_for_any_threads(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    build_corner(scene);
    for (int pane = 0; pane < 2; pane++) {
        lsf_material *glass = build_glass(scene, 0.8f, 0.0f, pane ? 1.4f : 0.0f);
        glass->base_color[pane] = 0.3f;
        glass->attenuation_distance = 0.5f;
        glass->attenuation_color[0] = 0.5f;
        build_box(scene, lsf_f3(0.1f, 0.2f, 0.5f), lsf_f3(1, 1 + 0.3f * (float)pane, 1), false);
    }
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 1.8f, 1.2f), lsf_f3(0, -1, 0), 2.0f);
    build_environment(scene, 0.3f);
    finish_gl_scene(scene);
    lsf_render_params params =
        corner_params((lsf_render_params){LSF_RENDER_PARAMS_DEFAULTS, .raw = true}, 24);
    params.samples = 2;
    params.bounces = 2;
    assert_same_for_any_threads(scene, &params);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamps_shine_through_panes),
        cmocka_unit_test(floors_glow_through_panes),
        cmocka_unit_test(panes_reflect),
        cmocka_unit_test(slabs_absorb),
        cmocka_unit_test(bundles_and_vpls_pass),
        cmocka_unit_test(cones_are_tinted),
        cmocka_unit_test(rays_through_voxels_are_tinted),
        cmocka_unit_test(maps_and_bundles_are_tinted),
        cmocka_unit_test(bits_are_the_same_for_any_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
