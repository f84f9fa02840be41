/* Shadow maps of directions of the environment: a square over a plane, drawn by the pipeline and by
 * the compute shader, in view and far from it. */
#include <math.h>

#include "base/base.h"
#include "render_gl.h"

/* How much of what a point sees, by the cosine, a parallel square covers whose middle is `height`
 * above it: four times the form factor of a quarter (Howell, "A Catalog of Radiation Heat Transfer
 * Configuration Factors", B-3). */
static double covered(double half_side, double height)
{
    double x = half_side / height, root = sqrt(1.0 + x * x);
    return 4.0 / (2.0 * M_PI) * 2.0 * x / root * atan(x / root);
}

/* A square in parts x parts squares, two triangles each. */
static void build_square(lsf_scene *scene, float height, float half_side, int parts)
{
    lsf_float3 *corners = calloc((size_t)(6 * parts * parts), sizeof *corners);
    float step = 2.0f * half_side / (float)parts;
    lsf_float3 *at = corners;
    for (int i = 0; i < parts * parts; i++) {
        float x = step * (float)(i % parts) - half_side, z = step * (float)(i / parts) - half_side;
        lsf_float3 a = lsf_f3(x, height, z), b = lsf_f3(x, height, z + step),
                   c = lsf_f3(x + step, height, z + step), d = lsf_f3(x + step, height, z);
        const lsf_float3 both[6] = {a, b, c, a, c, d};
        memcpy(at, both, sizeof both);
        at += 6;
    }
    build_triangles(scene, corners, (uint32_t)(2 * parts * parts));
    free(corners);
}

static lsf_scene *square_scene(float height, float half_side, int parts)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_floor(scene, 0.0f, 4.0f);
    build_square(scene, height, half_side, parts);
    build_environment(scene, 1.0f);
    scene->diffuse_only = true;
    finish_gl_scene(scene);
    return scene;
}

static lsf_image *render_floor(const lsf_scene *scene, float fov_y, uint32_t samples)
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    const char *const options[] = {"environment.directions=24"};
    params.technique = "direct";
    params.samples = samples;
    params.bounces = 0;
    params.fov_y = fov_y;
    params.options = options;
    params.option_count = LSF_COUNT(options);
    return render_gl_from(scene, params, 16, lsf_f3(0.01f, 0.5f, 0), lsf_f3(0, 0, 0));
}

static double middle_of(const lsf_image *image)
{
    const float *pixels = image->pixels;
    size_t row = (size_t)image->width * image->channel_count;
    const float *middle = pixels + 8 * row + (size_t)8 * image->channel_count;
    return (double)middle[0];
}

/* Depths are fitted to the floor, of which a needle sees little: the square lies far outside them.
 */
static void square_far_above(void **unused)
{
    (void)unused;
    lsf_scene *scene = square_scene(40.0f, 40.0f, 1);
    lsf_image *image = render_floor(scene, 0.02f, 128);
    double expected = 0.5 * (1.0 - covered(40.0, 40.0));
    print_message("%.5f, expected %.5f\n", middle_of(image), expected);
    assert_true(fabs(middle_of(image) / expected - 1.0) <= 5e-3);
    lsf_image_destroy(image);
    destroy_scene(scene);
}

/* Two triangles, and 32,768 that the compute shader draws. */
static void same_square_in_parts(void **unused)
{
    (void)unused;
    double middle[2], expected = 0.5 * (1.0 - covered(1.0, 1.0));
    lsf_image *images[2];
    for (int i = 0; i < 2; i++) {
        lsf_scene *scene = square_scene(1.0f, 1.0f, i == 0 ? 1 : 128);
        images[i] = render_floor(scene, 1.5f, 64);
        middle[i] = middle_of(images[i]);
        print_message("%.5f, expected %.5f\n", middle[i], expected);
        assert_true(fabs(middle[i] / expected - 1.0) <= 0.015); /* a pixel is 0.06 wide */
        destroy_scene(scene);
    }
    size_t count = (size_t)images[0]->width * images[0]->height * images[0]->channel_count;
    double apart = 0.0;
    for (size_t i = 0; i < count; i++)
        apart += fabs((double)(images[0]->pixels[i] - images[1]->pixels[i]));
    print_message("%.6f apart\n", apart / (double)count);
    assert_true(apart / (double)count <= 1e-4);
    lsf_image_destroy(images[0]);
    lsf_image_destroy(images[1]);
}

static void same_bits_for_any_threads(void **unused)
{
    (void)unused;
    lsf_scene *scene = square_scene(1.0f, 1.0f, 64);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "direct";
    params.samples = 2;
    params.width = params.height = 24;
    assert_same_for_any_threads(scene, &params);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(square_far_above),
        cmocka_unit_test(same_square_in_parts),
        cmocka_unit_test(same_bits_for_any_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
