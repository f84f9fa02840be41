/* Voxel path tracing against closed forms and by its rules: furnaces, an open plane, bounces of a
 * point light, the same bits again, extremes. */
#include <math.h>

#include "base/base.h"
#include "light_rules.h"

enum { MAX_OPTIONS = 4 };

static lsf_render_params params_of(uint32_t samples, uint32_t bounces, const char *const *options)
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "voxel_path";
    params.samples = samples;
    params.bounces = bounces;
    params.options = options;
    while (options && params.option_count < MAX_OPTIONS && options[params.option_count])
        params.option_count++;
    return params;
}

static const char *const coarse_grid[MAX_OPTIONS] = {"voxel.resolution=32"};
static const char *const by_texture[MAX_OPTIONS] = {"voxel.resolution=32",
                                                    "voxel_path.sequence=texture"};
static const char *const upsampled[MAX_OPTIONS] = {"voxel.resolution=32", "sparse.grid=2"};
static const char *const blurred[MAX_OPTIONS] = {"voxel.resolution=32", "sparse.blur=5"};

/* Voxels hold albedo in 11 bits and emission in 9. */
static void energy_in_a_furnace(void **unused)
{
    (void)unused;
    static const struct {
        const char *name;
        float albedo;
        uint32_t bounces;
        const char *const *options;
    } cases[] = {
        {"black walls", 0.0f, 1, coarse_grid},   {"no bounce", 0.5f, 0, coarse_grid},
        {"three bounces", 0.5f, 3, coarse_grid}, {"white walls", 1.0f, 1, coarse_grid},
        {"by texture", 0.5f, 2, by_texture},     {"upsampled", 0.5f, 2, upsampled},
        {"blurred", 0.5f, 2, blurred},
    };
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_scene *scene = furnace_scene(cases[i].albedo);
        lsf_image *image = render_gl_from(scene, params_of(16, cases[i].bounces, cases[i].options),
                                          12, lsf_f3(0.2f, 0.1f, 0.7f), lsf_f3(-0.3f, -0.2f, -1));
        assert_mean(cases[i].name, image, furnace_radiance(cases[i].albedo, cases[i].bounces),
                    0.002);
        lsf_image_destroy(image);
        lsf_scene_destroy(scene);
    }
}

/* Nothing stands between an open plane and a constant environment L: its irradiance is pi L, which
 * every single path finds. */
static void open_plane(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_floor(scene, 0.0f, 4.0f);
    scene->diffuse_only = true;
    build_environment(scene, 0.7f);
    finish_gl_scene(scene);
    lsf_image *image =
        render_gl_from(scene, params_of(2, 1, NULL), 16, lsf_f3(0, 1, 0.5f), lsf_f3(0, 0, 0));
    assert_mean("open plane", image, 0.35, 1e-4);
    lsf_image_destroy(image);
    lsf_scene_destroy(scene);
}

/* The sphere's own voxels catch few paths. Facets lie deeper than the sphere by less than a voxel.
 */
static void white_furnace(void **unused)
{
    (void)unused;
    static const char *const fine[MAX_OPTIONS] = {"voxel.resolution=128"};
    lsf_scene *scene = white_sphere_scene(4);
    lsf_image *image =
        render_gl_from(scene, params_of(8, 3, fine), 24, lsf_f3(0, 0, 3), lsf_f3(0, 0, 0));
    assert_mean("white furnace", image, 0.5, 0.01);
    lsf_image_destroy(image);
    lsf_scene_destroy(scene);
}

static void bounces_in_a_sphere(void **unused)
{
    (void)unused;
    static const char *const options[MAX_OPTIONS] = {"voxel.resolution=64"};
    lsf_scene *scene = lit_sphere_scene(0.6f);
    for (uint32_t bounces = 0; bounces <= 4; bounces += 2) {
        lsf_image *image = render_gl_from(scene, params_of(8, bounces, options), 16,
                                          lsf_f3(0, 0, 0.5f), lsf_f3(0.3f, 0.2f, -1));
        assert_mean("sphere", image, lit_sphere_radiance(0.6f, bounces), 0.02);
        lsf_image_destroy(image);
    }
    lsf_scene_destroy(scene);
}

static void same_bits_again(void **unused)
{
    (void)unused;
    static const char *const single[MAX_OPTIONS] = {"voxel.resolution=32", "sparse.grid=2",
                                                    "sparse.blur=5"};
    const char *const *const options[] = {coarse_grid, single};
    lsf_scene *scene = lit_room_scene(1.0f);
    for (int k = 0; k < 2; k++) {
        lsf_render_params params = corner_params(params_of(2, 2, options[k]), 33);
        assert_same_for_any_threads(scene, &params);
    }
    lsf_scene_destroy(scene);
}

