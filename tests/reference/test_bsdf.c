/* The BRDF as the path tracer samples it: directions against their density, and reflected light
 * against a quadrature that knows nothing of sampling. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "chi_square.h"
#include "math/sampling.h"
#include "reference/bsdf.h"
#include "render_scene.h"
#include "shared/brdf.h"
#include "shared/sheen.h"

typedef struct material_case {
    float roughness, metallic, anisotropy, cosine, azimuth;
    float dim;     /* KHR_materials_specular: 1 less the weight */
    float tint[3]; /* ... and the tint of f0; 0: none */
    float coat, coat_roughness;
    float sheen, sheen_roughness; /* of all channels alike */
} material_case;

static const material_case cases[] = {
    {.roughness = 1.0f, .cosine = 0.9f},
    {.roughness = 0.3f, .cosine = 0.7f, .azimuth = 1.0f},
    {.roughness = 0.5f, .metallic = 1.0f, .cosine = 0.8f, .azimuth = 2.0f},
    {.roughness = 0.7f, .metallic = 0.5f, .cosine = 0.3f, .azimuth = -1.0f},
    {.roughness = 0.4f, .metallic = 1.0f, .anisotropy = 0.8f, .cosine = 0.6f, .azimuth = 0.5f},
    {.roughness = 0.4f, .metallic = 0.3f, .anisotropy = 1.0f, .cosine = 0.5f, .azimuth = 2.2f},
    {.roughness = 0.9f, .metallic = 1.0f, .cosine = 0.1f},
    {.roughness = 0.25f, .metallic = 1.0f, .anisotropy = 0.6f, .cosine = 0.95f, .azimuth = -2.0f},
    {.roughness = 0.4f, .cosine = 0.6f, .azimuth = 0.3f, .dim = 0.7f},
    {.roughness = 0.6f, .metallic = 0.3f, .cosine = 0.7f, .dim = 0.2f, .tint = {0.5f, 1.0f, 3.0f}},
    {.roughness = 0.8f, .cosine = 0.7f, .coat = 1.0f, .coat_roughness = 0.3f},
    {.roughness = 0.5f, .metallic = 1.0f, .cosine = 0.3f, .coat = 0.6f, .coat_roughness = 0.7f},
    {.roughness = 0.8f, .cosine = 0.3f, .sheen = 1.0f, .sheen_roughness = 0.5f},
    {.roughness = 0.9f,
     .cosine = 0.6f,
     .sheen = 0.7f,
     .sheen_roughness = 0.8f,
     .coat = 0.5f,
     .coat_roughness = 0.5f},
    {.roughness = 0.3f, .cosine = 0.8f, .tint = {40.0f, 0.5f, 0.1f}},
};

/* What the dielectric reflects of light from the front, before its weight. */
static float tinted_f0(const material_case *c, int channel)
{
    return fminf(0.04f * (c->tint[channel] > 0.0f ? c->tint[channel] : 1.0f), 1.0f);
}

static lsf_reference_surface make_surface(const material_case *c)
{
    float sine = sqrtf(1.0f - c->cosine * c->cosine);
    float alpha = lsf_alpha_from_roughness(c->roughness), weight = 1.0f - c->dim;
    return (lsf_reference_surface){
        .geometric_normal = {0, 0, 1},
        .frame = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        .view = {sine * cosf(c->azimuth), sine * sinf(c->azimuth), c->cosine},
        .reflects = true,
        .specular = true,
        .base_color = {0.8f, 0.5f, 0.2f},
        .metallic = c->metallic,
        .alpha_t = lsf_alpha_along_tangent(alpha, c->anisotropy),
        .alpha_b = alpha,
        .f0_dielectric = {weight * tinted_f0(c, 0), weight * tinted_f0(c, 1),
                          weight * tinted_f0(c, 2)},
        .f90_dielectric = weight,
        .sheen_color = {c->sheen, c->sheen, c->sheen},
        .sheen_roughness = c->sheen_roughness,
        .coat = c->coat,
        .coat_alpha = lsf_alpha_from_roughness(c->coat_roughness),
        .coat_normal = {0, 0, 1},
    };
}

