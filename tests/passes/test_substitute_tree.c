/* The tree of lights as a technique, against closed forms and by its rules: furnaces, bounces of a
 * point light, an environment, the same bits again, only what the scene requires, extremes. */
#include <math.h>

#include "base/base.h"
#include "light_rules.h"
#include "plan/plan.h"
#include "techniques/setup.h"

static const char *const options[] = {"cloud.count=16384", "voxel.resolution=64",
                                      "rsm.resolution=64"};

static lsf_render_params params_of(uint32_t samples, uint32_t bounces)
{
    return (lsf_render_params){LSF_RENDER_PARAMS_DEFAULTS,
                               .technique = "substitute_tree",
                               .raw = true,
                               .samples = samples,
                               .bounces = bounces,
                               .options = options,
                               .option_count = LSF_COUNT(options)};
}

/* VPLs close to the point that they light, in edges and corners, are bounded: some light is lost.
 */
static void energy_in_a_furnace(void **unused)
{
    (void)unused;
    static const uint32_t bounces[] = {0, 1, 3};
    lsf_scene *scene = furnace_scene(0.5f);
    for (size_t i = 0; i < LSF_COUNT(bounces); i++) {
        lsf_image *image = render_gl_from(scene, params_of(8, bounces[i]), 24,
                                          lsf_f3(0.2f, 0.1f, 0.7f), lsf_f3(-0.3f, -0.2f, -1));
        assert_mean("furnace", image, furnace_radiance(0.5f, bounces[i]), 0.03);
        lsf_image_destroy(image);
    }
    lsf_scene_destroy(scene);
}

static void bounces_in_a_sphere(void **unused)
{
    (void)unused;
    lsf_scene *scene = lit_sphere_scene(0.6f);
    for (uint32_t bounces = 0; bounces <= 4; bounces += 2) {
        lsf_image *image = render_gl_from(scene, params_of(8, bounces), 24, lsf_f3(0, 0, 0.5f),
                                          lsf_f3(0.3f, 0.2f, -1));
        assert_mean("sphere", image, lit_sphere_radiance(0.6f, bounces), 0.03);
        lsf_image_destroy(image);
    }
    lsf_scene_destroy(scene);
}

/* Light of the environment comes straight, and none is counted twice. */
static void white_furnace(void **unused)
{
    (void)unused;
    lsf_scene *scene = white_sphere_scene(4);
    lsf_image *image =
        render_gl_from(scene, params_of(16, 3), 24, lsf_f3(0, 0, 3), lsf_f3(0, 0, 0));
    assert_mean("white furnace", image, 0.5, 0.02);
    lsf_image_destroy(image);
    lsf_scene_destroy(scene);
}

static void same_bits_again(void **unused)
{
    (void)unused;
    lsf_scene *scene = lit_room_scene(1.0f);
    lsf_render_params params = corner_params(params_of(2, 2), 33);
    assert_same_for_any_threads(scene, &params);
    lsf_scene_destroy(scene);
}

static void light_scales(void **unused)
{
    (void)unused;
    assert_light_scales(params_of(2, 2));
}

static bool has_pass(const lsf_scene *scene, uint32_t bounces, const char *const *passes)
{
    lsf_error error = {0};
    lsf_setup setup;
    lsf_render_params params = corner_params(params_of(1, bounces), 16);
    if (!lsf_setup_init(&setup, scene, &params, true, &error))
        fail_msg("%s", error.message);
    uint32_t found = 0, asked = 0;
    for (; passes[asked]; asked++)
        found += lsf_plan_find_pass(setup.plan, passes[asked]) != NULL;
    lsf_setup_finish(&setup);
    assert_true(found == 0 || found == asked);
    return found > 0;
}

/* Paths begin where there is light, and go on where it bounces. */
static void only_what_is_required(void **unused)
{
    (void)unused;
    static const char *const tree[] = {"voxelize_clear", "light_tree", "light_tree_sample", NULL};
    static const char *const lights[] = {"reflective_shadow_map", "vpl_cloud_light", NULL};
    static const char *const emitters[] = {"vpl_cloud_emitter", NULL};
    static const char *const on[] = {"vpl_cloud_bounce", NULL};
    static const struct {
        bool lamp, light;
        uint32_t bounces;
        bool tree, lights, emitters, on;
    } cases[] = {
        {false, true, 0, false, false, false, false},  {false, true, 1, true, true, false, false},
        {false, true, 2, true, true, false, true},     {true, false, 0, true, false, true, false},
        {true, false, 1, true, false, true, true},     {true, true, 0, true, false, true, false},
        {false, false, 2, false, false, false, false},
    };
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_scene *scene = build_scene();
        lsf_material *material = build_material(scene, 0.5f, 0.5f, 0.5f);
        material->emission[1] = cases[i].lamp ? 1.0f : 0.0f;
        build_floor(scene, 0.0f, 1.0f);
        if (cases[i].light)
            build_light(scene, LSF_LIGHT_POINT, lsf_f3(0, 1, 0), lsf_f3(0, -1, 0), 1.0f);
        finish_gl_scene(scene);
        assert_int_equal(has_pass(scene, cases[i].bounces, tree), cases[i].tree);
        assert_int_equal(has_pass(scene, cases[i].bounces, lights), cases[i].lights);
        assert_int_equal(has_pass(scene, cases[i].bounces, emitters), cases[i].emitters);
        assert_int_equal(has_pass(scene, cases[i].bounces, on), cases[i].on);
        lsf_scene_destroy(scene);
    }
}

