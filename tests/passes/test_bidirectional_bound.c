/* The bound on what VPLs that alone end a path shed near by: it takes little, and nothing in the
 * end. */
#include <math.h>

#include "render_gl.h"

/* Of a corner at two bounces by VPLs alone: the luminance that the bound takes away, in all of it,
 * and its brightest pixel. */
static double lost(const char *option, uint32_t samples, float *brightest)
{
    lsf_scene *scene = build_scene();
    build_corner(scene);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0.5f, 2.0f, 0.5f), lsf_f3(0, -1, 0), 5.0f);
    finish_gl_scene(scene);
    const char *const options[] = {"bundle.window=visible", option};
    lsf_render_params params = corner_params(
        (lsf_render_params){LSF_RENDER_PARAMS_DEFAULTS, .raw = true, .technique = "bidirectional"},
        24);
    params.samples = samples;
    params.bounces = 2;
    params.options = options;
    params.option_count = 2;
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    lsf_error error = {0};
    lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
    if (!renderer || !lsf_renderer_run(renderer, &error))
        fail_msg("%s", error.message);
    lsf_image *image = lsf_renderer_read(renderer, &error);
    *brightest = 0.0f;
    for (uint32_t i = 0; i < 24 * 24 * image->channel_count; i++)
        *brightest = fmaxf(*brightest, image->pixels[i]);
    double share = lsf_renderer_get_stats(renderer).lost_share;
    lsf_image_destroy(image);
    lsf_renderer_destroy(renderer);
    lsf_context_destroy(context);
    destroy_scene(scene);
    return share;
}

static void vanishes_with_iterations(void **unused)
{
    (void)unused;
    float unbounded, brightest[3];
    assert_true(lost("bidirectional.bound=0", 4, &unbounded) == 0.0);
    double wide = lost("bidirectional.bound=30", 4, &brightest[0]);
    double few = lost("bidirectional.bound=1", 4, &brightest[1]);
    double many = lost("bidirectional.bound=1", 256, &brightest[2]);
    print_message("lost %g with 30 discs' radii, %g and %g with one\n", wide, few, many);
    assert_true(brightest[1] <= unbounded && brightest[0] <= brightest[1]);
    assert_true(wide > few && wide > 0.0);
    assert_true(many < few / 20.0); /* of 64 times as many */
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(vanishes_with_iterations)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
