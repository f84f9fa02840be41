/* What bounces in a room does not change with what lies far from it. */
#include <math.h>

#include "render_gl.h"

#define SIZE 24

/* An open box of half width 1 under a lamp in it, 3 bounces; with a triangle of a millimetre far
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
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
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

static void count_warnings(lsf_log_level level, const char *message, void *user)
{
    if (level == LSF_LOG_WARNING && strstr(message, "may be off"))
        ++*(int *)user;
}

/* Of a box on ground of half width `ground`, with a triangle far off or not. */
static int warnings(const char *technique, uint32_t bounces, float ground, bool stray)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.8f, 0.8f, 0.8f);
    build_box(scene, lsf_f3(-1, -1, -1), lsf_f3(1, 1, 1), false);
    build_floor(scene, -1.0f, ground);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(2, 2, 2), lsf_f3(0, -1, 0), 3.0f);
    const lsf_float3 corners[3] = {{500, 0, 0}, {500.1f, 0, 0}, {500, 0, 0.1f}};
    if (stray)
        build_triangles(scene, corners, 1);
    finish_gl_scene(scene);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = technique;
    params.samples = 2;
    params.bounces = bounces;
    int count = 0;
    lsf_log_set_handler(count_warnings, &count);
    lsf_image_destroy(render_gl_from(scene, params, SIZE, lsf_f3(1, 3, 4), lsf_f3(0.2f, 0, 0)));
    lsf_log_set_handler(NULL, NULL);
    destroy_scene(scene);
    return count;
}

/* Once, where a grid or a map over the whole scene is too coarse for what is seen. */
static void coarse_maps_are_reported(void **unused)
{
    (void)unused;
    static const struct {
        const char *technique;
        uint32_t bounces;
        float ground;
        bool stray;
        int warnings;
    } cases[] = {
        {"bidirectional", 2, 3, false, 0},   {"bidirectional", 2, 3, true, 0},
        {"bidirectional", 2, 300, false, 1}, {"bidirectional", 1, 300, false, 0},
        {"voxel_path", 1, 3, false, 0},      {"voxel_path", 1, 3, true, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(
            warnings(cases[i].technique, cases[i].bounces, cases[i].ground, cases[i].stray),
            cases[i].warnings);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(beside_a_stray_triangle),
                                       cmocka_unit_test(coarse_maps_are_reported)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
