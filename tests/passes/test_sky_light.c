/* Light of environments: directions drawn by radiance, against quadrature and in each technique. */
#include <math.h>

#include "base/base.h"
#include "math/sampling.h"
#include "render_gl.h"
#include "scene/environment.h"
#include "scene/sky.h"
#include "shared/brdf.h"

enum { WIDTH = 32, HEIGHT = 16, SUN_COLUMN = 20, SUN_ROW = 4 };

/* A gradient with a sun of one texel, which has most of the light. */
static void add_sky(lsf_scene *scene, float sun)
{
    float *texels = build_environment_map(scene, WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        for (int c = 0; c < 3; c++)
            texels[3 * i + c] = 0.3f + 0.02f * (float)(c * (HEIGHT - i / WIDTH));
    for (int c = 0; c < 3; c++)
        texels[3 * (SUN_ROW * WIDTH + SUN_COLUMN) + c] = sun;
}

/* Irradiance of a plane by midpoints of 16 x 16 parts of each texel. */
static void quadrature(const lsf_environment *sky, lsf_float3 normal, double irradiance[3])
{
    enum { PARTS = 16 };
    irradiance[0] = irradiance[1] = irradiance[2] = 0.0;
    for (int y = 0; y < PARTS * HEIGHT; y++) {
        double theta = M_PI * (y + 0.5) / (PARTS * HEIGHT);
        double solid_angle =
            lsf_environment_cell_solid_angle(PARTS * WIDTH, PARTS * HEIGHT, (uint32_t)y);
        for (int x = 0; x < PARTS * WIDTH; x++) {
            lsf_float3 d = lsf_environment_direction(sky, (x + 0.5) / (PARTS * WIDTH), cos(theta));
            double weight = fmax((double)lsf_f3_dot(d, normal), 0.0) * solid_angle;
            lsf_float3 radiance = lsf_environment_radiance(sky, d);
            irradiance[0] += weight * (double)radiance.x;
            irradiance[1] += weight * (double)radiance.y;
            irradiance[2] += weight * (double)radiance.z;
        }
    }
}

/* A tilted plane, seen from above; no light but the sky reaches it. */
static lsf_scene *plane_scene(lsf_float3 *normal)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_quad(scene, lsf_f3(-2, -0.5f, 2), lsf_f3(2, 0.5f, 2), lsf_f3(2, 0.5f, -2),
               lsf_f3(-2, -0.5f, -2));
    scene->diffuse_only = true;
    *normal = lsf_f3_normalize(lsf_f3(-0.25f, 1, 0));
    return scene;
}

/* The radiance of the plane's middle. */
static void render_plane(const lsf_scene *scene, const char *technique, uint32_t samples,
                         float rgb[3])
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    const char *const options[] = {"voxel.resolution=16", "environment.directions=16",
                                   "cloud.count=8192"};
    params.technique = technique;
    params.samples = samples;
    params.bounces = 0;
    params.fov_y = 1.0f;
    params.options = options;
    params.option_count = LSF_COUNT(options);
    lsf_image *image =
        render_gl_from(scene, params, 2, lsf_f3(0.3f, 3, 0.2f), lsf_f3(0.01f, 0, 0.02f));
    for (int c = 0; c < 3; c++)
        rgb[c] = image->pixels[c];
    lsf_image_destroy(image);
}

static void expect_plane(const lsf_scene *scene, lsf_float3 normal, const char *technique,
                         uint32_t samples, double allowed)
{
    double irradiance[3];
    float rgb[3];
    quadrature(&scene->environment, normal, irradiance);
    render_plane(scene, technique, samples, rgb);
    for (int c = 0; c < 3; c++) {
        double expected = 0.5 / M_PI * irradiance[c];
        print_message("%s: %.5f, expected %.5f\n", technique, (double)rgb[c], expected);
        assert_true(fabs((double)rgb[c] / expected - 1.0) <= allowed);
    }
}

/* With and without a sun in it, and turned. */
static void plane_under_a_map(void **unused)
{
    (void)unused;
    const struct {
        float sun, u_offset;
    } cases[] = {{0.5f, 0.0f}, {3000.0f, 0.3f}};
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_float3 normal;
        lsf_scene *scene = plane_scene(&normal);
        add_sky(scene, cases[i].sun);
        scene->environment.u_offset = cases[i].u_offset;
        finish_gl_scene(scene);
        expect_plane(scene, normal, "direct", 1024, 1e-3);
        expect_plane(scene, normal, "bidirectional", 128, 1e-2);
        expect_plane(scene, normal, "voxel_path", 128, 1e-2);
        expect_plane(scene, normal, "cone", 128, 1e-2);
        destroy_scene(scene);
    }
}

/* Directions of a uniform environment; a plane reflects its albedo of it. */
static void plane_under_a_constant(void **unused)
{
    (void)unused;
    lsf_float3 normal;
    lsf_scene *scene = plane_scene(&normal);
    build_environment(scene, 2.0f);
    finish_gl_scene(scene);
    const char *const techniques[] = {"direct", "bidirectional", "voxel_path", "cone",
                                      "substitute_tree"};
    for (size_t i = 0; i < LSF_COUNT(techniques); i++) {
        float rgb[3];
        render_plane(scene, techniques[i], 256, rgb);
        print_message("%s: %.5f, expected 1\n", techniques[i], (double)rgb[0]);
        assert_true(fabs((double)rgb[0] - 1.0) <= 1e-3);
    }
    destroy_scene(scene);
}

