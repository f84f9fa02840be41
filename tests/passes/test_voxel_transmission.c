/* Light through surfaces, as paths through voxels have it, against the integrals that
 * tests/reference/test_transmission.c has for rough surfaces, and by its rules. */
#include <math.h>

#include "base/base.h"
#include "render_gl.h"

/* Side of a picture through a needle: many paths an iteration. */
enum { NEEDLE = 8 };

static void look(const lsf_scene *scene, uint32_t samples, uint32_t bounces, uint32_t size,
                 lsf_float3 eye, lsf_float3 target, double rgb[3])
{
    static const char *const options[] = {"voxel.resolution=32", "voxel_path.min_samples=64",
                                          "voxel_path.max_samples=64"};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "voxel_path";
    params.samples = samples;
    params.bounces = bounces;
    params.options = options;
    params.option_count = LSF_COUNT(options);
    params.fov_y = size == NEEDLE ? 1e-3f : 0.7f;
    lsf_image *image = render_gl_from(scene, params, size, eye, target);
    mean_rgb(image, 0, rgb);
    lsf_image_destroy(image);
}

static lsf_scene *white_world(void)
{
    lsf_scene *scene = build_scene();
    build_environment(scene, 1.0f);
    return scene;
}

/* One surface between two white halves of the world: what reaches the viewer is the integral of f
 * cos over all directions. */
static void rough_surfaces(void **unused)
{
    (void)unused;
    static const struct {
        float roughness, transmission, ior, cosine; /* cosine below 0: from behind */
        double expected;
    } cases[] = {
        {0.5f, 1.0f, 0.0f, 0.8f, 0.81128},
        {0.5f, 1.0f, 1.5f, 0.9f, 0.89491},
        {0.4f, 0.6f, 1.33f, 0.3f, 0.91544},
        {0.4f, 1.0f, 1.5f, -0.7f, 0.90671},
    };
    for (size_t k = 0; k < LSF_COUNT(cases); k++) {
        lsf_scene *scene = white_world();
        build_glass(scene, 0.9f, cases[k].roughness, cases[k].ior)->transmission =
            cases[k].transmission;
        build_floor(scene, 0.0f, 1.0f);
        finish_gl_scene(scene);
        float y = cases[k].cosine, x = sqrtf(1.0f - y * y);
        double rgb[3];
        look(scene, 8, 0, NEEDLE, lsf_f3(x, y, 0), lsf_f3(0, 0, 0), rgb);
        print_message("case %zu: %.5f, expected %.5f\n", k, rgb[0], cases[k].expected);
        assert_true(fabs(rgb[0] / cases[k].expected - 1.0) < 0.005);
        lsf_scene_destroy(scene);
    }
}

/* What is transmitted is not diffuse: a floor under a light keeps a quarter of its diffuse share
 * where a texture says so, and all where it says 0; seen directly, and by way of voxels from a
 * mirror above. */
static void diffuse_share(void **unused)
{
    (void)unused;
    static const uint8_t texels[] = {191, 0};
    double rgb[2][2][3];
    for (int mirrored = 0; mirrored < 2; mirrored++)
        for (int half = 0; half < 2; half++) {
            lsf_scene *scene = build_scene();
            lsf_material *floor = build_material(scene, 0.8f, 0.8f, 0.8f);
            floor->transmission = 1.0f;
            floor->transmission_texture.texture = build_texture(scene, 2, 1, 1, texels, false);
            build_floor(scene, 0.0f, 1.0f);
            scene->vertices.uv0 = calloc(2 * (scene->vertices.count + 6), sizeof(float));
            for (uint64_t i = 0; i < scene->vertices.count; i++)
                scene->vertices.uv0[2 * i] = half ? 0.75f : 0.25f;
            lsf_material *mirror = build_material(scene, 1, 1, 1);
            mirror->metallic = 1.0f;
            mirror->roughness = 0.0f;
            build_quad(scene, lsf_f3(-1, 2, -1), lsf_f3(1, 2, -1), lsf_f3(1, 2, 1),
                       lsf_f3(-1, 2, 1));
            build_light(scene, LSF_LIGHT_POINT, lsf_f3(-0.6f, 1.5f, -0.6f), lsf_f3(0, -1, 0), 1.0f);
            finish_gl_scene(scene);
            lsf_float3 target = mirrored ? lsf_f3(0.05f, 2, 0) : lsf_f3(0.05f, 0, 0);
            look(scene, 4, mirrored, NEEDLE, lsf_f3(0.3f, 1, 0.1f), target, rgb[mirrored][half]);
            lsf_scene_destroy(scene);
        }
    for (int mirrored = 0; mirrored < 2; mirrored++) {
        double ratio = rgb[mirrored][0][0] / rgb[mirrored][1][0];
        print_message("%s: %.4f of the opaque floor\n", mirrored ? "in the mirror" : "seen", ratio);
        /* Of the floor's light a part is its reflection, which stays. */
        assert_true(fabs(ratio - (1.0 - 191.0 / 255.0)) < 0.02);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rough_surfaces),
        cmocka_unit_test(diffuse_share),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
