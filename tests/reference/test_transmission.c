/* Light through surfaces, as the path tracer does it: directions against their density, furnaces,
 * Snell, Beer and Lambert, against closed forms and a quadrature that knows nothing of sampling. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/base.h"
#include "chi_square.h"
#include "math/sampling.h"
#include "reference/bsdf.h"
#include "render_scene.h"
#include "shared/brdf.h"

typedef struct wall_case {
    float roughness, transmission, ior; /* ior 0: a thin wall */
    bool front;
    float cosine;
} wall_case;

static const wall_case cases[] = {
    {0.5f, 1.0f, 0.0f, true, 0.8f},  {0.3f, 0.5f, 0.0f, false, 0.4f},
    {0.5f, 1.0f, 1.5f, true, 0.9f},  {0.4f, 0.6f, 1.33f, true, 0.3f},
    {0.6f, 1.0f, 1.5f, false, 0.9f}, {0.4f, 1.0f, 1.5f, false, 0.7f}, /* about the critical angle */
    {0.5f, 0.7f, 2.4f, false, 0.3f}, {0.8f, 1.0f, 1.1f, true, 0.6f},
    {0.5f, 1.0f, 1.0f, true, 0.5f}, /* an index that turns nothing */
};

static lsf_reference_surface make_surface(const wall_case *c)
{
    float ior = c->ior > 0.0f ? c->ior : 1.5f, f0 = lsf_f0_from_ior(ior);
    lsf_reference_surface surface = {
        .geometric_normal = {0, 0, 1},
        .frame = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        .view = {sqrtf(1.0f - c->cosine * c->cosine), 0, c->cosine},
        .reflects = true,
        .specular = true,
        .base_color = {0.9f, 0.9f, 0.9f},
        .f0_dielectric = {f0, f0, f0},
        .f90_dielectric = 1.0f,
        .transmission = c->transmission,
        .volume = c->ior > 0.0f,
        .front = c->front,
        .eta = c->ior > 0.0f ? lsf_relative_ior(c->ior, c->front) : 1.0f,
    };
    float alpha = lsf_alpha_from_roughness(c->roughness);
    surface.alpha_t = surface.alpha_b = alpha;
    return surface;
}

/* In rows by the cosine, from straight below to straight above, and columns by the azimuth. */
static void directions_follow_density(void **unused)
{
    (void)unused;
    enum { N = 100000, ROWS = 32, COLUMNS = 16, FINE = 24 };
    for (size_t k = 0; k < LSF_COUNT(cases); k++) {
        lsf_reference_surface surface = make_surface(&cases[k]);
        lsf_reference_bsdf bsdf;
        lsf_reference_bsdf_init(&bsdf, &surface);
        double counts[ROWS * COLUMNS + 1] = {0}, expected[ROWS * COLUMNS + 1] = {0}, all = 0.0;
        for (uint32_t i = 0; i < N; i++) {
            float u[2] = {lsf_random_float(41, i), lsf_random_float(42, i)};
            lsf_float3 l = lsf_reference_bsdf_sample(&bsdf, lsf_random_float(43, i), u);
            /* The last bin takes what no light comes from: microfacets turn it to the wrong side.
             */
            bool lost = !(lsf_reference_bsdf_evaluate(&bsdf, l).pdf > 0.0f);
            int row = (int)fminf(0.5f * (l.z + 1.0f) * ROWS, ROWS - 1);
            counts[lost ? ROWS * COLUMNS : row * COLUMNS + angle_bin(l.x, l.y, COLUMNS)]++;
        }
        for (int row = 0; row < ROWS * FINE; row++) {
            for (int column = 0; column < COLUMNS * FINE; column++) {
                double z = 2.0 * (row + 0.5) / (ROWS * FINE) - 1.0, r = sqrt(1.0 - z * z);
                double phi = (column + 0.5) / (COLUMNS * FINE) * 2.0 * M_PI - M_PI;
                lsf_float3 l = lsf_f3((float)(r * cos(phi)), (float)(r * sin(phi)), (float)z);
                double part = (double)lsf_reference_bsdf_evaluate(&bsdf, l).pdf * 4.0 * M_PI /
                              ((double)ROWS * FINE * COLUMNS * FINE);
                expected[row / FINE * COLUMNS + column / FINE] += part * N;
                all += part;
            }
        }
        if (cases[k].ior == 1.0f)
            continue; /* narrower than any bin */
        expected[ROWS * COLUMNS] = fmax(0.0, 1.0 - all) * N;
        double z = chi_square_z(counts, expected, ROWS * COLUMNS + 1, 8.0);
        print_message("case %zu: z = %.2f, %.4f of the directions\n", k, z, all);
        if (z > 4.0 || all > 1.002)
            fail_msg("case %zu: z = %.2f, %.4f of the directions", k, z, all);
    }
}

