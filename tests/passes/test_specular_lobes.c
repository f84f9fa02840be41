/* Narrow specular lobes of visible points, which paths through voxels gather: mirrors show lamps
 * and lit walls where they are, and lobes of any width reflect what they should. */
#include <math.h>
#include <string.h>

#include "base/base.h"
#include "render_gl.h"
#include "shared/albedo.h"

static const char *const techniques[] = {"bidirectional", "substitute_tree", "voxel_path"};

static void look(const lsf_scene *scene, const char *technique, uint32_t samples, uint32_t aovs,
                 double rgb[3])
{
    static const char *const options[][3] = {
        {"voxel.resolution=32", "voxel_path.min_samples=64", "voxel_path.max_samples=64"},
        {"voxel.resolution=32", "specular_path.samples=16"}};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    bool own = strcmp(technique, "voxel_path") == 0;
    params.technique = technique;
    params.samples = samples;
    params.bounces = 1;
    params.options = options[!own];
    params.option_count = own ? 3 : 2;
    params.fov_y = 1e-3f;
    params.aovs = aovs;
    lsf_image *image = render_gl_from(scene, params, 8, lsf_f3(-0.75f, 1, 0), lsf_f3(0, 0, 0));
    mean_rgb(image, aovs ? 3 : 0, rgb);
    lsf_image_destroy(image);
}

static lsf_material *build_metal(lsf_scene *scene, float roughness, float size)
{
    lsf_material *metal = build_material(scene, 0.9f, 0.9f, 0.9f);
    metal->metallic = 1.0f;
    metal->roughness = roughness;
    build_floor(scene, 0.0f, size);
    return metal;
}

/* A ceiling of two materials that meet at x = `edge`, red to its left and green to its right. */
static void build_ceiling(lsf_scene *scene, float edge, bool emits)
{
    for (int half = 0; half < 2; half++) {
        lsf_material *wall = build_material(scene, 0, 0, 0);
        if (emits)
            wall->emission[half] = 1.0f;
        else
            wall->base_color[half] = 0.8f;
        float low = half ? edge : -2.0f, high = half ? 2.0f : edge;
        build_quad(scene, lsf_f3(low, 1, -2), lsf_f3(high, 1, -2), lsf_f3(high, 1, 2),
                   lsf_f3(low, 1, 2));
    }
}

/* The view, mirrored by the floor, meets the ceiling at x = 0.75, a voxel and a half from the
 * border of its halves. */
static void check_border(const char *technique, bool emits, int right)
{
    const double voxel = 4.0 / 32.0, mirrored = 0.9 + 0.1 * pow(0.2, 5.0);
    double expected = mirrored * (emits ? 1.0 : 0.8), rgb[3];
    lsf_scene *scene = build_scene();
    build_ceiling(scene, 0.75f + (float)((right ? -1.5 : 1.5) * voxel), emits);
    build_metal(scene, 0.05f, 0.2f);
    if (!emits) /* its irradiance is pi, its light comes past the floor */
        build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(0, 1, 0), 3.1415927f);
    finish_gl_scene(scene);
    look(scene, technique, 4, 0, rgb);
    print_message("%s, %s: %.4f and %.4f, expected %.4f on one\n", technique,
                  emits ? "lamps" : "lit walls", rgb[0], rgb[1], expected);
    assert_true(fabs(rgb[right] - expected) < 0.05 && rgb[!right] < 0.05);
    lsf_scene_destroy(scene);
}

static void mirrors_show_where_things_are(void **unused)
{
    (void)unused;
    for (size_t t = 0; t < LSF_COUNT(techniques); t++)
        for (int emits = 0; emits < 2; emits++)
            for (int right = 0; right < 2; right++)
                check_border(techniques[t], emits, right);
}

/* A black ceiling that ends a voxel and a half to the right of what the view sees in the mirror, or
 * to the left; beyond it is the sky. */
