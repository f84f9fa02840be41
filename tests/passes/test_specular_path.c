/* Light through surfaces to the eye: media by each technique that refracts them, against closed
 * forms; all else by paths through voxels, against the integrals that
 * tests/reference/test_transmission.c has for rough surfaces, and by its rules. */
#include <math.h>
#include <string.h>

#include "base/base.h"
#include "render_gl.h"

static const char *const techniques[] = {"voxel_path", "bidirectional", "cone", "substitute_tree"};

/* Side of a picture through a needle: many paths an iteration. */
enum { NEEDLE = 8 };

static void look(const lsf_scene *scene, const char *technique, uint32_t samples, uint32_t bounces,
                 uint32_t size, lsf_float3 eye, lsf_float3 target, double rgb[3])
{
    static const char *const options[][3] = {
        {"voxel.resolution=32", "voxel_path.min_samples=64", "voxel_path.max_samples=64"},
        {"voxel.resolution=32", "specular_path.samples=16"}};
    bool paths = strcmp(technique, "voxel_path") == 0;
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = technique;
    params.samples = samples;
    params.bounces = bounces;
    params.options = options[!paths];
    params.option_count = paths ? 3 : 2;
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

/* Smooth white glass in a white world cannot be seen, but for paths that end within it. Thin walls
 * are in the picture by chance, which takes more iterations. */
static void white_glass(void **unused)
{
    (void)unused;
    static const float iors[] = {0.0f, 1.5f};
    for (size_t t = 0; t < LSF_COUNT(techniques); t++)
        for (size_t k = 0; k < LSF_COUNT(iors); k++) {
            lsf_scene *scene = white_world();
            build_glass(scene, 1.0f, 0.0f, iors[k]);
            build_sphere(scene, 4, false);
            finish_gl_scene(scene);
            double rgb[3];
            look(scene, techniques[t], k == 0 ? 16 : 2, 16, 12, lsf_f3(0, 0, 3), lsf_f3(0, 0, 0),
                 rgb);
            print_message("%s, ior %.1f: %.5f\n", techniques[t], (double)iors[k], rgb[0]);
            assert_true(fabs(rgb[0] - 1.0) < 0.01);
            lsf_scene_destroy(scene);
        }
}

/* Two lamps that meet at x = `edge`, red to its left and green to its right. */
static void build_lamps(lsf_scene *scene, float edge, float height)
{
    for (int half = 0; half < 2; half++) {
        lsf_material *lamp = build_material(scene, 0, 0, 0);
        lamp->emission[half] = 1.0f;
        float low = half ? edge : -2.0f, high = half ? 2.0f : edge;
        build_quad(scene, lsf_f3(low, height, 2), lsf_f3(high, height, 2), lsf_f3(high, height, -2),
                   lsf_f3(low, height, -2));
    }
}

/* Through a slab onto a lamp of two halves: the border is seen where Snell's law says, to a voxel.
 */
static void check_border(const char *technique, double thickness, int right)
{
    const double ior = 1.5, voxel = 4.0 / 32.0, f0 = 0.04;
    double inside = asin(0.6 / ior), pass = pow((1.0 - f0) * (1.0 - pow(0.2, 5.0)), 2.0);
    double crossing = thickness * tan(inside) + (1.0 - thickness) * 0.75;
    lsf_scene *scene = build_scene();
    build_lamps(scene, (float)(crossing + (right ? -1.5 : 1.5) * voxel), -1.0f);
    build_glass(scene, 1.0f, 0.0f, (float)ior);
    build_box(scene, lsf_f3(-2, (float)-thickness, -2), lsf_f3(2, 0, 2), false);
    finish_gl_scene(scene);
    double rgb[3];
    look(scene, technique, 16, 2, NEEDLE, lsf_f3(-0.75f, 1, 0), lsf_f3(0, 0, 0), rgb);
    print_message("%s, %.2f thick: %.4f and %.4f, expected %.4f on one\n", technique, thickness,
                  rgb[0], rgb[1], pass);
    assert_true(fabs(rgb[right] - pass) < 0.05 && rgb[!right] < 0.05);
    lsf_scene_destroy(scene);
}

/* The thin slab lies along the grid, so that its far side is missing in some grids. */
static void slab_displaces(void **unused)
{
    (void)unused;
    for (size_t t = 0; t < LSF_COUNT(techniques); t++)
        for (int right = 0; right < 2; right++) {
            check_border(techniques[t], 0.5, right);
            check_border(techniques[t], 0.03, right);
        }
}

/* A hollow ball whose wall is half a voxel thick bends nothing: what is behind is seen where it is.
 * Of N interfaces that reflect f, in any order, (1 - f) / (1 + (N - 1) f) is left. */
static void thin_wall_bends_nothing(void **unused)
{
    (void)unused;
    const double voxel = 4.0 / 32.0, f = 0.04, pass = (1.0 - f) / (1.0 + 3.0 * f);
    for (size_t t = 0; t < LSF_COUNT(techniques); t++)
        for (int right = 0; right < 2; right++) {
            lsf_scene *scene = build_scene();
            const float x = 0.3f;
            build_lamps(scene, x + (float)((right ? -2.0 : 2.0) * voxel), -1.5f);
            build_glass(scene, 1.0f, 0.0f, 1.5f);
            build_sphere(scene, 5, false);
            lsf_node *inner = build_sphere(scene, 5, true);
            for (int c = 0; c < 3; c++)
                inner->scale[c] = 1.0 - 0.5 * voxel;
            finish_gl_scene(scene);
            double rgb[3];
            look(scene, techniques[t], 16, 7, NEEDLE, lsf_f3(x, 3, 0.2f), lsf_f3(x, 0, 0.2f), rgb);
            print_message("%s: %.4f and %.4f, expected %.4f on one\n", techniques[t], rgb[0],
                          rgb[1], pass);
            assert_true(fabs(rgb[right] - pass) < 0.02 && rgb[!right] < 0.02);
            lsf_scene_destroy(scene);
        }
}

/* A slab that absorbs, seen straight on in a white world; voxels are 0.53 wide. */
static void check_slab(const char *technique, float thickness)
{
    const float ior = 1.5f;
    lsf_scene *scene = white_world();
    lsf_material *glass = build_glass(scene, 1.0f, 0.0f, ior);
    glass->attenuation_distance = 2.5f;
    glass->attenuation_color[0] = 0.0f;
    glass->attenuation_color[1] = 0.5f;
    build_box(scene, lsf_f3(-8, -thickness, -8), lsf_f3(8, 0, 8), false);
    finish_gl_scene(scene);
    double rgb[3], f = pow(((double)ior - 1.0) / ((double)ior + 1.0), 2.0);
    look(scene, technique, 4, 8, NEEDLE, lsf_f3(0, 4, 0), lsf_f3(0.001f, 0, 0.001f), rgb);
    const double left[3] = {0.0, pow(0.5, (double)thickness / 2.5), 1.0};
    for (int c = 0; c < 3; c++) {
        double a = left[c], pass = (1.0 - f) * (1.0 - f);
        double expected = f + pass * (a + f * a * a) / (1.0 - f * f * a * a);
        print_message("%s, %.1f thick, channel %d: %.5f, expected %.5f\n", technique,
                      (double)thickness, c, rgb[c], expected);
        assert_true(fabs(rgb[c] - expected) < 0.01);
    }
    lsf_scene_destroy(scene);
}

/* The others' bundles and directions find what the surface itself reflects in too few iterations.
 */
static void slabs_absorb(void **unused)
{
    (void)unused;
    check_slab("voxel_path", 3.0f);
    check_slab("voxel_path", 0.5f);
    check_slab("cone", 3.0f);
    check_slab("cone", 0.5f);
}

/* A slab thinner than a voxel, colored on one side alone, seen straight on in a white world: each
 * side tints what passes it once. */
static void check_tint(const char *technique, bool above)
{
    static const uint8_t texels[2][3] = {{64, 128, 255}, {255, 255, 255}};
    const double ior = 1.5, f = pow((ior - 1.0) / (ior + 1.0), 2.0), pass = 1.0 - f;
    lsf_scene *scene = white_world();
    lsf_material *glass = build_glass(scene, 1.0f, 0.0f, (float)ior);
    glass->base_color_texture.texture = build_texture(scene, 2, 1, 3, texels[0], false);
    scene->textures[0].nearest = true;
    build_box(scene, lsf_f3(-8, -0.2f, -8), lsf_f3(8, 0, 8), false);
    scene->vertices.uv0 = calloc(2 * scene->vertices.count, sizeof(float));
    for (uint64_t i = 0; i < scene->vertices.count; i++)
        scene->vertices.uv0[2 * i] =
            (scene->vertices.position[3 * i + 1] > -0.1f) == above ? 0.25f : 0.75f;
    finish_gl_scene(scene);
    double rgb[3];
    look(scene, technique, 64, 7, NEEDLE, lsf_f3(0, 3, 0), lsf_f3(0, 0, 0), rgb);
    for (int c = 0; c < 3; c++) {
        double colors[2] = {texels[0][c] / 255.0, 1.0}, a = colors[!above], b = colors[above];
        double expected = f + pass * pass * a * (b + f * a) / (1.0 - f * f);
        print_message("%s, colored %s, channel %d: %.5f, expected %.5f\n", technique,
                      above ? "above" : "below", c, rgb[c], expected);
        assert_true(fabs(rgb[c] - expected) < 0.01);
    }
    lsf_scene_destroy(scene);
}

static void each_side_tints_once(void **unused)
{
    (void)unused;
    for (int above = 0; above < 2; above++) {
        check_tint("voxel_path", above);
        check_tint("cone", above);
    }
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
        look(scene, "voxel_path", 8, 0, NEEDLE, lsf_f3(x, y, 0), lsf_f3(0, 0, 0), rgb);
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
            look(scene, "voxel_path", 4, mirrored, NEEDLE, lsf_f3(0.3f, 1, 0.1f), target,
                 rgb[mirrored][half]);
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
        cmocka_unit_test(white_glass),
        cmocka_unit_test(slab_displaces),
        cmocka_unit_test(thin_wall_bends_nothing),
        cmocka_unit_test(slabs_absorb),
        cmocka_unit_test(each_side_tints_once),
        cmocka_unit_test(rough_surfaces),
        cmocka_unit_test(diffuse_share),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