static double schlick(double f0, double cosine)
{
    return f0 + (1.0 - f0) * pow(1.0 - cosine, 5.0);
}

static double ggx_d(double z, double alpha)
{
    double d = z * z * (alpha * alpha - 1.0) + 1.0;
    return alpha * alpha / (M_PI * d * d);
}

static double ggx_g1(double cosine, double alpha)
{
    return 2.0 / (1.0 + sqrt(1.0 + alpha * alpha * (1.0 - cosine * cosine) / (cosine * cosine)));
}

/* What a surface between two white halves of the world sends to the viewer: the integral of f cos
 * over all directions, by the angles of the microfacet, from the papers' formulas in double
 * precision. */
static double throughput(const wall_case *c)
{
    enum { ROWS = 800, COLUMNS = 360 };
    double alpha = (double)c->roughness * (double)c->roughness, sum = 0.0;
    double ior = c->ior > 0.0f ? (double)c->ior : 1.5, t = (double)c->transmission;
    double eta = c->ior > 0.0f ? (c->front ? ior : 1.0 / ior) : 1.0;
    double f0 = pow((ior - 1.0) / (ior + 1.0), 2.0), base = (double)0.9f;
    double vz = (double)c->cosine, vx = sqrt(1.0 - vz * vz);
    for (int row = 0; row < ROWS; row++) {
        /* By what makes the distribution even, and finer towards the horizon. */
        double s = (row + 0.5) / ROWS, u = 1.0 - s * s;
        double hz = sqrt((1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u)), hr = sqrt(1.0 - hz * hz);
        double weight = 1.0 * 2.0 * s / (ggx_d(hz, alpha) * hz) / ((double)ROWS * COLUMNS);
        for (int column = 0; column < COLUMNS; column++) {
            double hx = hr * cos((column + 0.5) / COLUMNS * 2.0 * M_PI);
            double vh = vx * hx + vz * hz;
            if (vh <= 0.0)
                continue;
            double sine2 = (1.0 - vh * vh) / (eta * eta);
            double beyond = sine2 < 1.0 ? sqrt(1.0 - sine2) : 0.0;
            double f = schlick(f0, eta < 1.0 ? beyond : vh);
            double drawn = ggx_d(hz, alpha) * ggx_g1(vz, alpha) * vh / vz * weight;
            double reflected = 2.0 * vh * hz - vz;
            /* Reflection and thin walls take the height-correlated masking of glTF, refraction
             * Walter's. */
            double lz = c->ior > 0.0f ? -(vz / eta) + (vh / eta - beyond) * hz : -reflected;
            double both = 0.0;
            if (reflected > 0.0) {
                double lambda_v = 1.0 / ggx_g1(vz, alpha),
                       lambda_l = 1.0 / ggx_g1(reflected, alpha);
                both = lambda_v / (lambda_v + lambda_l - 1.0);
                sum += drawn * both * f;
            }
            if (lz < 0.0 && sine2 < 1.0)
                sum += drawn * (c->ior > 0.0f ? ggx_g1(-lz, alpha) : both) * (1.0 - f) * t * base;
        }
    }
    /* The diffuse lobe. */
    for (int row = 0; row < ROWS; row++) {
        double nl = (row + 0.5) / ROWS, r = sqrt(1.0 - nl * nl);
        for (int column = 0; column < COLUMNS; column++) {
            double lx = r * cos((column + 0.5) / COLUMNS * 2.0 * M_PI);
            double vh = sqrt(0.5 * (1.0 + vx * lx + vz * nl)),
                   sine2 = (1.0 - vh * vh) / (eta * eta);
            double f = schlick(f0, eta < 1.0 ? sqrt(fmax(0.0, 1.0 - sine2)) : vh);
            sum += (1.0 - f) * (1.0 - t) * base * 2.0 * nl / ((double)ROWS * COLUMNS);
        }
    }
    return sum;
}

static lsf_scene *white_world(void)
{
    lsf_scene *scene = build_scene();
    build_environment(scene, 1.0f);
    return scene;
}

static void furnace_by_surface(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < LSF_COUNT(cases) - 1; k++) {
        const wall_case *c = &cases[k];
        lsf_scene *scene = white_world();
        build_glass(scene, 0.9f, c->roughness, c->ior)->transmission = c->transmission;
        build_floor(scene, 0.0f, 1.0f);
        finish_scene(scene);
        float sine = sqrtf(1.0f - c->cosine * c->cosine), rgb[3];
        float height = c->front ? c->cosine : -c->cosine;
        render_point(scene, lsf_f3(sine, height, 0), lsf_f3(0, 0, 0), 65536, 0, rgb);
        double expected = throughput(c), error = (double)rgb[0] / expected - 1.0;
        print_message("case %zu: %.5f, expected %.5f\n", k, (double)rgb[0], expected);
        assert_true(fabs(error) < 1.5e-3);
        destroy_scene(scene);
    }
}

