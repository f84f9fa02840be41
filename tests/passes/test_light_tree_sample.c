/* Light from a cloud by way of its tree, against the sum over all of the cloud's VPLs, with nothing
 * and with triangles between. */
#include <math.h>

#include "base/base.h"
#include "light_tree_rig.h"
#include "math/sampling.h"
#include "octahedral.h"
#include "passes/light_tree_sample.h"
#include "shared/brdf.h"
#include "surface_rig.h"

enum { SIDE = 8, PIXELS = SIDE * SIDE, VPLS = 3000, SHADES = 20 };

typedef struct rig {
    surface_rig surfaces;
    lsf_light_tree tree;
    lsf_light_tree_sample sample;
    lsf_voxels voxels;
    GLuint cloud;
    lsf_float3 shades[SHADES][3]; /* triangles, where sight is exact */
    lsf_float3 positions[PIXELS], normal;
} rig;

typedef struct sums {
    double mean[PIXELS], square[PIXELS]; /* over iterations */
    double lost[PIXELS];
} sums;

/* Radii; so far that spikes do not spoil statistics. */
#define BOUND 4.0f

/* Of the wall, a number that 16 bits hold. */
#define F0 0.2f
#define ROUGHNESS 0.8f

/* A wall across the room, from its middle to its sides. */
static void see_wall(rig *r)
{
    surface_rig *s = &r->surfaces;
    seen wall = surface_rig_wall(s, 0.7f);
    wall.roughness = ROUGHNESS;
    lsf_float3 eye = lsf_f3_load(&s->iteration.view.start.x);
    r->normal = wall.plane;
    for (uint32_t i = 0; i < PIXELS; i++) {
        surface_rig_see(s, i % SIDE, i / SIDE, &wall);
        s->glosses[i][0] |= (uint32_t)lrintf(F0 * 65535.0f) << 16;
        r->positions[i] = lsf_f3_mad(eye, surface_rig_ray(s, i % SIDE, i / SIDE), 0.7f);
    }
    surface_rig_upload(s);
}

/* The room's middle is where the view looks. */
static void move_cloud(const rig *r, struct lsf_vpl_record *records, uint32_t count)
{
    const struct lsf_view_data *view = &r->surfaces.iteration.view;
    for (uint32_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++)
            (&records[i].position.x)[axis] +=
                (&view->start.x)[axis] + 0.75f * (&view->forward.x)[axis];
}

/* Triangles at random between the wall and most of the room, and a grid whose voxels are too small
 * to lift anything above a surface. */
static void hang_shades(rig *r)
{
    lsf_error error = {0};
    const struct lsf_voxel_grid_data grid = {.origin = {.w = 1e-9f}, .size = {.w = 1e9f}};
    surface_rig *s = &r->surfaces;
    lsf_float3 eye = lsf_f3_load(&s->iteration.view.start.x);
    for (uint32_t i = 0; i < SHADES; i++) {
        lsf_float3 place = lsf_f3_mad(eye, surface_rig_ray(s, i % SIDE, i * 5 % SIDE), 0.6f);
        for (uint32_t k = 0; k < 3; k++) {
            uint64_t n = 9 * (uint64_t)i + 3 * k;
            lsf_float3 offset = {lsf_random_float(3, n), lsf_random_float(3, n + 1),
                                 lsf_random_float(3, n + 2)};
            offset = lsf_f3_sub(offset, lsf_f3(0.5f, 0.5f, 0.5f));
            r->shades[i][k] = lsf_f3_mad(place, offset, 0.2f);
        }
    }
    s->scene_gpu.triangle_count = SHADES;
    s->scene_gpu.triangles =
        lsf_buffer_create(s->context, "shades", sizeof r->shades, r->shades, 0, &error);
    r->voxels.grid_buffer = lsf_buffer_create(s->context, "grid", sizeof grid, &grid, 0, &error);
    if (!s->scene_gpu.triangles || !r->voxels.grid_buffer)
        fail_msg("%s", error.message);
}