static void directions_follow_density(void **unused)
{
    (void)unused;
    enum { N = 100000, ROWS = 16, COLUMNS = 24, FINE = 16 };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        lsf_reference_surface surface = make_surface(&cases[k]);
        lsf_reference_bsdf bsdf;
        lsf_reference_bsdf_init(&bsdf, &surface);
        /* The last bin takes what falls below the horizon. */
        double counts[ROWS * COLUMNS + 1] = {0}, expected[ROWS * COLUMNS + 1] = {0}, above = 0.0;
        for (uint32_t i = 0; i < N; i++) {
            float u[2] = {lsf_random_float(41, i), lsf_random_float(42, i)};
            lsf_float3 l = lsf_reference_bsdf_sample(&bsdf, lsf_random_float(43, i), u);
            int row = (int)fminf(l.z * ROWS, ROWS - 1);
            int bin = l.z > 0.0f ? row * COLUMNS + angle_bin(l.x, l.y, COLUMNS) : ROWS * COLUMNS;
            counts[bin]++;
        }
        for (int row = 0; row < ROWS * FINE; row++) {
            for (int column = 0; column < COLUMNS * FINE; column++) {
                double z = (row + 0.5) / (ROWS * FINE), r = sqrt(1.0 - z * z);
                double phi = (column + 0.5) / (COLUMNS * FINE) * 2.0 * M_PI - M_PI;
                lsf_float3 l = lsf_f3((float)(r * cos(phi)), (float)(r * sin(phi)), (float)z);
                double part = (double)lsf_reference_bsdf_evaluate(&bsdf, l).pdf * 2.0 * M_PI /
                              ((double)ROWS * FINE * COLUMNS * FINE);
                expected[row / FINE * COLUMNS + column / FINE] += part * N;
                above += part;
            }
        }
        expected[ROWS * COLUMNS] = fmax(0.0, 1.0 - above) * N;
        double z = chi_square_z(counts, expected, ROWS * COLUMNS + 1, 8.0);
        if (z > 4.0 || above > 1.002)
            fail_msg("case %zu: z = %.2f, %.4f above the horizon", k, z, above);
    }
}

/* f is symmetric: f(v, l) = f(l, v). */
static void reciprocity(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        for (uint32_t i = 0; i < 200; i++) {
            lsf_float3 a =
                lsf_sample_cosine_hemisphere(lsf_random_float(51, i), lsf_random_float(52, i));
            lsf_float3 b =
                lsf_sample_cosine_hemisphere(lsf_random_float(53, i), lsf_random_float(54, i));
            if (a.z < 0.01f || b.z < 0.01f)
                continue;
            lsf_reference_surface surface = make_surface(&cases[k]);
            lsf_reference_bsdf bsdf;
            surface.view = a;
            lsf_reference_bsdf_init(&bsdf, &surface);
            lsf_reference_reflection ab = lsf_reference_bsdf_evaluate(&bsdf, b);
            surface.view = b;
            lsf_reference_bsdf_init(&bsdf, &surface);
            lsf_reference_reflection ba = lsf_reference_bsdf_evaluate(&bsdf, a);
            float f = (ab.diffuse.x + ab.specular.x) / b.z;
            float g = (ba.diffuse.x + ba.specular.x) / a.z;
            assert_true(fabsf(f - g) <= 2e-4f * fmaxf(f, g));
        }
    }
}

/* A black or mirror-like surface, and light and view at the horizon, stay finite. */
static void extremes_are_finite(void **unused)
{
    (void)unused;
    static const float roughnesses[] = {0.0f, 0.01f, 1.0f}, cosines[] = {-0.5f, 0.0f, 1e-6f, 1.0f};
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 4; c++) {
            for (uint32_t i = 0; i < 500; i++) {
                material_case what = {.roughness = roughnesses[r],
                                      .metallic = i & 1 ? 1.0f : 0.0f,
                                      .anisotropy = i & 2 ? 1.0f : 0.0f,
                                      .cosine = cosines[c],
                                      .azimuth = 0.3f,
                                      .dim = i & 8 ? 1.0f : 0.0f};
                lsf_reference_surface surface = make_surface(&what);
                if (i & 4)
                    surface.base_color = lsf_f3(0, 0, 0);
                lsf_reference_bsdf bsdf;
                lsf_reference_bsdf_init(&bsdf, &surface);
                float u[2] = {lsf_random_float(61, i), lsf_random_float(62, i)};
                lsf_float3 l = lsf_reference_bsdf_sample(&bsdf, lsf_random_float(63, i), u);
                lsf_reference_reflection f = lsf_reference_bsdf_evaluate(&bsdf, l);
                float length = lsf_f3_length(l);
                assert_true(length == 0.0f || fabsf(length - 1.0f) < 1e-4f);
                assert_true(isfinite(f.pdf) && f.pdf >= 0.0f);
                assert_true(isfinite(lsf_f3_max(f.diffuse)) && isfinite(lsf_f3_max(f.specular)));
                /* Sampled by its own density, light is never blown up. */
                if (f.pdf > 0.0f)
                    assert_true(lsf_f3_max(lsf_f3_add(f.diffuse, f.specular)) / f.pdf < 20.0f);
            }
        }
    }
}

