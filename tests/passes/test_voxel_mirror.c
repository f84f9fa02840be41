/* Voxels of smooth metal under an environment show it in their lobes to mirrors: two planes that
 * meet at a right angle send a ray back, at the elevation that it came from. */
#include <math.h>

#include "base/base.h"
#include "render_gl.h"

enum { WIDTH = 4, HEIGHT = 64 };

static const char *const techniques[] = {"voxel_path", "cone"};

/* A floor and a wall of white metal, and a sky that is bright above 45 degrees. */
static lsf_scene *metal_corner(float roughness, float low)
{
    lsf_scene *scene = build_scene();
    lsf_material *material = build_material(scene, 1, 1, 1);
    material->metallic = 1.0f;
    material->roughness = roughness;
    build_floor(scene, 0.0f, 4.0f);
    build_quad(scene, lsf_f3(-0.5f, 0, -4), lsf_f3(-0.5f, 4, -4), lsf_f3(-0.5f, 4, 4),
               lsf_f3(-0.5f, 0, 4));
    float *texels = build_environment_map(scene, WIDTH, HEIGHT);
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++)
        texels[i] = i / (3 * WIDTH) < HEIGHT / 4 ? 1.0f : low;
    finish_gl_scene(scene);
    return scene;
}

/* Radiance of the floor half a unit from the wall, seen `degrees` above the horizon. */
static double seen_at(const lsf_scene *scene, const char *technique, double degrees)
{
    double angle = degrees * M_PI / 180.0;
    const float eye[3] = {3.0f * (float)cos(angle), 3.0f * (float)sin(angle), 0.1f};
    const float target[3] = {0, 0, 0.1f};
    const char *const options[] = {"voxel.resolution=64"};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = technique;
    params.samples = 32;
    params.bounces = 3;
    params.fov_y = 0.02f;
    params.options = options;
    params.option_count = LSF_COUNT(options);
    params.camera_position = eye;
    params.camera_target = target;
    params.width = params.height = 8;
    lsf_image *image = render_gl(LSF_BACKEND_OSMESA, scene, &params);
    double rgb[3];
    mean_rgb(image, 0, rgb);
    lsf_image_destroy(image);
    return rgb[1];
}

static void expect_seen(const lsf_scene *scene, double degrees, double expected)
{
    for (size_t i = 0; i < LSF_COUNT(techniques); i++) {
        double found = seen_at(scene, techniques[i], degrees);
        print_message("%s at %.0f degrees: %.4f, expected %.1f\n", techniques[i], degrees, found,
                      expected);
        assert_true(fabs(found / expected - 1.0) <= 0.03);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_corner_sends_back),
        cmocka_unit_test(a_furnace_stays_white),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