static void rig_begin(rig *r, struct lsf_vpl_record *records, uint32_t count,
                      const lsf_light_tree_sample_params *params, bool covariance)
{
    lsf_error error = {0};
    const lsf_light_tree_params tree = {LSF_LIGHT_TREE_PARAMS_DEFAULTS, .covariance = covariance};
    memset(r, 0, sizeof *r);
    surface_rig_begin(&r->surfaces, SIDE, SIDE, false);
    lsf_plan *plan = r->surfaces.setup.plan;
    lsf_context *context = r->surfaces.context;
    plan->samples = 1; /* bounds are those of a single iteration */
    lsf_light_tree_plan(plan, &tree, count, "cloud");
    lsf_light_tree_sample_plan(plan, params, covariance, false);
    surface_rig_start(&r->surfaces);
    move_cloud(r, records, count);
    r->cloud = lsf_buffer_create(context, "cloud", count * sizeof *records, records, 0, &error);
    if (!r->cloud || !lsf_light_tree_create(&r->tree, context, plan, &tree, count, &error) ||
        !lsf_light_tree_sample_create(&r->sample, context, plan, params, &error))
        fail_msg("%s", error.message);
    see_wall(r);
    if (params->sight == LSF_LIGHT_TREE_EXACT)
        hang_shades(r);
    lsf_light_tree_run(&r->tree, &r->surfaces.iteration, r->cloud);
}

static void rig_end(rig *r)
{
    lsf_context *context = r->surfaces.context;
    lsf_buffer_destroy(context, &r->cloud);
    lsf_buffer_destroy(context, &r->voxels.grid_buffer);
    lsf_buffer_destroy(context, &r->surfaces.scene_gpu.triangles);
    lsf_light_tree_destroy(&r->tree);
    lsf_light_tree_sample_destroy(&r->sample);
    surface_rig_end(&r->surfaces);
}

static void run_once(rig *r, uint32_t index, float (*irradiance)[4], float (*specular)[4])
{
    const lsf_light_tree_sample_inputs inputs = {
        .seen = &r->surfaces.maps, .voxels = &r->voxels, .tree = &r->tree.outputs};
    r->surfaces.iteration.index = index;
    lsf_light_tree_sample_run(&r->sample, &r->surfaces.iteration, &inputs);
    surface_rig_read(r->sample.light.irradiance, SIDE, SIDE, irradiance[0]);
    surface_rig_read(r->sample.light.specular, SIDE, SIDE, specular[0]);
}

/* Of both parts' luminance. */
static void run(rig *r, uint32_t iterations, sums parts[2])
{
    static float light[2][PIXELS][4];
    memset(parts, 0, 2 * sizeof *parts);
    for (uint32_t i = 0; i < iterations; i++) {
        run_once(r, i, light[0], light[1]);
        for (int part = 0; part < 2; part++)
            for (uint32_t k = 0; k < PIXELS; k++) {
                double value = (double)lsf_f3_luminance(lsf_f3_load(light[part][k]));
                parts[part].mean[k] += value / iterations;
                parts[part].square[k] += value * value / iterations;
                parts[part].lost[k] += (double)light[part][k][3] / iterations;
                assert_true(isfinite(value) && isfinite(light[part][k][3]));
            }
    }
}

/* Whether the way from x meets a triangle, in double precision: by the volumes of tetrahedra, whose
 * signs say on which side what lies. */