/* Dims what is below. */
static double sheen_value(const material_case *c, double nh, double nv, double nl, double *specular,
                          double *diffuse)
{
    if (c->sheen == 0.0f)
        return 0.0;
    double at_v = (double)lsf_sheen_albedo((float)nv, c->sheen_roughness);
    double at_l = (double)lsf_sheen_albedo((float)nl, c->sheen_roughness);
    double leaves = 1.0 - (double)c->sheen * fmin(fmax(at_v, at_l), 1.0);
    *specular *= leaves;
    *diffuse *= leaves;
    return (double)c->sheen *
           (double)lsf_sheen_lobe((float)nv, (float)nl, (float)(1.0 - nh * nh),
                                  c->sheen_roughness) /
           fmax(fmax(at_v, at_l), 1.0);
}

static double coat_fresnel(const material_case *c, double cosine)
{
    return (double)c->coat * (0.04 + 0.96 * pow(1.0 - cosine, 5.0));
}

static double coat_leaves(const material_case *c, double cosine)
{
    return 1.0 - coat_fresnel(c, cosine);
}

/* Of the coat's own lobe, which is isotropic. */
static double coat_value(const material_case *c, double vh, double nh, double nv, double nl)
{
    double a2 = pow((double)lsf_alpha_from_roughness(c->coat_roughness), 2.0);
    double e = nh * nh * (a2 - 1.0) + 1.0;
    double lambdas = nv * sqrt(a2 + (1.0 - a2) * nl * nl) + nl * sqrt(a2 + (1.0 - a2) * nv * nv);
    return coat_fresnel(c, vh) * a2 / (M_PI * e * e) * 0.5 / lambdas;
}

/* The table of the sheen's albedo, at its nodes and between them, by the formulas of the paper in
 * double precision. */
static double sheen_lambda(double x, double a)
{
    static const double at_1[5] = {21.5473, 3.82987, 0.19823, -1.97760, -4.32054},
                        at_0[5] = {25.3245, 3.32435, 0.16801, -1.27393, -4.85967};
    double t = (1.0 - a) * (1.0 - a), p[5], sum = 0.0;
    for (int i = 0; i < 5; i++)
        p[i] = at_1[i] + (at_0[i] - at_1[i]) * t;
    double places[2] = {x < 0.5 ? x : 0.5, 1.0 - x};
    for (int i = 0; i < (x < 0.5 ? 1 : 2); i++) {
        double value = p[0] / (1.0 + p[1] * pow(places[i], p[2])) + p[3] * places[i] + p[4];
        sum = i == 0 ? (x < 0.5 ? value : 2.0 * value) : sum - value;
    }
    return exp(sum);
}

static void sheen_albedo(void **unused)
{
    (void)unused;
    enum { ROWS = 400, COLUMNS = 180 };
    static const float cosines[] = {0.04f, 0.2f, 0.5f, 0.9f}, roughnesses[] = {0.3f, 0.535f, 1.0f};
    for (int k = 0; k < 12; k++) {
        double nv = (double)cosines[k % 4], a = pow((double)roughnesses[k / 4], 2.0), sum = 0.0;
        double sine = sqrt(1.0 - nv * nv);
        for (int row = 0; row < ROWS; row++) {
            double root = (row + 0.5) / ROWS, nl = root * root, r = sqrt(1.0 - nl * nl);
            double v = 1.0 / ((1.0 + sheen_lambda(nv, a) + sheen_lambda(nl, a)) * 4.0 * nv * nl);
            for (int column = 0; column < COLUMNS; column++) {
                double phi = (column + 0.5) / COLUMNS * M_PI;
                double x = sine + r * cos(phi), y = r * sin(phi), z = nv + nl;
                double sin2 = (x * x + y * y) / (x * x + y * y + z * z);
                double d = (2.0 + 1.0 / a) * pow(sin2, 0.5 / a) / (2.0 * M_PI);
                sum += d * v * nl * 2.0 * root * 2.0 * M_PI / ((double)ROWS * COLUMNS);
            }
        }
        double found = (double)lsf_sheen_albedo(cosines[k % 4], roughnesses[k / 4]);
        print_message("sheen at %g, %g: %.4f, expected %.4f\n", (double)roughnesses[k / 4], nv,
                      found, sum);
        assert_true(fabs(found - sum) < 0.006);
    }
}

/* What a plane reflects of a uniform environment: the integral of f cos over the hemisphere, in
 * spherical coordinates about the mirror direction's side, in double precision, from the formulas
 * of glTF 2.0, appendix B, and of KHR_materials_specular; the coat as shared/brdf.h has it. */
