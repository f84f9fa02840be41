/* A sheet that a morph target shifts, or joints carry, looks as one that its node carries: the same
 * picture and the same motion. */
#include <math.h>

#include "base/base.h"
#include "render_gl.h"

enum { SIZE = 32, CHANNELS = 5 }; /* the picture and its motion */

typedef enum mover { BY_NODE, BY_TARGET, BY_JOINTS } mover;

/* Carries a joint by the shift from where it is. */
static void carry(lsf_scene *scene, uint32_t node, const float shift[3])
{
    const double *from = scene->nodes[node].translation;
    float values[6];
    for (int c = 0; c < 3; c++) {
        values[c] = (float)from[c];
        values[3 + c] = (float)from[c] + shift[c];
    }
    build_channel(scene, node, LSF_PATH_TRANSLATION, values, sizeof values);
}

static lsf_image *render(mover by, const char *technique)
{
    static const float weights[2] = {0, 1}, shift[3] = {0.75f, 0.25f, 0.5f};
    static const char *const options[] = {"gbuffer.frame_time=0.25", "voxel.resolution=32"};
    lsf_scene *scene = build_scene();
    build_corner(scene);
    build_material(scene, 0.3f, 0.8f, 0.4f);
    build_quad(scene, lsf_f3(-1.5f, 0.25f, 0.5f), lsf_f3(-0.5f, 0.25f, 0.5f),
               lsf_f3(-0.5f, 1.25f, 0.25f), lsf_f3(-1.5f, 1.25f, 0.25f));
    uint32_t sheet = scene->node_count - 1, joint = 0;
    if (by != BY_NODE)
        joint = build_deformer(scene, lsf_f3(shift[0], shift[1], shift[2]));
    if (by == BY_NODE)
        carry(scene, sheet, shift);
    if (by == BY_TARGET)
        build_channel(scene, sheet, LSF_PATH_WEIGHTS, weights, sizeof weights);
    for (uint32_t i = 0; by == BY_JOINTS && i < 2; i++)
        carry(scene, joint - i, shift);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
    finish_gl_scene(scene);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS,
                                .raw = true,
                                .technique = technique,
                                .samples = 4,
                                .bounces = 1,
                                .aovs = LSF_AOV_MOTION,
                                .time = 0.5,
                                .options = options,
                                .option_count = LSF_COUNT(options)};
    lsf_image *image = render_corner(scene, params, SIZE);
    lsf_scene_destroy(scene);
    return image;
}

/* Positions are rounded otherwise, so that few pixels at edges differ. */
static void assert_alike(const lsf_image *image, const lsf_image *expected, const char *technique)
{
    uint32_t apart = 0, moving = 0;
    size_t last = 0;
    assert_int_equal(image->channel_count, CHANNELS);
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
        const float *a = image->pixels + CHANNELS * i, *b = expected->pixels + CHANNELS * i;
        bool near = true;
        for (int c = 0; c < CHANNELS; c++)
            near = near && fabsf(a[c] - b[c]) <= 1e-3f * (1.0f + fabsf(b[c]));
        apart += !near;
        last = near ? last : CHANNELS * i;
        moving += fabsf(b[3]) > 0.1f;
    }
    assert_true(moving > 30);
    if (apart > 4)
        fail_msg("%s: %u pixels differ, the last is %g %g %g, moved by %g %g, expected %g %g %g, "
                 "moved by %g %g",
                 technique, apart, image->pixels[last], image->pixels[last + 1],
                 image->pixels[last + 2], image->pixels[last + 3], image->pixels[last + 4],
                 expected->pixels[last], expected->pixels[last + 1], expected->pixels[last + 2],
                 expected->pixels[last + 3], expected->pixels[last + 4]);
}

static void test_moved_alike(void **unused)
{
    (void)unused;
    static const char *const techniques[] = {"direct", "bidirectional", "voxel_path",
                                             "substitute_tree"};
    for (size_t t = 0; t < LSF_COUNT(techniques); t++) {
        lsf_image *expected = render(BY_NODE, techniques[t]);
        for (mover by = BY_TARGET; by <= BY_JOINTS; by++) {
            lsf_image *image = render(by, techniques[t]);
            assert_alike(image, expected, techniques[t]);
            lsf_image_destroy(image);
        }
        lsf_image_destroy(expected);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_moved_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