/* Nothing is lost or won in smooth white glass: a sphere of it, or a thin one, cannot be seen. */
static void white_glass_is_invisible(void **unused)
{
    (void)unused;
    static const float iors[] = {0.0f, 1.0f, 1.33f, 1.5f, 2.4f};
    for (size_t k = 0; k < LSF_COUNT(iors); k++) {
        for (int step = 0; step < 3; step++) {
            lsf_scene *scene = white_world();
            build_glass(scene, 1.0f, 0.0f, iors[k]);
            build_sphere(scene, 4, false);
            finish_scene(scene);
            float rgb[3], x = 0.4f * (float)step;
            render_point(scene, lsf_f3(x, 0.01f, 3), lsf_f3(x, 0.01f, 0), 1024, 64, rgb);
            print_message("ior %.2f, %.1f of the radius: %.5f\n", (double)iors[k], (double)x,
                          (double)rgb[0]);
            assert_true(fabsf(rgb[0] - 1.0f) < 2e-3f);
            destroy_scene(scene);
        }
    }
}

/* Through a slab onto a lamp of two halves: the border is seen where Snell's law says. */
static void slab_displaces(void **unused)
{
    (void)unused;
    static const double iors[] = {1.0, 1.33, 1.5, 2.0};
    for (size_t k = 0; k < LSF_COUNT(iors); k++) {
        double sine = 0.6, thickness = 0.5, inside = asin(sine / iors[k]);
        /* From (x, 1) down at 0.75 across per unit: the ray is at x = 0 on the slab's top, y = 0.
         */
        double crossing = thickness * tan(inside) + 0.5 * 0.75;
        for (int right = 0; right < 2; right++) {
            lsf_scene *scene = build_scene();
            float edge = (float)(crossing + (right ? -0.03 : 0.03));
            for (int half = 0; half < 2; half++) {
                lsf_material *lamp = build_material(scene, 0, 0, 0);
                lamp->emission[half] = 1.0f;
                float low = half ? edge : -2.0f, high = half ? 2.0f : edge;
                build_quad(scene, lsf_f3(low, -1, 2), lsf_f3(high, -1, 2), lsf_f3(high, -1, -2),
                           lsf_f3(low, -1, -2));
            }
            build_glass(scene, 1.0f, 0.0f, (float)iors[k]);
            build_box(scene, lsf_f3(-2, (float)-thickness, -2), lsf_f3(2, 0, 2), false);
            finish_scene(scene);
            float rgb[3];
            render_point(scene, lsf_f3(-0.75f, 1, 0), lsf_f3(0, 0, 0), 256, 2, rgb);
            double f0 = pow((iors[k] - 1.0) / (iors[k] + 1.0), 2.0), pass = 1.0 - schlick(f0, 0.8);
            print_message("ior %.2f: %.4f and %.4f, expected %.4f on one\n", iors[k],
                          (double)rgb[0], (double)rgb[1], pass * pass);
            assert_true(fabs((double)rgb[right] - pass * pass) < 0.02 && rgb[!right] < 0.02f);
            destroy_scene(scene);
        }
    }
}

/* A slab that absorbs, seen straight on in a white world: light that went through, and all that was
 * thrown back and forth. */
static void slab_absorbs(void **unused)
{
    (void)unused;
    static const float iors[] = {1.0f, 1.5f, 2.0f};
    for (size_t k = 0; k < LSF_COUNT(iors); k++) {
        lsf_scene *scene = white_world();
        lsf_material *glass = build_glass(scene, 1.0f, 0.0f, iors[k]);
        glass->attenuation_distance = 2.5f;
        glass->attenuation_color[0] = 0.0f;
        glass->attenuation_color[1] = 0.5f;
        build_box(scene, lsf_f3(-8, -3, -8), lsf_f3(8, 0, 8), false);
        finish_scene(scene);
        float rgb[3];
        render_point(scene, lsf_f3(0, 4, 0), lsf_f3(0.001f, 0, 0.001f), 65536, 16, rgb);
        double f = pow(((double)iors[k] - 1.0) / ((double)iors[k] + 1.0), 2.0);
        const double left[3] = {0.0, pow(0.5, 3.0 / 2.5), 1.0};
        for (int c = 0; c < 3; c++) {
            double a = left[c], pass = (1.0 - f) * (1.0 - f);
            double expected = f + pass * (a + f * a * a) / (1.0 - f * f * a * a);
            print_message("ior %.1f, channel %d: %.5f, expected %.5f\n", (double)iors[k], c,
                          (double)rgb[c], expected);
            assert_true(fabs((double)rgb[c] - expected) < 1e-3);
        }
        destroy_scene(scene);
    }
}

