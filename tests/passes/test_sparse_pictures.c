/* Pictures of which light is gathered at fewer points than there are pixels: they converge to those
 * of which every pixel gathers its own. */
#include <math.h>

#include "base/base.h"
#include "render_gl.h"

enum { SIZE = 16, LATE = 24 };

static lsf_scene *lit_corner(void)
{
    lsf_scene *scene = build_scene();
    build_corner(scene);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
    scene->diffuse_only = true;
    finish_gl_scene(scene);
    return scene;
}

static lsf_image *render(const lsf_scene *scene, const char *technique, const char *grid,
                         uint32_t samples)
{
    const char *const options[] = {"voxel.resolution=32",      "rsm.resolution=32",
                                   "vpl.shadow_resolution=32", "bundle.resolution=64",
                                   "interleave.size=1",        grid};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true, .bounces = 1};
    params.technique = technique;
    params.samples = samples;
    params.options = options;
    params.option_count = LSF_COUNT(options);
    return render_corner(scene, params, SIZE);
}

static double squared_difference(const lsf_image *a, const lsf_image *b)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < a->width * a->height * a->channel_count; i++) {
        double d = (double)a->pixels[i] - (double)b->pixels[i];
        sum += d * d;
    }
    return sum;
}

/* Iterations weigh alike, and once points are pixels they are those of a picture that was never
 * sparse: what the first four have interpolated has a share that falls as 1 / N. */
static void the_mean_converges(void **unused)
{
    (void)unused;
    static const char *const techniques[] = {"bidirectional", "cone", "voxel_path"};
    lsf_scene *scene = lit_corner();
    for (size_t t = 0; t < LSF_COUNT(techniques); t++) {
        double errors[2];
        for (int late = 0; late < 2; late++) {
            lsf_image *plain = render(scene, techniques[t], "sparse.grid=1", late ? LATE : 4);
            lsf_image *sparse = render(scene, techniques[t], "sparse.grid=2", late ? LATE : 4);
            errors[late] = sqrt(squared_difference(plain, sparse));
            lsf_image_destroy(plain);
            lsf_image_destroy(sparse);
        }
        print_message("%s: off by %.3g after 4 iterations, by %.3g later\n", techniques[t],
                      errors[0], errors[1]);
        assert_true(errors[0] > 0.0);
        assert_true(errors[1] <= 1.01 * errors[0] * 4.0 / LATE);
    }
    lsf_scene_destroy(scene);
}

/* What four iterations find at every second pixel is what all pixels find, within noise.
 */
static void the_mean_is_that_of_all_pixels(void **unused)
{
    (void)unused;
    lsf_scene *scene = lit_corner();
    double plain[3], sparse[3];
    lsf_image *image = render(scene, "bidirectional", "sparse.grid=1", 4);
    mean_rgb(image, 0, plain);
    lsf_image_destroy(image);
    image = render(scene, "bidirectional", "sparse.grid=2", 4);
    mean_rgb(image, 0, sparse);
    lsf_image_destroy(image);
    for (int c = 0; c < 3; c++) {
        print_message("%.5f by all pixels, %.5f by every second\n", plain[c], sparse[c]);
        assert_true(fabs(sparse[c] / plain[c] - 1.0) < 0.005);
    }
    lsf_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mean_converges),
        cmocka_unit_test(the_mean_is_that_of_all_pixels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