static void check_skyline(const char *technique, bool open, uint32_t samples)
{
    const double voxel = 4.0 / 32.0;
    double expected = open ? 0.9 + 0.1 * pow(0.2, 5.0) : 0.0, rgb[3];
    lsf_scene *scene = build_scene();
    build_material(scene, 0, 0, 0)->specular = 0.0f;
    float edge = 0.75f + (float)((open ? 1.5 : -1.5) * voxel);
    build_quad(scene, lsf_f3(edge, 1, -2), lsf_f3(2, 1, -2), lsf_f3(2, 1, 2), lsf_f3(edge, 1, 2));
    /* A strip at the other end makes the scene 4 wide. */
    build_quad(scene, lsf_f3(-2, 1, -2), lsf_f3(-1.9f, 1, -2), lsf_f3(-1.9f, 1, 2),
               lsf_f3(-2, 1, 2));
    build_metal(scene, 0.05f, 0.2f);
    build_environment(scene, 1.0f);
    finish_gl_scene(scene);
    look(scene, technique, samples, 0, rgb);
    print_message("%s, sky, %u iterations: %.4f, expected %.4f\n", technique, samples, rgb[0],
                  expected);
    assert_true(fabs(rgb[0] - expected) < 0.05);
    lsf_scene_destroy(scene);
}

static void mirrors_show_the_sky_where_it_is(void **unused)
{
    (void)unused;
    for (size_t t = 0; t < LSF_COUNT(techniques); t++)
        for (int open = 0; open < 2; open++)
            for (uint32_t samples = 1; samples <= 32; samples *= 32)
                check_skyline(techniques[t], open, samples);
}

/* A metal inside a lamp that shines from all sides. */
static lsf_scene *metal_in_light(float roughness, bool layered)
{
    lsf_scene *scene = build_scene();
    lsf_material *shining = build_material(scene, 0, 0, 0);
    shining->emission[0] = 1.0f;
    shining->specular = 0.0f;
    lsf_node *lamp = build_sphere(scene, 5, true);
    for (int c = 0; c < 3; c++)
        lamp->scale[c] = 3.0;
    lsf_material *metal = build_metal(scene, roughness, 0.5f);
    if (layered) {
        metal->coat = 1.0f;
        metal->coat_roughness = 0.1f;
        metal->sheen_color[0] = 0.5f;
        metal->sheen_roughness = 0.4f;
        metal->anisotropy_strength = 0.5f;
    }
    finish_gl_scene(scene);
    return scene;
}

/* The metal reflects its lobe's albedo, whatever share of it paths have, in the layer of direct
 * light, too, where the technique has one. */
static void lobes_reflect_their_albedo(void **unused)
{
    (void)unused;
    static const float roughnesses[] = {0.1f, 0.5f};
    for (size_t t = 0; t < LSF_COUNT(techniques); t++)
        for (size_t k = 0; k < LSF_COUNT(roughnesses); k++) {
            lsf_scene *scene = metal_in_light(roughnesses[k], false);
            double rgb[3], expected = (double)lsf_specular_albedo(0.9f, 1.0f, 0.8f, roughnesses[k]);
            uint32_t layers = strcmp(techniques[t], "substitute_tree") != 0;
            for (uint32_t layer = 0; layer <= layers; layer++) {
                look(scene, techniques[t], 32, layer ? LSF_AOV_DIRECT : 0, rgb);
                print_message("%s, roughness %.2f%s: %.4f, expected %.4f\n", techniques[t],
                              (double)roughnesses[k], layer ? ", direct" : "", rgb[0], expected);
                assert_true(fabs(rgb[0] / expected - 1.0) < 0.02);
            }
            lsf_scene_destroy(scene);
        }
}

/* Coats, sheens and anisotropic lobes reflect as much by their paths as by those of voxel_path. */
static void layers_reflect_as_with_voxel_path(void **unused)
{
    (void)unused;
    static const float roughnesses[] = {0.1f, 0.35f};
    for (size_t k = 0; k < LSF_COUNT(roughnesses); k++) {
        lsf_scene *scene = metal_in_light(roughnesses[k], true);
        double expected[3], rgb[3];
        look(scene, "voxel_path", 32, 0, expected);
        for (size_t t = 0; t < 2; t++) {
            look(scene, techniques[t], 32, 0, rgb);
            print_message("%s, roughness %.2f: %.4f, expected %.4f\n", techniques[t],
                          (double)roughnesses[k], rgb[0], expected[0]);
            assert_true(fabs(rgb[0] / expected[0] - 1.0) < 0.01);
        }
        lsf_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mirrors_show_where_things_are),
        cmocka_unit_test(mirrors_show_the_sky_where_it_is),
        cmocka_unit_test(lobes_reflect_their_albedo),
        cmocka_unit_test(layers_reflect_as_with_voxel_path),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
