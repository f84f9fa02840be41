/* Virtual point lights: they lie on the surfaces that the light meets, where its density says,
 * carry its flux, and their maps see what rays see. */
#include <math.h>

#include "../reference/chi_square.h"
#include "light_passes.h"

#include "base/base.h"
#include "math/sampling.h"

enum { COUNT = 4096 };

static lsf_float3 xyz(lsf_vec4 v)
{
    return lsf_f3(v.x, v.y, v.z);
}

/* Each light, as it shines and by what is lit. */
static int32_t case_pdf(int c)
{
    return c % 2 ? LSF_REFLECTIVE_SHADOW_MAP_PDF_ADAPTIVE : LSF_REFLECTIVE_SHADOW_MAP_PDF_UNIFORM;
}

static const char *pdf_name(int32_t pdf)
{
    return pdf == LSF_REFLECTIVE_SHADOW_MAP_PDF_ADAPTIVE ? "adaptive" : "uniform";
}

/* Where a ray back from the VPL starts, and where the VPL lies on it. */
static lsf_float3 ray_start(const light_passes *p, const struct lsf_vpl_data *vpl, double *distance)
{
    if (p->state.lights[0].type != LSF_LIGHT_DIRECTIONAL) {
        *distance = sqrt((double)vpl->to_light.w);
        return lsf_f3_load(p->state.lights[0].position);
    }
    *distance = 4.0;
    return lsf_f3_mad(xyz(vpl->position), xyz(vpl->to_light), 4.0f);
}

static void check_positions(const light_passes *p, const struct lsf_vpl_data *vpls,
                            const char *name)
{
    uint32_t lit = 0, close = 0, right = 0;
    for (uint32_t i = 0; i < COUNT; i++) {
        if (vpls[i].position.w == 0.0f)
            continue;
        double distance;
        lsf_float3 origin = ray_start(p, &vpls[i], &distance), normal = {0};
        lsf_float3 direction = lsf_f3_scale(xyz(vpls[i].to_light), -1.0f);
        double hit = light_passes_trace(p, origin, direction, 0.0, &normal);
        lsf_float3 n = xyz(vpls[i].geometric_normal);
        lit++;
        double facing = fabs((double)lsf_f3_dot(n, direction));
        double off = (double)light_passes_raster_error(p, n, distance) / fmax(facing, 1e-9);
        close += fabs(hit - distance) < 1e-5 + off;
        right += lsf_f3_dot(n, direction) < 0.0f && lsf_f3_length(lsf_f3_cross(n, normal)) < 1e-4f;
    }
    print_message("%s: %u of %u VPLs lit, %u where the ray ends, %u with its normal\n", name, lit,
                  (uint32_t)COUNT, close, right);
    /* Silhouettes run through texels: a few rays go past what the texel's centre meets. */
    assert_true(lit > COUNT / 4);
    assert_true(close >= 0.99 * lit && right >= 0.99 * lit);
}

static void positions_lie_on_surfaces(void **unused)
{
    (void)unused;
    for (int c = 0; c < 2 * LIGHT_CASES; c++) {
        lsf_scene *scene = light_case_scene(&light_cases[c / 2]);
        light_passes p;
        light_passes_init(&p, scene, 256, case_pdf(c), COUNT);
        light_passes_run(&p, 3, 0);
        struct lsf_vpl_data *vpls = light_passes_vpls(&p);
        char *name = lsf_format("%s, %s", light_cases[c / 2].name, pdf_name(case_pdf(c)));
        check_positions(&p, vpls, name);
        free(name);
        free(vpls);
        light_passes_finish(&p);
        destroy_scene(scene);
    }
}

/* What VPLs are counted over: bins of equal solid angle about a point light, of equal area on a
 * directional light's window. Within, points at which to ask for the density. */
enum { BINS_X = 24, BINS_Y = 12, FINE = 40, WIDE = BINS_X * FINE, HIGH = BINS_Y * FINE };

