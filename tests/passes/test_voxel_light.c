/* Light of voxels against closed forms. */
#include <math.h>

#include "base/base.h"
#include "shared/brdf.h"
#include "voxel_rig.h"

static lsf_scene *lit_floor(lsf_light_type type, float intensity)
{
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.5f, 0.25f, 0.75f);
    build_floor(scene, 0.0f, 2.0f);
    build_light(scene, type, lsf_f3(0.3f, 1.0f, 0.2f), lsf_f3(0.6f, -0.8f, 0.0f), intensity);
    finish_gl_scene(scene);
    return scene;
}

/* Irradiance of the floor. */
static double expected_irradiance(lsf_light_type type, double x, double z, double intensity)
{
    if (type == LSF_LIGHT_DIRECTIONAL)
        return 0.8 * intensity;
    double d2 = (x - 0.3) * (x - 0.3) + 1.0 + (z - 0.2) * (z - 0.2);
    return intensity / (d2 * sqrt(d2));
}

static void check_floor(lsf_light_type type, float intensity)
{
    static const double albedo[3] = {0.5, 0.25, 0.75};
    lsf_scene *scene = lit_floor(type, intensity);
    voxel_rig v;
    voxel_rig_init(&v, scene, 128, LSF_VOXELIZE_COMPUTE, false, LSF_VOXEL_SIDES_SURFACE);
    voxel_rig_run(&v, 0);
    float *radiance = voxel_rig_read_radiance(&v);
    const struct lsf_voxel_grid_data grid = lsf_voxel_grid_data(&v.grid, &v.iteration);
    size_t back = voxel_rig_voxel_count(&v);
    for (float x = -1.5f; x <= 1.5f; x += 0.25f)
        for (float z = -1.5f; z <= 1.5f; z += 0.25f) {
            size_t voxel = voxel_rig_voxel_at(&v, lsf_f3(x, 0.0f, z));
            size_t size = v.grid.size[0];
            /* Lit at the point of the surface nearest to the voxel's centre. */
            double to_scene = 1.0 / v.setup.state.scale;
            double at_x =
                ((double)grid.origin.x + ((double)(voxel % size) + 0.5) * (double)grid.origin.w) *
                    to_scene +
                v.setup.state.center[0];
            double at_z = ((double)grid.origin.z + ((double)(voxel / size / v.grid.size[1]) + 0.5) *
                                                       (double)grid.origin.w) *
                              to_scene +
                          v.setup.state.center[2];
            double irradiance = expected_irradiance(type, at_x, at_z, (double)intensity);
            for (int c = 0; c < 3; c++) {
                double expected = albedo[c] * irradiance / (double)LSF_PI;
                assert_true(fabs((double)radiance[4 * voxel + c] - expected) <= 4e-3 * expected);
                assert_true(radiance[4 * (back + voxel) + c] == 0.0f);
            }
        }
    free(radiance);
    voxel_rig_finish(&v);
    destroy_scene(scene);
}

static void floor_in_closed_form(void **unused)
{
    (void)unused;
    check_floor(LSF_LIGHT_POINT, 3.0f);
    check_floor(LSF_LIGHT_DIRECTIONAL, 3.0f);
    /* The unit follows the light. */
    check_floor(LSF_LIGHT_POINT, 3e10f);
    check_floor(LSF_LIGHT_POINT, 3e-10f);
}

/* What a surface of f0 = `f0` at the front and 1 at grazing angles reflects of light under that
 * cosine, by its specular lobe, and what it leaves of a diffuse one of 1: by quadrature over the
 * other direction. */