static double volume(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static bool hidden(const rig *r, lsf_float3 x, lsf_float3 way)
{
    const double w[3] = {(double)way.x, (double)way.y, (double)way.z};
    for (uint32_t i = 0; i < SHADES; i++) {
        double q[3][3], e[2][3], n[3];
        for (int k = 0; k < 3; k++) {
            lsf_float3 p = r->shades[i][k];
            q[k][0] = (double)p.x - (double)x.x;
            q[k][1] = (double)p.y - (double)x.y;
            q[k][2] = (double)p.z - (double)x.z;
        }
        double a = volume(w, q[0], q[1]), b = volume(w, q[1], q[2]), c = volume(w, q[2], q[0]);
        if (!((a >= 0.0 && b >= 0.0 && c >= 0.0) || (a <= 0.0 && b <= 0.0 && c <= 0.0)))
            continue;
        for (int axis = 0; axis < 3; axis++)
            for (int k = 0; k < 2; k++)
                e[k][axis] = q[k + 1][axis] - q[0][axis];
        for (int axis = 0; axis < 3; axis++)
            n[axis] = e[0][(axis + 1) % 3] * e[1][(axis + 2) % 3] -
                      e[0][(axis + 2) % 3] * e[1][(axis + 1) % 3];
        double plane = n[0] * q[0][0] + n[1] * q[0][1] + n[2] * q[0][2];
        double along = n[0] * w[0] + n[1] * w[1] + n[2] * w[2];
        if (plane * along > 0.0 && fabs(plane) < fabs(along))
            return true;
    }
    return false;
}

/* The sum over all VPLs, of which each is no nearer than its disc's radius, in closed form: a rough
 * surface's. */
static void sum_all(const rig *r, const struct lsf_vpl_record *records, uint32_t count,
                    double bound, double irradiance[PIXELS], double specular[PIXELS])
{
    read_tree read = read_tree_of(&r->tree);
    const float alpha = lsf_alpha_from_roughness(ROUGHNESS);
    memset(irradiance, 0, PIXELS * sizeof *irradiance);
    memset(specular, 0, PIXELS * sizeof *specular);
    lsf_float3 eye = lsf_f3_load(&r->surfaces.iteration.view.start.x);
    for (uint32_t k = 0; k < PIXELS; k++)
        for (uint32_t i = 0; i < count; i++) {
            if (!cloud_shines(&records[i]))
                continue;
            lsf_float3 x = r->positions[k], view = lsf_f3_normalize(lsf_f3_sub(eye, x));
            lsf_float3 way = lsf_f3_sub(lsf_f3_load(&records[i].position.x), x);
            double distance2 = (double)lsf_f3_dot(way, way);
            lsf_float3 w = lsf_f3_normalize(way);
            double leaves = -(double)lsf_f3_dot(octahedral_decode(records[i].normal), w);
            float arrives = lsf_f3_dot(r->normal, w);
            if (leaves <= 0.0 || arrives <= 0.0f)
                continue;
            if (r->voxels.grid_buffer && hidden(r, x, way))
                continue;
            lsf_float3 h = lsf_f3_normalize(lsf_f3_add(view, w));
            float fresnel = lsf_fresnel_schlick(F0, lsf_f3_dot(view, h));
            double light = (double)cloud_luminance(records[i].intensity) * leaves *
                           (double)arrives / fmax(distance2, bound * (double)read.areas[i]);
            irradiance[k] += light * (1.0 - (double)fresnel);
            float nh = lsf_f3_dot(r->normal, h), d = lsf_ggx_d(nh, 1.0f - nh * nh, alpha);
            specular[k] += light * (double)(fresnel * d *
                                            lsf_ggx_v(arrives, lsf_f3_dot(r->normal, view), alpha));
        }
    read_tree_free(&read);
}

typedef struct comparison {
    double bias, deviation; /* of all pixels' mean; of a pixel's single sample; relative */
    double worst, spread;   /* errors in standard errors: the largest, and their root mean square */
} comparison;

static comparison compare(const sums *s, const double expected[PIXELS], uint32_t iterations,
                          uint32_t samples)
{
    comparison c = {0};
    double sum = 0.0, error = 0.0;
    for (uint32_t k = 0; k < PIXELS; k++) {
        double variance = fmax(s->square[k] - s->mean[k] * s->mean[k], 0.0);
        double z = (s->mean[k] - expected[k]) / sqrt(variance / iterations + 1e-30);
        c.worst = fmax(c.worst, fabs(z));
        c.spread += z * z / PIXELS;
        c.deviation += variance * samples / (expected[k] * expected[k]) / PIXELS;
        sum += expected[k];
        error += s->mean[k] - expected[k];
    }
    c.bias = error / sum;
    c.deviation = sqrt(c.deviation);
    c.spread = sqrt(c.spread);
    return c;
}

static void print_counts(rig *r)
{
    const uint64_t *counts = lsf_light_tree_sample_counts(&r->sample);
    double all = (double)counts[LSF_LIGHT_TREE_SAMPLE_ALL];
    print_message("  %.1f steps a sample, %.2f %% dead\n",
                  (double)counts[LSF_LIGHT_TREE_SAMPLE_STEPS] / all,
                  100.0 * (double)counts[LSF_LIGHT_TREE_SAMPLE_DEAD] / all);
}

/* Means against the sum, both parts. */
static void measure(int32_t node, uint32_t count, uint32_t iterations, float cut, bool covariance,
                    lsf_light_tree_sight sight, comparison c[2])
{
    static const char *const names[] = {"substitute", "lightcut", "vpl"};
    static const char *const parts[] = {"diffuse", "specular"};
    static rig r;
    static sums s[2];
    static double expected[2][PIXELS];
    const lsf_light_tree_sample_params params = {.node = node,
                                                 .angle = 0.25f,
                                                 .cut = cut,
                                                 .samples = LSF_LIGHT_TREE_SAMPLE_MOST,
                                                 .bound = BOUND,
                                                 .sight = (int32_t)sight};
    struct lsf_vpl_record *records = cloud_make(CLOUD_ROOM, count, 5);
    rig_begin(&r, records, count, &params, covariance);
    sum_all(&r, records, count, (double)(BOUND * BOUND), expected[0], expected[1]);
    run(&r, iterations, s);
    for (int part = 0; part < 2; part++) {
        c[part] = compare(&s[part], expected[part], iterations, LSF_LIGHT_TREE_SAMPLE_MOST);
        print_message(
            "%s%s, cut %.2g%s, %s: bias %.3f %%, deviation of a sample %.0f %%, errors %.2f "
            "standard errors, %.2f at most\n",
            names[node], sight == LSF_LIGHT_TREE_EXACT ? " behind triangles" : "", (double)cut,
            covariance ? " with covariance" : "", parts[part], 100.0 * c[part].bias,
            100.0 * c[part].deviation, c[part].spread, c[part].worst);
    }
    print_counts(&r);
    free(records);
    rig_end(&r);
}

static void test_means(void **state)
{
    (void)state;
    comparison c[2];
    static const struct {
        int32_t node;
        float cut;
        bool covariance;
        lsf_light_tree_sight sight;
    } cases[] = {
        {LSF_LIGHT_TREE_SUBSTITUTE, 0.0f, false, LSF_LIGHT_TREE_OPEN},
        {LSF_LIGHT_TREE_SUBSTITUTE, 0.5f, false, LSF_LIGHT_TREE_OPEN},
        {LSF_LIGHT_TREE_SUBSTITUTE, 0.5f, true, LSF_LIGHT_TREE_OPEN},
        {LSF_LIGHT_TREE_LIGHTCUT, 0.0f, false, LSF_LIGHT_TREE_OPEN},
        {LSF_LIGHT_TREE_LIGHTCUT, 0.5f, false, LSF_LIGHT_TREE_OPEN},
        {LSF_LIGHT_TREE_VPL, 0.0f, false, LSF_LIGHT_TREE_OPEN},
        {LSF_LIGHT_TREE_LIGHTCUT, 0.5f, false, LSF_LIGHT_TREE_EXACT},
    };
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        int32_t node = cases[i].node;
        /* Where little is seen, errors of few samples are far from normal. */
        uint32_t iterations = cases[i].sight == LSF_LIGHT_TREE_EXACT ? 96 : 32;
        measure(node, VPLS, iterations, cases[i].cut, cases[i].covariance, cases[i].sight, c);
        for (int part = 0; part < 2; part++) {
            bool exact = node != LSF_LIGHT_TREE_SUBSTITUTE || part == 1;
            /* Four standard errors of all the samples' mean. */
            double mean_error = 4.0 * c[part].deviation /
                                sqrt((double)iterations * LSF_LIGHT_TREE_SAMPLE_MOST * PIXELS);
            assert_true(fabs(c[part].bias) < mean_error + (exact ? 0.0 : 0.01));
            assert_true(!exact || (c[part].worst < 4.5 && c[part].spread < 1.3));
        }
    }
}

