/* Voxels of smooth metal show environment and lamps in their lobes. To mirrors: two planes that
 * meet at a right angle send a ray back, at the elevation that it came from. And to other surfaces:
 * a metal floor throws a lamp's light forward. */
#include <math.h>

#include "base/base.h"
#include "render_gl.h"
#include "shared/brdf.h"

enum { WIDTH = 4, HEIGHT = 64 };

static const char *const techniques[] = {"voxel_path", "cone"};

static void build_metal(lsf_scene *scene, float roughness)
{
    lsf_material *material = build_material(scene, 1, 1, 1);
    material->metallic = 1.0f;
    material->roughness = roughness;
}

static void build_wall(lsf_scene *scene)
{
    build_quad(scene, lsf_f3(-0.5f, 0, -4), lsf_f3(-0.5f, 4, -4), lsf_f3(-0.5f, 4, 4),
               lsf_f3(-0.5f, 0, 4));
}

/* A floor and a wall of white metal, and a sky that is bright above 45 degrees. */
static lsf_scene *metal_corner(float roughness, float low)
{
    lsf_scene *scene = build_scene();
    build_metal(scene, roughness);
    build_floor(scene, 0.0f, 4.0f);
    build_wall(scene);
    float *texels = build_environment_map(scene, WIDTH, HEIGHT);
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++)
        texels[i] = i / (3 * WIDTH) < HEIGHT / 4 ? 1.0f : low;
    finish_gl_scene(scene);
    return scene;
}

static lsf_render_params voxel_params(uint32_t samples, uint32_t bounces, float fov_y)
{
    static const char *const options[] = {"voxel.resolution=64"};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.samples = samples;
    params.bounces = bounces;
    params.fov_y = fov_y;
    params.options = options;
    params.option_count = LSF_COUNT(options);
    return params;
}

/* A unit vector in the plane across the wall, `degrees` above the floor and away from the wall. */
static lsf_float3 elevated(double degrees)
{
    double angle = degrees * M_PI / 180.0;
    return lsf_f3((float)cos(angle), (float)sin(angle), 0);
}

/* Radiance of the floor half a unit from the wall, seen `degrees` above the horizon. */
static void seen_at(const lsf_scene *scene, const char *technique, uint32_t bounces, double degrees,
                    double rgb[3])
{
    lsf_float3 target = lsf_f3(0, 0, 0.1f);
    lsf_render_params params = voxel_params(32, bounces, 0.02f);
    params.technique = technique;
    lsf_image *image =
        render_gl_from(scene, params, 8, lsf_f3_mad(target, elevated(degrees), 3.0f), target);
    mean_rgb(image, 0, rgb);
    lsf_image_destroy(image);
}

static void expect_seen(const lsf_scene *scene, double degrees, double expected)
{
    for (size_t i = 0; i < LSF_COUNT(techniques); i++) {
        double found[3];
        seen_at(scene, techniques[i], 3, degrees, found);
        print_message("%s at %.0f degrees: %.4f, expected %.1f\n", techniques[i], degrees, found[1],
                      expected);
        assert_true(fabs(found[1] / expected - 1.0) <= 0.03);
    }
}

static void a_corner_sends_back(void **unused)
{
    (void)unused;
    lsf_scene *scene = metal_corner(0.05f, 0.1f);
    expect_seen(scene, 25.0, 0.1);
    expect_seen(scene, 65.0, 1.0);
    destroy_scene(scene);
}

/* No light is lost or counted twice between directions that voxels mirror and those that they
 * spread. */
static void a_furnace_stays_white(void **unused)
{
    (void)unused;
    lsf_scene *scene = metal_corner(0.15f, 1.0f);
    expect_seen(scene, 40.0, 1.0);
    destroy_scene(scene);
}

static void build_lamp(lsf_scene *scene, double degrees, float red, float blue)
{
    lsf_light *lamp = build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0),
                                  lsf_f3_scale(elevated(degrees), -1.0f), 1.0f);
    lamp->intensity[0] = red;
    lamp->intensity[1] = 0.0f;
    lamp->intensity[2] = blue;
}

/* What a wall of white metal reflects of a lamp at that elevation towards a mirror that is seen
 * from 25 degrees. */
static double wall_shows(double degrees, float roughness)
{
    lsf_float3 normal = lsf_f3(1, 0, 0), light = elevated(degrees), view = elevated(-25.0);
    lsf_float3 half = lsf_f3_normalize(lsf_f3_add(light, view));
    lsf_float3 across = lsf_f3_cross(normal, half);
    float alpha = lsf_alpha_from_roughness(roughness);
    return (double)(lsf_ggx_d(half.x, lsf_f3_dot(across, across), alpha) *
                    lsf_ggx_v(light.x, view.x, alpha) * light.x);
}