static lsf_float3 domain_point(const light_passes *p, double u, double v)
{
    const struct lsf_light_data *light = &p->rsm.outputs.light;
    if (p->state.lights[0].type != LSF_LIGHT_DIRECTIONAL) {
        double z = 2.0 * v - 1.0, r = sqrt(1.0 - z * z), phi = 2.0 * M_PI * u - M_PI;
        return lsf_f3_add(xyz(light->position),
                          lsf_f3((float)(r * cos(phi)), (float)(r * sin(phi)), (float)z));
    }
    lsf_vec4 window = light->map_window[0];
    double x = 2.0 * u - 1.0 - (double)light->map_offset.x;
    double y = 2.0 * v - 1.0 - (double)light->map_offset.y;
    lsf_float3 at = xyz(light->map_origin);
    at = lsf_f3_mad(at, xyz(light->map_right[0]), (float)x * window.z + window.x);
    return lsf_f3_mad(at, xyz(light->map_up[0]), (float)y * window.w + window.y);
}

static double domain_size(const light_passes *p)
{
    lsf_vec4 window = p->rsm.outputs.light.map_window[0];
    return p->state.lights[0].type != LSF_LIGHT_DIRECTIONAL ? 4.0 * M_PI
                                                            : 4.0 * (double)(window.z * window.w);
}

static uint32_t domain_bin(const light_passes *p, const struct lsf_vpl_data *vpl)
{
    const struct lsf_light_data *light = &p->rsm.outputs.light;
    int x, y;
    if (p->state.lights[0].type != LSF_LIGHT_DIRECTIONAL) {
        lsf_float3 d = lsf_f3_scale(xyz(vpl->to_light), -1.0f);
        x = angle_bin(d.x, d.y, BINS_X);
        y = (int)((d.z + 1.0f) * 0.5f * BINS_Y);
    } else {
        lsf_float3 q = lsf_f3_sub(xyz(vpl->position), xyz(light->map_origin));
        lsf_vec4 window = light->map_window[0];
        float px = (lsf_f3_dot(q, xyz(light->map_right[0])) - window.x) / window.z;
        float py = (lsf_f3_dot(q, xyz(light->map_up[0])) - window.y) / window.w;
        x = (int)((px + light->map_offset.x + 1.0f) * 0.5f * BINS_X);
        y = (int)((py + light->map_offset.y + 1.0f) * 0.5f * BINS_Y);
    }
    x = x < 0 ? 0 : x >= BINS_X ? BINS_X - 1 : x;
    y = y < 0 ? 0 : y >= BINS_Y ? BINS_Y - 1 : y;
    return (uint32_t)(y * BINS_X + x);
}

/* Expected share of VPLs in each bin, by emission_pdf; returns their sum. */
static double integrate_pdf(light_passes *p, int32_t pdf, double expected[BINS_X * BINS_Y])
{
    float(*points)[8] = calloc((size_t)WIDE * HIGH, sizeof *points);
    float *densities = calloc((size_t)WIDE * HIGH, sizeof *densities);
    assert_true(points && densities);
    for (int i = 0; i < WIDE * HIGH; i++) {
        float jitter[2];
        light_passes_random((uint64_t)i, 7, jitter);
        double u = ((double)(i % WIDE) + (double)jitter[0]) / (double)WIDE;
        double v = ((double)(i / WIDE) + (double)jitter[1]) / (double)HIGH;
        lsf_f3_store(points[i], domain_point(p, u, v));
    }
    char *switches = lsf_format("#define LSF_SPOT_LIGHT 1\n#define LSF_DIRECTIONAL_LIGHT 1\n"
                                "#define LSF_EMISSION_ADAPTIVE %d",
                                pdf == LSF_REFLECTIVE_SHADOW_MAP_PDF_ADAPTIVE);
    light_passes_probe(p, "lib/emission_pdf.glsl", switches, "emission_pdf(position)",
                       (const float(*)[8])points, WIDE * HIGH, densities);
    double sum = 0.0, each = domain_size(p) / ((double)WIDE * HIGH);
    memset(expected, 0, BINS_X * BINS_Y * sizeof *expected);
    for (int i = 0; i < WIDE * HIGH; i++) {
        double share = (double)densities[i] * each;
        expected[i / WIDE / FINE * BINS_X + i % WIDE / FINE] += share;
        sum += share;
    }
    free(switches);
    free(points);
    free(densities);
    return sum;
}