static void reflected_share(double f0, double roughness, double cosine, double *specular,
                            double *diffuse)
{
    const int steps = 600;
    double alpha = fmax(roughness * roughness, 0.001), sine = sqrt(1.0 - cosine * cosine);
    *specular = *diffuse = 0.0;
    for (int i = 0; i < steps; i++)
        for (int k = 0; k < steps; k++) {
            double nl = sqrt((i + 0.5) / steps), s = sqrt(1.0 - nl * nl);
            double turn = 2.0 * M_PI * (k + 0.5) / steps;
            double h[3] = {sine + s * cos(turn), s * sin(turn), cosine + nl};
            double length = sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
            double nh = h[2] / length, vh = (sine * h[0] + cosine * h[2]) / length;
            double fresnel = f0 + (1.0 - f0) * pow(1.0 - vh, 5.0);
            double d = (double)lsf_ggx_d((float)nh, (float)(1.0 - nh * nh), (float)alpha);
            double v = (double)lsf_ggx_v((float)nl, (float)cosine, (float)alpha);
            *specular += fresnel * d * v * M_PI / (steps * steps);
            *diffuse += (1.0 - fresnel) / (steps * steps);
        }
}

/* Of all their lobes, voxels send out what a surface reflects in all. */
static void lobes_in_closed_form(void **unused)
{
    (void)unused;
    static const struct {
        float base, metallic, roughness;
    } cases[] = {{0.8f, 1.0f, 1.0f},
                 {0.8f, 1.0f, 0.5f},
                 {0.0f, 0.0f, 0.4f},
                 {0.6f, 0.0f, 0.7f},
                 {0.9f, 0.4f, 0.55f}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        for (int slant = 0; slant < 2; slant++) {
            lsf_scene *scene = build_scene();
            lsf_material *m = build_material(scene, cases[i].base, cases[i].base, cases[i].base);
            m->metallic = cases[i].metallic;
            m->roughness = cases[i].roughness;
            m->ior = 1.5f;
            build_floor(scene, 0.0f, 2.0f);
            float cosine = slant ? 0.28f : 0.8f, sine = slant ? 0.96f : 0.6f;
            build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 1, 0), lsf_f3(sine, -cosine, 0),
                        2.0f);
            finish_gl_scene(scene);
            voxel_rig v;
            voxel_rig_init(&v, scene, 32, LSF_VOXELIZE_COMPUTE, false, LSF_VOXEL_SIDES_SURFACE);
            voxel_rig_run(&v, 0);
            float *radiance = voxel_rig_read_radiance(&v);
            double base = (double)cases[i].base, metallic = (double)cases[i].metallic;
            double specular, below, unused_share;
            reflected_share(0.04, 1.0, (double)cosine, &unused_share, &below);
            reflected_share(0.04 + (base - 0.04) * metallic, (double)cases[i].roughness,
                            (double)cosine, &specular, &unused_share);
            double expected =
                2.0 * (double)cosine / M_PI * (specular + (1.0 - metallic) * base * below);
            double found = (double)radiance[4 * voxel_rig_voxel_at(&v, lsf_f3(0.1f, 0.0f, 0.3f))];
            print_message("%g of %g\n", found, expected);
            assert_true(fabs(found / expected - 1.0) < 0.015);
            free(radiance);
            voxel_rig_finish(&v);
            destroy_scene(scene);
        }
}

/* A closed box of zero thickness with a light in it: its inside is lit, its outside is not; lobes
 * of the inner sides of walls along the axes look inwards alone. */
static void walls_have_two_sides(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_box(scene, lsf_f3(-1, -1, -1), lsf_f3(1, 1, 1), false);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0.1f, 0.2f, 0.0f), lsf_f3(0, -1, 0), 1.0f);
    finish_gl_scene(scene);
    voxel_rig v;
    voxel_rig_init(&v, scene, 64, LSF_VOXELIZE_COMPUTE, true, LSF_VOXEL_SIDES_AXES);
    voxel_rig_run(&v, 3);
    voxel_rig_run(&v, 4);
    float *radiance = voxel_rig_read_radiance(&v);
    size_t count = voxel_rig_voxel_count(&v);
    for (int wall = 0; wall < 6; wall++) {
        int axis = wall / 2;
        lsf_float3 at = lsf_f3(0.3f, 0.1f, -0.2f);
        (&at.x)[axis] = wall % 2 ? 1.0f : -1.0f;
        size_t voxel = voxel_rig_voxel_at(&v, at);
        for (int slice = 0; slice < LSF_VOXEL_SIDES_AXES; slice++) {
            const float *lobe = radiance + 4 * ((size_t)slice * count + voxel);
            /* One looks along +x at the wall x = 1. */
            bool inside = slice == 2 * axis + (wall % 2 ? 0 : 1);
            assert_true(inside ? lobe[0] > 0.01f : lobe[0] == 0.0f);
            assert_true(fabsf(lobe[3] - (slice / 2 == axis ? 1.0f : 0.0f)) < 1e-3f);
        }
    }
    free(radiance);
    voxel_rig_finish(&v);
    destroy_scene(scene);
}

