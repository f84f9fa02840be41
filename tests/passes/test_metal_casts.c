/* Light that smooth metal casts on other surfaces. Few samples of a narrow lobe spread it, but
 * little of it may reach what the lobe leaves dark. */
#include <math.h>

#include "base/base.h"
#include "render_gl.h"

static const double ROUGHNESS = 0.25;

/* A floor of metal under a sun straight above sends light back up. The wall beside it gets the
 * light at the lobe's edge. */
static lsf_scene *sunlit_metal(void)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.8f, 0.8f, 0.8f)->specular = 0.0f;
    build_quad(scene, lsf_f3(0, 0, 1), lsf_f3(0, 0, -1), lsf_f3(0, 2, -1), lsf_f3(0, 2, 1));
    lsf_material *metal = build_material(scene, 0.9f, 0.9f, 0.9f);
    metal->metallic = 1.0f;
    metal->roughness = (float)ROUGHNESS;
    build_quad(scene, lsf_f3(0, 0, -1), lsf_f3(0, 0, 1), lsf_f3(2, 0, 1), lsf_f3(2, 0, -1));
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(0, -1, 0), 3.1415927f);
    finish_gl_scene(scene);
    return scene;
}

/* Radiance of the wall's middle part, from 0.1 to 1.9 above the floor, in red: the integral of
 * glTF's BRDF over the floor, by midpoints. */
static double wall_lit_by_floor(void)
{
    enum { WALL = 24, FLOOR = 128 };
    const double pi = 3.14159265358979, alpha2 = pow(ROUGHNESS, 4.0);
    double sum = 0.0;
    for (int w = 0; w < WALL * WALL; w++)
        for (int f = 0; f < FLOOR * FLOOR; f++) {
            double y = 0.1 + 1.8 * (w / WALL + 0.5) / WALL,
                   z = -0.9 + 1.8 * (w % WALL + 0.5) / WALL;
            double x = 2.0 * (f / FLOOR + 0.5) / FLOOR,
                   along = 2.0 * (f % FLOOR + 0.5) / FLOOR - 1.0;
            double d2 = x * x + y * y + (z - along) * (z - along), d = sqrt(d2);
            double up = y / d, half = sqrt(0.5 * (1.0 + up)); /* cosines to the floor's normal */
            double t = half * half * (alpha2 - 1.0) + 1.0;
            double lobe = alpha2 / (pi * t * t);
            double masking = 0.5 / (sqrt(up * up * (1.0 - alpha2) + alpha2) + up);
            double fresnel = 0.9 + 0.1 * pow(1.0 - half, 5.0);
            sum += pi * lobe * masking * fresnel * up * (x / d) / d2;
        }
    return 0.8 / pi * sum * 4.0 / (FLOOR * FLOOR) / (WALL * WALL);
}

static double wall(const lsf_scene *scene, const char *technique)
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    double rgb[3];
    params.technique = technique;
    params.samples = 64;
    params.bounces = 1;
    params.fov_y = 2.0f * atanf(0.9f / 4.0f);
    lsf_image *image = render_gl_from(scene, params, 32, lsf_f3(4, 1, 0), lsf_f3(0, 1, 0));
    mean_rgb(image, 0, rgb);
    lsf_image_destroy(image);
    return rgb[0];
}

/* All pixels of `bidirectional` share 64 directions, which leave it more noise. */
static void lobes_stay_narrow(void **unused)
{
    (void)unused;
    static const char *const techniques[] = {"voxel_path", "cone", "bidirectional"};
    static const double allowed[] = {0.06, 0.06, 0.2};
    double expected = wall_lit_by_floor();
    lsf_scene *scene = sunlit_metal();
    for (size_t t = 0; t < LSF_COUNT(techniques); t++) {
        double found = wall(scene, techniques[t]);
        print_message("%s: %.4f, expected %.4f\n", techniques[t], found, expected);
        assert_true(fabs(found / expected - 1.0) <= allowed[t]);
    }
    lsf_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lobes_stay_narrow),
    };
    return cmocka_run_group_tests_name("metal_casts", tests, NULL, NULL);
}