/* The integral of F D V cos over the hemisphere, by half vectors: tan^2 of their angle is alpha^2 u
 * / (1 - u). */
static double specular_albedo(double f0, double roughness, double nv)
{
    enum { SIDE = 400 };
    double alpha = roughness * roughness, sum = 0.0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        double u = (i % SIDE + 0.5) / SIDE, phi = 2.0 * M_PI * (i / SIDE + 0.5) / SIDE;
        double nh = sqrt((1.0 - u) / (1.0 - u + alpha * alpha * u));
        double vh = sqrt(1.0 - nv * nv) * sqrt(1.0 - nh * nh) * cos(phi) + nv * nh;
        double nl = 2.0 * vh * nh - nv;
        if (vh <= 0.0 || nl <= 0.0)
            continue;
        double fresnel = f0 + (1.0 - f0) * pow(1.0 - vh, 5.0);
        sum += fresnel * (double)lsf_ggx_v((float)nl, (float)nv, (float)alpha) * nl * 4.0 * vh / nh;
    }
    return sum / (SIDE * SIDE);
}

/* A lobe that is widened for few directions reflects as much as the narrow one: a black dielectric
 * and white metal, seen from 75 degrees. */
static void glossy_plane_under_a_constant(void **unused)
{
    (void)unused;
    enum { SEEDS = 4 };
    const struct {
        float f0;
        double allowed;
    } cases[] = {{0.04f, 0.1}, {1.0f, 0.05}};
    const float cosine = 0.26f, roughness = 0.2f;
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_scene *scene = build_scene();
        float metallic = cases[i].f0 < 1.0f ? 0.0f : 1.0f;
        lsf_material *material = build_material(scene, metallic, 0, 0);
        material->roughness = roughness;
        material->metallic = metallic;
        build_floor(scene, 0.0f, 1.0f);
        build_environment(scene, 1.0f);
        finish_gl_scene(scene);
        const char *const techniques[] = {"direct", "bidirectional"};
        for (size_t t = 0; t < LSF_COUNT(techniques); t++) {
            double mean = 0.0;
            double expected =
                specular_albedo((double)cases[i].f0, (double)roughness, (double)cosine);
            for (uint64_t seed = 0; seed < SEEDS; seed++) {
                lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
                params.technique = techniques[t];
                params.samples = 64;
                params.bounces = 0;
                params.fov_y = 1.0f;
                params.seed = seed;
                lsf_float3 eye = lsf_f3(0.1f, 3.0f * cosine, 3.0f * sqrtf(1.0f - cosine * cosine));
                lsf_image *image = render_gl_from(scene, params, 2, eye, lsf_f3(0.1f, 0, 0));
                mean += (double)image->pixels[0] / SEEDS;
                lsf_image_destroy(image);
            }
            print_message("%s: %.5f, expected %.5f\n", techniques[t], mean, expected);
            assert_true(fabs(mean / expected - 1.0) <= cases[i].allowed);
        }
        destroy_scene(scene);
    }
}

/* A quarter turn, anticlockwise seen from above, takes what was at +x to -z. */
static void quarter_turn(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    add_sky(scene, 100.0f);
    lsf_environment *sky = &scene->environment;
    for (int i = 0; i < 8; i++) {
        float angle = 0.7f * (float)i;
        lsf_float3 before = lsf_f3(cosf(angle), 0.4f, -sinf(angle));
        lsf_float3 after = lsf_f3(before.z, 0.4f, -before.x);
        sky->u_offset = 0.0f;
        lsf_float3 expected = lsf_environment_radiance(sky, lsf_f3_normalize(before));
        sky->u_offset = 0.25f;
        lsf_float3 turned = lsf_environment_radiance(sky, lsf_f3_normalize(after));
        assert_true(fabs((double)(turned.x / expected.x) - 1.0) <= 1e-4);
    }
    destroy_scene(scene);
}

/* What is drawn has the density that is said, which integrates to 1: over what is drawn, the mean
 * of 1 / p where a direction lies in a texel is the texel's solid angle. */