/* One run of 32 samples; light of both parts. */
static void render_cloud(struct lsf_vpl_record *records, uint32_t count,
                         const lsf_light_tree_sample_params *params, float light[2][PIXELS][4])
{
    static rig r;
    rig_begin(&r, records, count, params, false);
    run_once(&r, 0, light[0], light[1]);
    rig_end(&r);
}

/* By luminance alone the same VPLs are drawn with any bound: what one takes away is what the other
 * has more. */
static void test_bound(void **state)
{
    (void)state;
    static float light[3][2][PIXELS][4];
    for (int i = 0; i < 3; i++) {
        const lsf_light_tree_sample_params params = {.node = LSF_LIGHT_TREE_VPL,
                                                     .samples = LSF_LIGHT_TREE_SAMPLE_MOST,
                                                     .bound = 10.0f * (float)i,
                                                     .sight = LSF_LIGHT_TREE_OPEN};
        struct lsf_vpl_record *records = cloud_make(CLOUD_ROOM, 500, 5);
        render_cloud(records, 500, &params, light[i]);
        free(records);
    }
    double lost[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++)
        for (int part = 0; part < 2; part++)
            for (uint32_t k = 0; k < PIXELS; k++) {
                const float *exact = light[0][part][k], *held = light[i][part][k];
                double all = (double)lsf_f3_luminance(lsf_f3_load(exact));
                double kept = (double)lsf_f3_luminance(lsf_f3_load(held));
                assert_true(fabs(kept + (double)held[3] - all) <= 1e-5 * all);
                lost[i] += (double)held[3];
            }
    assert_true(lost[0] == 0.0 && lost[1] > 0.0 && lost[2] > lost[1]);
}