static void light_scales(void **unused)
{
    (void)unused;
    assert_light_scales(params_of(2, 2, coarse_grid));
}

/* The layers add up to the picture, and paths of either sequence to the same one. */
static void layers_and_sequences(void **unused)
{
    (void)unused;
    lsf_scene *scene = lit_room_scene(1.0f);
    double sum[2][3];
    for (int k = 0; k < 2; k++) {
        lsf_render_params params = params_of(64, 1, k ? by_texture : coarse_grid);
        params.aovs = LSF_AOV_EMISSION | LSF_AOV_DIRECT | LSF_AOV_INDIRECT_DIFFUSE |
                      LSF_AOV_INDIRECT_SPECULAR;
        lsf_image *image = render_corner(scene, params, 33);
        assert_int_equal(image->channel_count, 15);
        for (int c = 0; c < 3; c++)
            sum[k][c] = 0.0;
        for (uint32_t i = 0; i < image->width * image->height; i++) {
            const float *p = image->pixels + (uint64_t)i * image->channel_count;
            for (int c = 0; c < 3; c++) {
                float parts = p[3 + c] + p[6 + c] + p[9 + c] + p[12 + c];
                assert_true(fabsf(parts - p[c]) <= 1e-5f * (1.0f + p[c]));
                sum[k][c] += (double)p[c];
            }
        }
        lsf_image_destroy(image);
    }
    print_message("sobol %.3f, texture %.3f\n", sum[0][0], sum[1][0]);
    for (int c = 0; c < 3; c++)
        assert_true(fabs(sum[1][c] / sum[0][c] - 1.0) <= 0.01);
    lsf_scene_destroy(scene);
}

/* Two sealed rooms, one of them lit, with a wall of some voxels between them. What of the lit
 * room's light is seen in the dark one. */
static void sealed_room(void **unused)
{
    (void)unused;
    static const float walls[] = {0.5f, 1.0f, 2.0f, 4.0f};
    static const char *const options[MAX_OPTIONS] = {"voxel.resolution=34"};
    for (size_t i = 0; i < LSF_COUNT(walls); i++) {
        float half = 0.5f * walls[i] * 2.0f / 32.0f; /* of a scene 2 wide */
        lsf_scene *scene = build_scene();
        build_material(scene, 0.7f, 0.7f, 0.7f);
        build_box(scene, lsf_f3(-1, -0.5f, -0.5f), lsf_f3(-half, 0.5f, 0.5f), true);
        build_box(scene, lsf_f3(half, -0.5f, -0.5f), lsf_f3(1, 0.5f, 0.5f), true);
        build_light(scene, LSF_LIGHT_POINT, lsf_f3(-0.5f, 0.2f, 0), lsf_f3(0, -1, 0), 1.0f);
        scene->diffuse_only = true;
        finish_gl_scene(scene);
        double lit[3], dark[3];
        for (int room_of = 0; room_of < 2; room_of++) {
            float side = room_of ? 1.0f : -1.0f;
            lsf_image *image = render_gl_from(scene, params_of(8, 4, options), 32,
                                              lsf_f3(0.9f * side, 0.1f, 0.05f), lsf_f3(0, 0, 0));
            mean_rgb(image, 0, room_of ? dark : lit);
            lsf_image_destroy(image);
        }
        print_message("a wall of %g voxels lets %.2e through\n", (double)walls[i],
                      dark[1] / lit[1]);
        /* In a wall thinner than a voxel, one voxel holds what should be three or four surfaces. */
        assert_true(dark[1] <= (walls[i] < 1.0f ? 5e-4 : 1e-4) * lit[1]);
        lsf_scene_destroy(scene);
    }
}

static void every_allocation_may_fail(void **unused)
{
    (void)unused;
    static const char *const options[MAX_OPTIONS] = {
        "voxel.resolution=16", "sparse.grid=2", "sparse.blur=5", "voxel_path.sequence=texture"};
    lsf_scene *scene = lit_room_scene(1.0f);
    assert_every_allocation_may_fail(scene, params_of(1, 1, options), 40);
    lsf_scene_destroy(scene);
}

/* Pictures of 1 x 1 and 7 x 13, an empty scene, one flat triangle, a camera in a surface, a light
 * in a surface. */
static void extremes(void **unused)
{
    (void)unused;
    assert_finite_extremes(params_of(1, 2, coarse_grid), 0.1f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energy_in_a_furnace),
        cmocka_unit_test(open_plane),
        cmocka_unit_test(white_furnace),
        cmocka_unit_test(bounces_in_a_sphere),
        cmocka_unit_test(same_bits_again),
        cmocka_unit_test(light_scales),
        cmocka_unit_test(layers_and_sequences),
        cmocka_unit_test(sealed_room),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(extremes),
    };
    return cmocka_run_group_tests_name("voxel_path", tests, NULL, NULL);
}
