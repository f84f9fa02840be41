/* What bounces in a room does not change with what lies far from it. */
#include <math.h>

#include "render_gl.h"

#define SIZE 24

/* An open box of half width 1 under a lamp in it, 2 bounces; with a triangle of a millimetre far
 * off, or not. */
static double mean_light(const lsf_float3 *stray)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.8f, 0.8f, 0.8f);
    build_box(scene, lsf_f3(-1, -1, -1), lsf_f3(1, 1, 1), true);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0, 0.5f, 0), lsf_f3(0, -1, 0), 3.0f);
    if (stray) {
        const lsf_float3 p = *stray;
        const lsf_float3 corners[3] = {p, {p.x + 1e-3f, p.y, p.z}, {p.x, p.y, p.z + 1e-3f}};
        build_triangles(scene, corners, 1);
    }
    finish_gl_scene(scene);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    params.technique = "bidirectional";
    params.samples = 48;
    params.bounces = 3;
    lsf_image *image =
        render_gl_from(scene, params, SIZE, lsf_f3(0.1f, -0.2f, 0.9f), lsf_f3(0, 0, -1));
    double rgb[3];
    mean_rgb(image, 0, rgb);
    lsf_image_destroy(image);
    destroy_scene(scene);
    return rgb[0];
}

static void beside_a_stray_triangle(void **unused)
{
    (void)unused;
    const lsf_float3 places[] = {{1000, 0, 0}, {-700, 2000, 300}};
    double alone = mean_light(NULL);
    for (int i = 0; i < 2; i++) {
        double beside = mean_light(&places[i]);
        print_message("%+.2f %%\n", 100.0 * (beside / alone - 1.0));
        assert_true(fabs(beside / alone - 1.0) < 0.01);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(beside_a_stray_triangle)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