/* A slab that is much thinner than a voxel: whichever of its faces a voxel has, light falls on the
 * side above, and on none below. */
static void thin_walls_are_lit(void **unused)
{
    (void)unused;
    static const lsf_light_type types[] = {LSF_LIGHT_DIRECTIONAL, LSF_LIGHT_POINT};
    for (size_t type = 0; type < LSF_COUNT(types); type++) {
        lsf_scene *scene = build_scene();
        scene->diffuse_only = true;
        build_material(scene, 0.5f, 0.5f, 0.5f);
        build_box(scene, lsf_f3(-2.0f, -0.004f, -2.0f), lsf_f3(2.0f, 0.0f, 2.0f), false);
        build_light(scene, types[type], lsf_f3(0.0f, 1.0f, 0.0f), lsf_f3(0.0f, -1.0f, 0.0f), 1.0f);
        finish_gl_scene(scene);
        voxel_rig v;
        voxel_rig_init(&v, scene, 64, LSF_VOXELIZE_COMPUTE, true, LSF_VOXEL_SIDES_AXES);
        for (uint32_t iteration = 0; iteration < 16; iteration++) {
            voxel_rig_run(&v, iteration);
            float *radiance = voxel_rig_read_radiance(&v);
            size_t voxel = voxel_rig_voxel_at(&v, lsf_f3(0.02f, -0.0001f, 0.02f));
            size_t count = voxel_rig_voxel_count(&v);
            const float *below = radiance + 4 * (2 * count + voxel), *above = below + 4 * count;
            double expected = 0.5 / (double)LSF_PI;
            print_message("%g %g of %g\n", (double)above[0], (double)below[0], expected);
            assert_true(fabs((double)above[0] - expected) < 0.02 * expected);
            assert_true(below[0] == 0.0f);
            free(radiance);
        }
        voxel_rig_finish(&v);
        destroy_scene(scene);
    }
}

/* An emitter shines to its front; one whose material is double-sided to both sides. Where the grid
 * has moved on, nothing of it stays. */
static void emitters_and_leftovers(void **unused)
{
    (void)unused;
    for (int both = 0; both < 2; both++) {
        lsf_scene *scene = build_scene();
        lsf_material *material = build_material(scene, 0.5f, 0.5f, 0.5f);
        material->emission[0] = 10.0f;
        material->emission[1] = 5.0f;
        material->double_sided = both == 1;
        build_floor(scene, 0.0f, 1.0f);
        build_material(scene, 0.5f, 0.5f, 0.5f);
        build_floor(scene, 1.0f, 1.0f);
        finish_gl_scene(scene);
        voxel_rig v;
        voxel_rig_init(&v, scene, 32, LSF_VOXELIZE_COMPUTE, true, LSF_VOXEL_SIDES_SURFACE);
        for (uint32_t iteration = 0; iteration < 5; iteration++)
            voxel_rig_run(&v, iteration);
        float *radiance = voxel_rig_read_radiance(&v);
        uint8_t *set = voxel_rig_read_occupancy(&v);
        size_t count = voxel_rig_voxel_count(&v), voxel = voxel_rig_voxel_at(&v, lsf_f3(0, 0, 0));
        for (int c = 0; c < 3; c++) {
            float emission = c == 0 ? 10.0f : c == 1 ? 5.0f : 0.0f;
            assert_true(fabsf(radiance[4 * voxel + (size_t)c] - emission) <= 0.01f * emission);
            assert_true(fabsf(radiance[4 * (count + voxel) + (size_t)c] -
                              (both ? emission : 0.0f)) <= 0.01f * emission);
        }
        for (size_t i = 0; i < 2 * count; i++)
            assert_true(radiance[4 * i + 3] == (float)set[i % count]);
        free(set);
        free(radiance);
        voxel_rig_finish(&v);
        destroy_scene(scene);
    }
}