static void every_allocation_may_fail(void **unused)
{
    (void)unused;
    lsf_scene *scene = lit_room_scene(1.0f);
    assert_every_allocation_may_fail(scene, params_of(1, 2), 40);
    lsf_scene_destroy(scene);
}

/* Pictures of 1 x 1 and 7 x 13, an empty scene, one flat triangle, a camera in a surface, a light
 * in a surface. */
static void extremes(void **unused)
{
    (void)unused;
    assert_finite_extremes(params_of(1, 2), 0.1f);
}

/* Of the corner: what a light of each intensity adds, with a second floor in the first one's place
 * where asked for. */
static void mean_of_lights(const float intensities[2], bool twin, float height, double rgb[3])
{
    static const float at[2] = {-0.4f, 0.4f};
    lsf_scene *scene = build_scene();
    build_material(scene, 0.7f, 0.6f, 0.5f);
    build_floor(scene, 0.0f, 1.0f);
    build_quad(scene, lsf_f3(-1, 0, -1), lsf_f3(1, 0, -1), lsf_f3(1, 2, -1), lsf_f3(-1, 2, -1));
    if (twin) {
        build_material(scene, 0.7f, 0.6f, 0.5f);
        build_floor(scene, 0.0f, 1.0f);
    }
    for (int i = 0; i < 2; i++)
        if (intensities[i] > 0.0f)
            build_light(scene, LSF_LIGHT_POINT, lsf_f3(at[i], height, -0.2f), lsf_f3(0, -1, 0),
                        intensities[i]);
    scene->diffuse_only = true;
    finish_gl_scene(scene);
    lsf_image *image = render_corner(scene, params_of(8, 2), 24);
    mean_rgb(image, 0, rgb);
    lsf_image_destroy(image);
    lsf_scene_destroy(scene);
}

static void assert_alike(const double rgb[3], const double expected[3])
{
    for (int c = 0; c < 3; c++) {
        print_message("%.5g, expected %.5g\n", rgb[c], expected[c]);
        assert_true(fabs(rgb[c] / expected[c] - 1.0) <= 0.02);
    }
}

/* The light of two lamps is the sum of either's, whether they are alike or one is 10^6 times as
 * bright; and a surface that is there twice is no other than one. */
static void lights_add_up(void **unused)
{
    (void)unused;
    static const float pairs[2][2] = {{2.0f, 3.0f}, {3e6f, 3.0f}};
    for (int i = 0; i < 2; i++) {
        double sum[3] = {0, 0, 0}, both[3], one[3];
        for (int k = 0; k < 2; k++) {
            mean_of_lights((float[2]){k == 0 ? pairs[i][0] : 0.0f, k == 1 ? pairs[i][1] : 0.0f},
                           false, 0.7f, one);
            for (int c = 0; c < 3; c++)
                sum[c] += one[c];
        }
        mean_of_lights(pairs[i], false, 0.7f, both);
        assert_alike(both, sum);
        mean_of_lights(pairs[i], true, 0.7f, one);
        assert_alike(one, both);
    }
}

/* A light on a surface, and next to it. */
static void lights_at_surfaces(void **unused)
{
    (void)unused;
    static const float heights[] = {0.0f, 1e-6f, 1e-3f};
    for (size_t i = 0; i < LSF_COUNT(heights); i++) {
        double rgb[3];
        mean_of_lights((float[2]){3.0f, 0.0f}, false, heights[i], rgb);
        assert_true(isfinite(rgb[0]) && isfinite(rgb[1]) && isfinite(rgb[2]));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energy_in_a_furnace),
        cmocka_unit_test(bounces_in_a_sphere),
        cmocka_unit_test(white_furnace),
        cmocka_unit_test(same_bits_again),
        cmocka_unit_test(light_scales),
        cmocka_unit_test(only_what_is_required),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(extremes),
        cmocka_unit_test(lights_add_up),
        cmocka_unit_test(lights_at_surfaces),
    };
    return cmocka_run_group_tests_name("substitute_tree", tests, NULL, NULL);
}