static void directions_follow_the_density(void **unused)
{
    (void)unused;
    for (int c = 0; c < 2 * LIGHT_CASES; c++) {
        const int32_t pdf =
            c % 2 ? LSF_REFLECTIVE_SHADOW_MAP_PDF_ADAPTIVE : LSF_REFLECTIVE_SHADOW_MAP_PDF_UNIFORM;
        lsf_scene *scene = light_case_scene(&light_cases[c / 2]);
        light_passes p;
        light_passes_init(&p, scene, 64, pdf, COUNT);
        light_passes_run(&p, 2, 0);
        double expected[BINS_X * BINS_Y], counts[BINS_X * BINS_Y] = {0};
        double integral = integrate_pdf(&p, pdf, expected);
        struct lsf_vpl_data *vpls = light_passes_vpls(&p);
        for (uint32_t i = 0; i < COUNT; i++)
            counts[domain_bin(&p, &vpls[i])]++;
        for (int i = 0; i < BINS_X * BINS_Y; i++)
            expected[i] *= COUNT;
        double z = chi_square_z(counts, expected, BINS_X * BINS_Y, 5.0);
        print_message("%s, %s: density integrates to %.5f, chi square %.2f deviations above\n",
                      light_cases[c / 2].name, pdf_name(pdf), integral, z);
        assert_true(fabs(integral - 1.0) < 5e-3);
        assert_true(z < 4.0);
        free(vpls);
        light_passes_finish(&p);
        destroy_scene(scene);
    }
}

/* The mean of intensity over density is the integral of the intensity over the directions in which
 * the light meets something; under the sun, the irradiance times the projected area. */
static void vpls_carry_the_flux(void **unused)
{
    (void)unused;
    for (int c = 0; c < 2 * LIGHT_CASES; c++) {
        lsf_scene *scene = light_case_scene(&light_cases[c / 2]);
        light_passes p;
        light_passes_init(&p, scene, 256, case_pdf(c), COUNT);
        light_passes_run(&p, 5, 0);
        const lsf_light_state *light = &p.state.lights[0];
        double flux = 0.0, outer = (double)light->cos_outer;
        double inner = fmax((double)light->cos_inner, outer + 1e-3);
        double expected = 4.0 * M_PI * (double)light->intensity[0];
        struct lsf_vpl_data *vpls = light_passes_vpls(&p);
        for (uint32_t i = 0; i < COUNT; i++)
            if (vpls[i].position.w != 0.0f)
                flux += (double)(vpls[i].intensity.x / vpls[i].geometric_normal.w) / COUNT;
        if (light->type == LSF_LIGHT_SPOT)
            /* The ramp is at least 1e-3 wide (shared/light.h). */
            expected *= 0.5 * (1.0 - inner + (inner - outer) / 3.0);
        if (light->type == LSF_LIGHT_DIRECTIONAL) {
            double hits = 0.0;
            for (int i = 0; i < 64 * 64; i++) {
                lsf_float3 origin = domain_point(&p, (i % 64 + 0.5) / 64, (i / 64 + 0.5) / 64);
                hits += isfinite(
                    light_passes_trace(&p, origin, lsf_f3_load(light->direction), 0.0, NULL));
            }
            expected = (double)light->intensity[0] * domain_size(&p) * hits / (64 * 64);
        }
        print_message("%s, %s: flux %.5f, expected %.5f\n", light_cases[c / 2].name,
                      pdf_name(case_pdf(c)), flux, expected);
        /* Uniform emission towards a closed room is exact. */
        bool exact = light->type != LSF_LIGHT_DIRECTIONAL && c % 2 == 0;
        assert_true(fabs(flux - expected) < (exact ? 1e-4 : 0.02) * expected);
        free(vpls);
        light_passes_finish(&p);
        destroy_scene(scene);
    }
}