/* A mirror that shows a wall of rougher metal under a lamp `degrees` above the floor. With one
 * bounce, as with more the mirror throws the lamp's light on the wall, too. */
static void expect_highlight(double degrees)
{
    const float roughness = 0.4f; /* as voxels store it */
    lsf_scene *scene = build_scene();
    build_metal(scene, 0.05f);
    build_floor(scene, 0.0f, 4.0f);
    build_metal(scene, roughness);
    build_wall(scene);
    build_lamp(scene, degrees, 1, 1);
    finish_gl_scene(scene);
    double expected = wall_shows(degrees, roughness);
    for (size_t i = 0; i < LSF_COUNT(techniques); i++) {
        double found[3];
        seen_at(scene, techniques[i], 1, 25.0, found);
        print_message("%s, lamp at %.0f degrees: %.4f, expected %.4f\n", techniques[i], degrees,
                      found[0], expected);
        assert_true(fabs(found[0] / expected - 1.0) <= 0.01);
    }
    destroy_scene(scene);
}

static void lamps_have_highlights(void **unused)
{
    (void)unused;
    expect_highlight(25.0);
    expect_highlight(40.0);
}

static lsf_render_params wall_params(void)
{
    static const float eye[3] = {3, 1, 0}, target[3] = {-0.5f, 1, 0};
    lsf_render_params params = voxel_params(128, 1, 20.0f);
    params.camera_position = eye;
    params.camera_target = target;
    params.width = params.height = 16;
    return params;
}

static void reference_means(const lsf_scene *scene, lsf_render_params params, uint32_t bounces,
                            double rgb[3])
{
    lsf_error error = {0};
    params.bounces = bounces;
    lsf_image *image = lsf_reference_render(scene, &params, 0, NULL, &error);
    if (!image)
        fail_msg("%s", error.message);
    mean_rgb(image, 0, rgb);
    lsf_image_destroy(image);
}

/* A metal floor and a white wall, without light. */
static lsf_scene *floor_and_wall(void)
{
    lsf_scene *scene = build_scene();
    build_metal(scene, 0.4f);
    build_floor(scene, 0.0f, 4.0f);
    build_material(scene, 1, 1, 1);
    build_wall(scene);
    return scene;
}

/* The light that the floor adds to the wall is that of the path tracer. */
static void expect_thrown(lsf_scene *scene)
{
    lsf_render_params params = wall_params();
    double direct[3], both[3];
    finish_gl_scene(scene);
    reference_means(scene, params, 0, direct);
    reference_means(scene, params, 1, both);
    for (size_t i = 0; i < LSF_COUNT(techniques); i++) {
        double found[3];
        params.technique = techniques[i];
        lsf_image *image = render_gl(gl_test_backend(), scene, &params);
        mean_rgb(image, 0, found);
        lsf_image_destroy(image);
        for (int c = 0; c < 3; c += 2) {
            double added = found[c] - direct[c], expected = both[c] - direct[c];
            print_message("%s: the floor adds %.4f, expected %.4f, to %.4f\n", techniques[i], added,
                          expected, direct[c]);
            assert_true(fabs(added / expected - 1.0) <= 0.05);
        }
    }
    destroy_scene(scene);
}

/* Each voxel keeps one of both. */
static void floors_throw_light_of_lamps(void **unused)
{
    (void)unused;
    lsf_scene *scene = floor_and_wall();
    build_lamp(scene, 35.0, 1, 0.1f);
    build_lamp(scene, 65.0, 0.1f, 1);
    expect_thrown(scene);
}

/* The sun is a texel of the environment, 42 degrees above the floor. */
static void floors_throw_light_of_a_sun(void **unused)
{
    (void)unused;
    enum { SIDE = 32 };
    lsf_scene *scene = floor_and_wall();
    float *texels = build_environment_map(scene, 2 * SIDE, SIDE);
    float *sun = texels + 3 * (SIDE / 4 * 2 * SIDE + SIDE);
    sun[0] = sun[1] = sun[2] = 150.0f;
    expect_thrown(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamps_have_highlights),
        cmocka_unit_test(floors_throw_light_of_lamps),
        cmocka_unit_test(floors_throw_light_of_a_sun),
        cmocka_unit_test(a_corner_sends_back),
        cmocka_unit_test(a_furnace_stays_white),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