static void assert_finite(float light[2][PIXELS][4])
{
    for (int part = 0; part < 2; part++)
        for (uint32_t k = 0; k < PIXELS; k++)
            for (int c = 0; c < 4; c++)
                assert_true(isfinite(light[part][k][c]) && light[part][k][c] >= 0.0f);
}

/* Without a VPL there is no light; one on each point, or one far brighter than the rest, is no
 * harm. */
static void test_extremes(void **state)
{
    (void)state;
    enum { COUNT = 300 };
    static const cloud_kind kinds[] = {CLOUD_DEAD, CLOUD_BRIGHT, CLOUD_SAME, CLOUD_POINT};
    static float light[2][PIXELS][4];
    for (int32_t node = LSF_LIGHT_TREE_SUBSTITUTE; node <= LSF_LIGHT_TREE_VPL; node++) {
        const lsf_light_tree_sample_params params = {
            .node = node, .samples = 8, .sight = LSF_LIGHT_TREE_OPEN};
        for (size_t i = 0; i < LSF_COUNT(kinds); i++) {
            struct lsf_vpl_record *records = cloud_make(kinds[i], COUNT, 5);
            render_cloud(records, COUNT, &params, light);
            assert_finite(light);
            for (uint32_t k = 0; k < PIXELS && kinds[i] == CLOUD_DEAD; k++)
                assert_true(light[0][k][0] == 0.0f && light[1][k][0] == 0.0f);
            free(records);
        }
    }
}