static void maps_see_what_rays_see(void **unused)
{
    (void)unused;
    enum { POINTS = 4096, VPLS = 8 };
    for (size_t c = 0; c < LIGHT_CASES; c++) {
        lsf_scene *scene = light_case_scene(&light_cases[c]);
        light_passes p;
        light_passes_init(&p, scene, 256, LSF_REFLECTIVE_SHADOW_MAP_PDF_UNIFORM, VPLS);
        light_passes_run(&p, 1, 0);
        struct lsf_vpl_data *vpls = light_passes_vpls(&p);
        float(*points)[8] = calloc(POINTS, sizeof *points);
        float *visible = calloc(POINTS, sizeof *visible);
        uint32_t asked = 0, agreed = 0, leaks = 0, shades = 0;
        for (uint32_t v = 0; v < VPLS; v++) {
            if (vpls[v].position.w == 0.0f)
                continue;
            lsf_float3 n1 = xyz(vpls[v].geometric_normal);
            float clear =
                2e-6f + light_passes_raster_error(&p, n1, sqrt((double)vpls[v].to_light.w));
            lsf_float3 x1 = lsf_f3_mad(xyz(vpls[v].position), n1, clear); /* clear of its plane */
            for (uint32_t i = 0; i < POINTS; i++) {
                float u[2], w[2];
                light_passes_random(i, v, u);
                light_passes_random(i, 1000 + v, w);
                uint32_t t = (uint32_t)(u[0] * (float)p.triangle_count);
                const lsf_float3 *corner = p.corners + 3 * t;
                float b1, b2;
                lsf_sample_triangle(w[0], w[1], &b1, &b2);
                lsf_float3 x = lsf_f3_mad(
                    lsf_f3_mad(lsf_f3_scale(corner[0], 1 - b1 - b2), corner[1], b1), corner[2], b2);
                lsf_float3 n = lsf_f3_normalize(lsf_f3_cross(lsf_f3_sub(corner[1], corner[0]),
                                                             lsf_f3_sub(corner[2], corner[0])));
                /* The board has two sides; of what is closed, only the outside is ever lit. */
                bool board = t + 2 >= p.triangle_count;
                if (board && lsf_f3_dot(n, lsf_f3_sub(x1, x)) < 0.0f)
                    n = lsf_f3_scale(n, -1.0f);
                lsf_f3_store(points[i], x);
                lsf_f3_store(points[i] + 4, n);
            }
            lsf_vpl_shadow_map(&p.vpl, &p.iteration, v);
            const lsf_shadow shadow = lsf_vpl_shadow(&p.vpl, v);
            lsf_shadow_bind(&shadow);
            light_passes_probe(&p, "lib/shadow.glsl", "#define LSF_SHADOW_HEMISPHERE 1",
                               "shadow_visibility(position, normal)", (const float(*)[8])points,
                               POINTS, visible);
            for (uint32_t i = 0; i < POINTS; i++) {
                lsf_float3 to = lsf_f3_sub(lsf_f3_load(points[i]), x1);
                float distance = lsf_f3_length(to);
                lsf_float3 direction = lsf_f3_scale(to, 1.0f / distance);
                if (lsf_f3_dot(direction, n1) < 1e-3f || distance < 1e-3f ||
                    lsf_f3_dot(direction, lsf_f3_load(points[i] + 4)) > -1e-3f)
                    continue;
                bool seen =
                    light_passes_trace(&p, x1, direction, 1e-5, NULL) > (double)distance - 1e-5;
                asked++;
                agreed += seen == (visible[i] != 0.0f);
                leaks += !seen && visible[i] != 0.0f;
                shades += seen && visible[i] == 0.0f;
            }
        }
        print_message("%s: %.4f of %u points agree; %u are lit but hidden, %u hidden but lit\n",
                      light_cases[c].name, (double)agreed / asked, asked, leaks, shades);
        assert_true(asked > 4000 && agreed >= 0.99 * asked);
        free(points);
        free(visible);
        free(vpls);
        light_passes_finish(&p);
        destroy_scene(scene);
    }
}

/* VPLs and a map of one of them; free both. */
static void render_bits(const char *threads, struct lsf_vpl_data **vpls, uint32_t **maps)
{
    lsf_scene *scene = light_case_scene(&light_cases[1]);
    light_passes p;
    setenv("LP_NUM_THREADS", threads, 1);
    light_passes_init(&p, scene, 128, LSF_REFLECTIVE_SHADOW_MAP_PDF_ADAPTIVE, COUNT);
    light_passes_run(&p, 4, 0);
    *vpls = light_passes_vpls(&p);
    *maps = calloc(256 * 256, sizeof **maps);
    lsf_vpl_shadow_map(&p.vpl, &p.iteration, 1);
    glGetTextureImage(p.vpl.outputs.shadow_map, 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                      256 * 256 * sizeof **maps, *maps);
    light_passes_finish(&p);
    unsetenv("LP_NUM_THREADS");
    destroy_scene(scene);
}