static void drawn_as_dense(void **unused)
{
    (void)unused;
    enum { COUNT = 1 << 19, TEXELS = WIDTH * HEIGHT };
    lsf_scene *scene = build_scene();
    add_sky(scene, 10.0f);
    lsf_environment *map = &scene->environment;
    map->u_offset = 0.1f;
    lsf_sky sky;
    assert_true(lsf_sky_init(&sky, map));
    double means[TEXELS] = {0.0}, sum = 0.0;
    for (uint32_t i = 0; i < COUNT; i++) {
        uint32_t bits[2];
        lsf_sobol_2d_bits(i, 1, bits);
        const double u[2] = {lsf_unit_double(bits[0]), lsf_unit_double(bits[1])};
        double x, y;
        float pdf;
        lsf_float3 d = lsf_sky_sample(&sky, u, &pdf);
        lsf_environment_uv(map, d, &x, &y);
        int texel = (y < 1.0 ? (int)(y * HEIGHT) : HEIGHT - 1) * WIDTH + (int)(x * WIDTH);
        means[texel] += 1.0 / (double)pdf / COUNT;
    }
    for (int i = 0; i < TEXELS; i++) {
        double expected = lsf_environment_cell_solid_angle(WIDTH, HEIGHT, (uint32_t)(i / WIDTH));
        assert_true(fabs(means[i] / expected - 1.0) <= 0.06);
        sum += means[i];
    }
    assert_true(fabs(sum / (4.0 * M_PI) - 1.0) <= 1e-3);
    lsf_sky_finish(&sky);
    destroy_scene(scene);
}

/* Rows of black and white, seen through a needle, as the host interpolates them. */
static void seen_where_it_is(void **unused)
{
    (void)unused;
    enum { COLUMNS = 4, ROWS = 512 };
    lsf_scene *scene = build_scene();
    lsf_environment *sky = &scene->environment;
    float *texels = build_environment_map(scene, COLUMNS, ROWS);
    for (int i = 0; i < 3 * COLUMNS * ROWS; i++)
        texels[i] = (float)(i / (3 * COLUMNS) % 2);
    finish_gl_scene(scene);
    for (int i = 0; i < 8; i++) {
        float elevation = 0.37f * (float)i - 1.3f, rgb[3];
        lsf_float3 d = lsf_f3(cosf(elevation), sinf(elevation), 0.1f);
        render_gl_point(scene, lsf_f3(0, 0, 0), d, 1, rgb);
        lsf_float3 expected = lsf_environment_radiance(sky, lsf_f3_normalize(d));
        print_message("%.4f, expected %.4f\n", (double)rgb[0], (double)expected.x);
        assert_true(fabsf(rgb[0] - expected.x) <= 0.003f);
    }
    destroy_scene(scene);
}

/* Black maps draw nothing and light nothing. */
static void black_map(void **unused)
{
    (void)unused;
    const char *const techniques[] = {"direct", "bidirectional", "voxel_path", "cone",
                                      "substitute_tree"};
    lsf_float3 normal;
    lsf_scene *scene = plane_scene(&normal);
    add_sky(scene, 0.0f);
    memset(scene->environment.texels, 0, 3 * WIDTH * HEIGHT * sizeof(float));
    finish_gl_scene(scene);
    for (size_t i = 0; i < LSF_COUNT(techniques); i++) {
        float rgb[3];
        render_plane(scene, techniques[i], 2, rgb);
        assert_true(rgb[0] == 0.0f && rgb[1] == 0.0f && rgb[2] == 0.0f);
    }
    destroy_scene(scene);
}

/* Light of the sky once reflected, in a corner with a glossy box, against the path tracer. */
static void corner_in_each_technique(void **unused)
{
    (void)unused;
    enum { SIZE = 24 };
    const struct {
        const char *technique;
        uint32_t samples;
        double allowed;
    } cases[] = {{"bidirectional", 128, 0.02},
                 {"voxel_path", 64, 0.03},
                 {"cone", 64, 0.03},
                 {"substitute_tree", 40, 0.03}};
    const char *const options[] = {"environment.directions=16", "voxel.resolution=48",
                                   "bundle.resolution=128",     "rsm.resolution=64",
                                   "vpl.shadow_resolution=64",  "cloud.count=16384"};
    lsf_scene *scene = build_scene();
    build_corner(scene);
    add_sky(scene, 60.0f);
    finish_gl_scene(scene);
    lsf_error error = {0};
    lsf_render_params params =
        corner_params((lsf_render_params){LSF_RENDER_PARAMS_DEFAULTS, .raw = true}, SIZE);
    params.samples = 512;
    lsf_image *truth = lsf_reference_render(scene, &params, 0, NULL, &error);
    if (!truth)
        fail_msg("%s", error.message);
    double expected[3], mean[3];
    mean_rgb(truth, 0, expected);
    params.options = options;
    params.option_count = LSF_COUNT(options);
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        params.technique = cases[i].technique;
        params.samples = cases[i].samples;
        lsf_image *image = render_gl(gl_test_backend(), scene, &params);
        mean_rgb(image, 0, mean);
        print_message("%s: %.5f, expected %.5f\n", cases[i].technique, mean[1], expected[1]);
        for (int c = 0; c < 3; c++)
            assert_true(fabs(mean[c] / expected[c] - 1.0) <= cases[i].allowed);
        lsf_image_destroy(image);
    }
    lsf_image_destroy(truth);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plane_under_a_map),
        cmocka_unit_test(plane_under_a_constant),
        cmocka_unit_test(glossy_plane_under_a_constant),
        cmocka_unit_test(seen_where_it_is),
        cmocka_unit_test(quarter_turn),
        cmocka_unit_test(drawn_as_dense),
        cmocka_unit_test(black_map),
        cmocka_unit_test(corner_in_each_technique),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