/* A lamp over a floor under two panes, seen from between them and through one of them: straight on,
 * and no bounce. */
static void lamp_shines_through_panes(void **unused)
{
    (void)unused;
    const double tints[2][3] = {{0.9, 0.5, 0.2}, {0.3, 0.8, 1.0}};
    const lsf_float3 target = {0.4f, 0, 0}, eyes[2] = {{0.0f, 0.9f, 0.0f}, {-0.4f, 1.7f, 0.0f}};
    for (int through = 0; through < 2; through++) {
        lsf_scene *scene = build_scene();
        build_material(scene, 0.5f, 0.5f, 0.5f);
        scene->materials[scene->material_count - 1].ior = 1.0f;
        build_floor(scene, 0.0f, 2.0f);
        for (int pane = 0; pane < 2; pane++) {
            lsf_material *glass = build_glass(scene, 1.0f, 0.0f, 0.0f);
            for (int c = 0; c < 3; c++)
                glass->base_color[c] = (float)tints[pane][c];
            build_floor(scene, 1.0f + (float)pane, 2.0f);
        }
        build_light(scene, LSF_LIGHT_POINT, lsf_f3(0, 3, 0), lsf_f3(0, -1, 0), 10.0f);
        finish_scene(scene);
        float rgb[3];
        render_point(scene, eyes[through], target, 4096, 0, rgb);
        lsf_float3 view = lsf_f3_normalize(lsf_f3_sub(eyes[through], target));
        double d2 = 0.4 * 0.4 + 9.0, cosine = 3.0 / sqrt(d2),
               floor = 0.5 / M_PI * 10.0 / d2 * cosine;
        for (int c = 0; c < 3; c++) {
            double pass = 1.0 - schlick(0.04, cosine);
            double expected = floor * tints[0][c] * tints[1][c] * pass * pass;
            if (through)
                expected *= tints[0][c] * (1.0 - schlick(0.04, (double)view.y));
            print_message("%d, channel %d: %.5f, expected %.5f\n", through, c, (double)rgb[c],
                          expected);
            assert_true(fabs((double)rgb[c] / expected - 1.0) < (through ? 0.02 : 1e-3));
        }
        destroy_scene(scene);
    }
}

/* Walls of any kind, light and view at the horizon, indices of 0 and of nearly 1 stay finite. */
static void extremes_are_finite(void **unused)
{
    (void)unused;
    static const float iors[] = {0.0f, 1.0f, 1.0079f, 1.5f, 50.0f},
                       cosines[] = {-0.5f, 0.0f, 1e-6f, 1.0f};
    for (uint32_t i = 0; i < 8000; i++) {
        wall_case c = {.roughness = 0.1f * (float)(i % 11),
                       .transmission = i % 3 ? 1.0f : 0.5f,
                       .ior = iors[i % 5],
                       .front = i / 5 % 2,
                       .cosine = cosines[i / 10 % 4]};
        lsf_reference_surface surface = make_surface(&c);
        if (i & 4)
            surface.f0_dielectric = lsf_f3(1.0f, 1.0f, 1.0f);
        lsf_reference_bsdf bsdf;
        lsf_reference_bsdf_init(&bsdf, &surface);
        float u[2] = {lsf_random_float(61, i), lsf_random_float(62, i)};
        lsf_float3 l = lsf_reference_bsdf_sample(&bsdf, lsf_random_float(63, i), u);
        lsf_reference_reflection f = lsf_reference_bsdf_evaluate(&bsdf, l);
        float length = lsf_f3_length(l);
        assert_true(length == 0.0f || fabsf(length - 1.0f) < 1e-4f);
        assert_true(isfinite(f.pdf) && f.pdf >= 0.0f);
        assert_true(isfinite(lsf_f3_max(f.diffuse)) && isfinite(lsf_f3_max(f.specular)));
        if (f.pdf > 0.0f)
            assert_true(lsf_f3_max(lsf_f3_add(f.diffuse, f.specular)) / f.pdf < 20.0f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directions_follow_density),
        cmocka_unit_test(furnace_by_surface),
        cmocka_unit_test(white_glass_is_invisible),
        cmocka_unit_test(slab_displaces),
        cmocka_unit_test(slab_absorbs),
        cmocka_unit_test(lamp_shines_through_panes),
        cmocka_unit_test(extremes_are_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