static double reflectance(const material_case *c, int channel)
{
    static const double bases[3] = {0.8, 0.5, 0.2};
    enum { ROWS = 2000, COLUMNS = 720 };
    double alpha = (double)lsf_alpha_from_roughness(c->roughness);
    double at = alpha + (1.0 - alpha) * (double)(c->anisotropy * c->anisotropy), ab = alpha;
    double nv = (double)c->cosine, sine = sqrt(1.0 - nv * nv);
    double vx = sine * cos((double)c->azimuth), vy = sine * sin((double)c->azimuth);
    double base = bases[channel], weight = 1.0 - (double)c->dim, metallic = (double)c->metallic;
    double own = (double)tinted_f0(c, channel), brightest = own, sum = 0.0;
    for (int other = 0; other < 3; other++)
        brightest = fmax(brightest, (double)tinted_f0(c, other));
    for (int row = 0; row < ROWS; row++) {
        double nl = (row + 0.5) / ROWS, r = sqrt(1.0 - nl * nl);
        for (int column = 0; column < COLUMNS; column++) {
            double phi = (column + 0.5) / COLUMNS * 2.0 * M_PI;
            double lx = r * cos(phi), ly = r * sin(phi);
            double hx = vx + lx, hy = vy + ly, hz = nv + nl;
            double length = sqrt(hx * hx + hy * hy + hz * hz);
            hx /= length;
            hy /= length;
            hz /= length;
            double m5 = pow(1.0 - (vx * hx + vy * hy + nv * hz), 5.0);
            double e = hx * hx / (at * at) + hy * hy / (ab * ab) + hz * hz;
            double d = 1.0 / (M_PI * at * ab * e * e);
            double lambda_l = nv * sqrt(at * at * lx * lx + ab * ab * ly * ly + nl * nl);
            double lambda_v = nl * sqrt(at * at * vx * vx + ab * ab * vy * vy + nv * nv);
            double dielectric = weight * (own + (1.0 - own) * m5), metal = base + (1.0 - base) * m5;
            double below = 1.0 - weight * (brightest + (1.0 - brightest) * m5);
            double specular = ((1.0 - metallic) * dielectric + metallic * metal) * d * 0.5 /
                              (lambda_l + lambda_v);
            double diffuse = (1.0 - metallic) * below * base / M_PI;
            double sheen = sheen_value(c, hz, nv, nl, &specular, &diffuse);
            sum += ((specular + diffuse + sheen) * coat_leaves(c, nv) * coat_leaves(c, nl) +
                    coat_value(c, (vx * hx + vy * hy + nv * hz), hz, nv, nl)) *
                   nl;
        }
    }
    return sum * 2.0 * M_PI / ((double)ROWS * COLUMNS);
}

static void furnace_by_material(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const material_case *c = &cases[k];
        lsf_scene *scene = build_scene();
        scene->environment = (lsf_environment){.present = true, .radiance = {1, 1, 1}};
        lsf_material *material = build_material(scene, 0.8f, 0.5f, 0.2f);
        material->roughness = c->roughness;
        material->metallic = c->metallic;
        material->anisotropy_strength = c->anisotropy;
        material->specular = 1.0f - c->dim;
        for (int channel = 0; channel < 3; channel++)
            material->sheen_color[channel] = c->sheen;
        material->sheen_roughness = c->sheen_roughness;
        material->coat = c->coat;
        material->coat_roughness = c->coat_roughness;
        for (int channel = 0; channel < 3; channel++)
            material->specular_color[channel] = c->tint[channel] > 0.0f ? c->tint[channel] : 1.0f;
        build_floor(scene, 0.0f, 1.0f);
        /* The floor's tangents run along x and its bitangents along -z. */
        scene->vertices.tangent = calloc(4 * scene->vertices.count, sizeof(float));
        for (uint64_t i = 0; i < scene->vertices.count; i++) {
            scene->vertices.tangent[4 * i] = 1.0f;
            scene->vertices.tangent[4 * i + 3] = 1.0f;
        }
        finish_scene(scene);
        float sine = sqrtf(1.0f - c->cosine * c->cosine), rgb[3];
        render_point(scene, lsf_f3(sine * cosf(c->azimuth), c->cosine, -sine * sinf(c->azimuth)),
                     lsf_f3(0, 0, 0), 65536, 0, rgb);
        for (int channel = 0; channel < 3; channel++) {
            double expected = reflectance(c, channel);
            double error = fabs((double)rgb[channel] / expected - 1.0);
            print_message("case %zu, channel %d: %.5f, expected %.5f\n", k, channel,
                          (double)rgb[channel], expected);
            assert_true(error < 1e-3 && (c->coat == 0.0f || expected < 1.0));
        }
        destroy_scene(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directions_follow_density),
        cmocka_unit_test(reciprocity),
        cmocka_unit_test(sheen_albedo),
        cmocka_unit_test(extremes_are_finite),
        cmocka_unit_test(furnace_by_material),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
