/* How the path tracer finds light: from punctual lights by way of a surface, and from many lights.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "render_scene.h"

/* Within a sphere, what any of its points reflects diffusely reaches all others alike: of the power
 * P of a lamp anywhere inside, E_k = albedo^k P / (4 pi r^2) arrives at each after k reflections.
 * The lamp is so close to the wall that a path comes by chance upon what it lights once in
 * thousands. */
static double one_bounce_within_sphere(lsf_light_type type, float from_wall, uint32_t samples,
                                       uint32_t bounces)
{
    static const float eye[3] = {0.2f, 0.1f, 0.3f}, target[3] = {-1.0f, 0.2f, 0.1f};
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_sphere(scene, 5, true);
    lsf_light *lamp = build_light(scene, type, lsf_f3(0, 1.0f - from_wall, 0), lsf_f3(0, 1, 0), 1);
    double power = 4.0 * M_PI;
    if (type == LSF_LIGHT_SPOT) {
        lamp->inner_cone = 0.5f;
        lamp->outer_cone = 1.0f;
        /* Of the squared ramp from cos 1 to cos 0.5: a third of its height. */
        power = 2.0 * M_PI * (1.0 - cos(0.5) + (cos(0.5) - cos(1.0)) / 3.0);
    }
    finish_scene(scene);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    params.width = params.height = 8;
    params.samples = samples;
    params.bounces = bounces;
    params.camera_position = eye;
    params.camera_target = target;
    lsf_image *image = render_scene(scene, &params, 0, 0);
    double mean[3], expected = 0.0;
    image_mean(image, 16, mean);
    for (uint32_t k = 1; k <= bounces; k++)
        expected += pow(0.5, k + 1.0) / M_PI * power / (4.0 * M_PI);
    lsf_image_destroy(image);
    destroy_scene(scene);
    return mean[0] / expected - 1.0;
}

static void lamps_close_to_walls(void **unused)
{
    (void)unused;
    static const float from_wall[] = {0.5f, 0.02f};
    for (int type = 0; type < 2; type++) {
        for (int place = 0; place < 2; place++) {
            for (uint32_t bounces = 1; bounces < 4; bounces += 2) {
                double error = one_bounce_within_sphere(type ? LSF_LIGHT_SPOT : LSF_LIGHT_POINT,
                                                        from_wall[place], 64, bounces);
                print_message("%s, %g from the wall, %u bounces: %.4f\n", type ? "spot" : "point",
                              (double)from_wall[place], bounces, error);
                assert_true(fabs(error) < 0.002);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamps_close_to_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