/* On each shaded point, facing both ways. */
static void test_on_points(void **state)
{
    (void)state;
    static rig r;
    static float light[2][PIXELS][4];
    for (int32_t node = LSF_LIGHT_TREE_SUBSTITUTE; node <= LSF_LIGHT_TREE_VPL; node++) {
        const lsf_light_tree_sample_params params = {
            .node = node, .samples = 8, .sight = LSF_LIGHT_TREE_OPEN};
        struct lsf_vpl_record *records = cloud_make(CLOUD_ROOM, PIXELS, 5);
        rig_begin(&r, records, PIXELS, &params, false);
        for (uint32_t k = 0; k < PIXELS; k++) {
            lsf_float3 p = r.positions[k], n = lsf_f3_scale(r.normal, k % 2 ? 1.0f : -1.0f);
            records[k].position = (lsf_vec3){p.x, p.y, p.z};
            records[k].normal = octahedral_encode(n);
        }
        lsf_error error = {0};
        lsf_buffer_destroy(r.surfaces.context, &r.cloud);
        r.cloud = lsf_buffer_create(r.surfaces.context, "cloud", PIXELS * sizeof *records, records,
                                    0, &error);
        lsf_light_tree_run(&r.tree, &r.surfaces.iteration, r.cloud);
        run_once(&r, 0, light[0], light[1]);
        assert_finite(light);
        free(records);
        rig_end(&r);
    }
}

/* 2^40 times the intensity gives 2^40 times the light, to the bit. */
static void test_scaled(void **state)
{
    (void)state;
    enum { COUNT = 2000 };
    static float light[2][2][PIXELS][4];
    const lsf_light_tree_sample_params params = {LSF_LIGHT_TREE_SAMPLE_PARAMS_DEFAULTS,
                                                 .samples = 4, .sight = LSF_LIGHT_TREE_OPEN};
    for (int i = 0; i < 2; i++) {
        struct lsf_vpl_record *records = cloud_make(CLOUD_ROOM, COUNT, 5);
        for (uint32_t k = 0; k < COUNT && i == 1; k++)
            for (int c = 0; c < 3; c++)
                (&records[k].intensity.x)[c] *= 0x1p40f;
        render_cloud(records, COUNT, &params, light[i]);
        free(records);
    }
    for (int part = 0; part < 2; part++)
        for (uint32_t k = 0; k < PIXELS; k++)
            for (int c = 0; c < 4; c++)
                assert_true(light[1][part][k][c] == 0x1p40f * light[0][part][k][c]);
}

int main(int argc, char **argv)
{
    /* With a number, a cloud of as many, in more detail. */
    if (argc > 1) {
        static const float cuts[] = {0.0f, 0.5f, 0.25f};
        comparison c[2];
        for (int32_t node = LSF_LIGHT_TREE_SUBSTITUTE; node <= LSF_LIGHT_TREE_VPL; node++)
            for (int i = 0; i < (node == LSF_LIGHT_TREE_VPL ? 1 : 3); i++)
                measure(node, (uint32_t)atoi(argv[1]), 32, cuts[i], false, LSF_LIGHT_TREE_OPEN, c);
        measure(LSF_LIGHT_TREE_SUBSTITUTE, (uint32_t)atoi(argv[1]), 32, cuts[1], true,
                LSF_LIGHT_TREE_OPEN, c);
        return 0;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_means), cmocka_unit_test(test_bound), cmocka_unit_test(test_extremes),
        cmocka_unit_test(test_on_points), cmocka_unit_test(test_scaled)};
    return cmocka_run_group_tests_name("light_tree_sample", tests, NULL, NULL);
}