enum { SKY_PLACES = 2 };

/* On the floor, below a square and far from it. */
static const lsf_float3 sky_places[SKY_PLACES] = {{0.0f, 0.0f, 0.0f}, {-1.7f, 0.0f, 2.3f}};

/* How much of what a point of the floor sees, by the cosine, a square covers that reaches from -1
 * to 1 one unit above it. */
static double covered(lsf_float3 at)
{
    enum { STEPS = 400 };
    double sum = 0.0, step = 2.0 / STEPS;
    for (int i = 0; i < STEPS; i++)
        for (int k = 0; k < STEPS; k++) {
            double x = (i + 0.5) * step - 1.0 - (double)at.x;
            double z = (k + 0.5) * step - 1.0 - (double)at.z;
            double r2 = x * x + z * z + 1.0;
            sum += step * step / (M_PI * r2 * r2);
        }
    return sum;
}

static lsf_scene *square_over_floor(float fov_y)
{
    static const double looks_down[16] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 20, 0, 1};
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_floor(scene, 0.0f, 4.0f);
    build_quad(scene, lsf_f3(-1, 1, 1), lsf_f3(1, 1, 1), lsf_f3(1, 1, -1), lsf_f3(-1, 1, -1));
    build_environment(scene, 1.0f);
    scene->diffuse_only = true;
    scene->cameras[0].fov_y = fov_y;
    memcpy(scene->cameras[0].matrix, looks_down, sizeof looks_down);
    finish_gl_scene(scene);
    return scene;
}

/* Radiance of the floor under a white sky, the mean over iterations, where a camera looks down with
 * that field of view; returns the number of maps that voxels had to have of their own. */
static uint32_t light_under_square(float fov_y, double radiance[SKY_PLACES])
{
    enum { ITERATIONS = 256 };
    lsf_scene *scene = square_over_floor(fov_y);
    voxel_rig v;
    voxel_rig_init(&v, scene, 64, LSF_VOXELIZE_COMPUTE, false, LSF_VOXEL_SIDES_SURFACE);
    uint32_t own = 0;
    radiance[0] = radiance[1] = 0.0;
    for (uint32_t i = 0; i < ITERATIONS; i++) {
        voxel_rig_run(&v, i);
        own += v.sky_map.scene.count;
        float *all = voxel_rig_read_radiance(&v);
        for (int k = 0; k < SKY_PLACES; k++)
            radiance[k] += (double)all[4 * voxel_rig_voxel_at(&v, sky_places[k])] / ITERATIONS;
        free(all);
    }
    voxel_rig_finish(&v);
    destroy_scene(scene);
    return own;
}

/* By maps of what the camera sees, where that is the whole scene, and by maps of voxels' own. */
static void sky_in_closed_form(void **unused)
{
    (void)unused;
    double seen[SKY_PLACES], own[SKY_PLACES];
    assert_int_equal(light_under_square(0.8f, seen), 0);
    assert_true(light_under_square(0.02f, own) > 0);
    for (int k = 0; k < SKY_PLACES; k++) {
        double expected = 0.5 * (1.0 - covered(sky_places[k]));
        print_message("%.5f and %.5f, expected %.5f\n", seen[k], own[k], expected);
        assert_true(fabs(seen[k] / expected - 1.0) <= 0.02);
        assert_true(fabs(own[k] / expected - 1.0) <= 0.02);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floor_in_closed_form),   cmocka_unit_test(lobes_in_closed_form),
        cmocka_unit_test(walls_have_two_sides),   cmocka_unit_test(thin_walls_are_lit),
        cmocka_unit_test(emitters_and_leftovers), cmocka_unit_test(sky_in_closed_form),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