static void same_bits_for_any_threads(void **unused)
{
    (void)unused;
    static const char *const threads[] = {"0", "1", "8"};
    struct lsf_vpl_data *vpls[3];
    uint32_t *maps[3];
    for (int i = 0; i < 3; i++) {
        render_bits(threads[i], &vpls[i], &maps[i]);
        assert_memory_equal(vpls[0], vpls[i], COUNT * sizeof *vpls[0]);
        assert_memory_equal(maps[0], maps[i], 256 * 256 * sizeof *maps[0]);
    }
    for (int i = 0; i < 3; i++) {
        free(vpls[i]);
        free(maps[i]);
    }
}

/* A light on a surface, one that meets nothing, one that shines past its range, and no scene at
 * all: every number stays finite, and what is not lit says so. */
static void extremes_stay_finite(void **unused)
{
    (void)unused;
    static const struct {
        const char *name;
        bool empty;
        light_case light;
        float range;
        bool lights;
    } extremes[] = {
        {"on the floor",
         false,
         {"", LSF_LIGHT_POINT, {0.6f, -0.8f, 0.6f}, {0, -1, 0}, 0, 0},
         INFINITY,
         true},
        {"into space",
         false,
         {"", LSF_LIGHT_SPOT, {0, 5, 0}, {0, 1, 0}, 0.2f, 0.4f},
         INFINITY,
         false},
        {"out of range", false, {"", LSF_LIGHT_POINT, {0, 0.5f, 0}, {0, 1, 0}, 0, 0}, 0.05f, false},
        {"no scene", true, {"", LSF_LIGHT_POINT, {0, 0, 0}, {0, 1, 0}, 0, 0}, INFINITY, false},
        {"no scene, sun",
         true,
         {"", LSF_LIGHT_DIRECTIONAL, {0, 0, 0}, {0, 1, 0}, 0, 0},
         INFINITY,
         false},
    };
    for (size_t i = 0; i < 2 * LSF_COUNT(extremes); i++) {
        size_t e = i / 2;
        lsf_scene *scene = extremes[e].empty ? build_scene() : light_case_scene(&extremes[e].light);
        if (extremes[e].empty) {
            build_light(scene, extremes[e].light.type, lsf_f3(0, 0, 0), lsf_f3(0, -1, 0), 1.0f);
            finish_gl_scene(scene);
        }
        scene->lights[0].range = extremes[e].range;
        light_passes p;
        light_passes_init(&p, scene, 64, (int32_t)(i % 2), 256);
        light_passes_run(&p, 0, 0);
        struct lsf_vpl_data *vpls = light_passes_vpls(&p);
        uint32_t lit = 0;
        for (uint32_t v = 0; v < 256; v++) {
            const float *numbers = &vpls[v].position.x;
            for (size_t n = 0; n < sizeof *vpls / sizeof *numbers; n++)
                assert_true(isfinite(numbers[n]));
            lit += vpls[v].position.w != 0.0f;
        }
        lsf_vpl_shadow_map(&p.vpl, &p.iteration, 0);
        print_message("%s, %s: %u of 256 lit\n", extremes[e].name, pdf_name((int32_t)(i % 2)), lit);
        assert_true((lit > 0) == extremes[e].lights);
        free(vpls);
        light_passes_finish(&p);
        destroy_scene(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(positions_lie_on_surfaces),
        cmocka_unit_test(directions_follow_the_density),
        cmocka_unit_test(vpls_carry_the_flux),
        cmocka_unit_test(maps_see_what_rays_see),
        cmocka_unit_test(same_bits_for_any_threads),
        cmocka_unit_test(extremes_stay_finite),
    };
    return cmocka_run_group_tests_name("vpl", tests, NULL, NULL);
}
