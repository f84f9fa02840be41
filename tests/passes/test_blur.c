/* The blur on surfaces made by hand: what stays, what is shared, how far, and what is kept apart.
 */
#include <math.h>

#include "base/base.h"
#include "math/sampling.h"
#include "passes/blur.h"
#include "surface_rig.h"

typedef struct rig {
    surface_rig s;
    lsf_blur_params params;
    lsf_blur pass;
    GLuint irradiance, specular;
    float (*in)[2][4], (*out)[2][4]; /* irradiance, specular of each texel */
    float (*texels)[4];
} rig;

static void rig_begin_view(rig *r, uint32_t width, uint32_t height, bool orthographic)
{
    memset(r, 0, sizeof *r);
    r->params = (lsf_blur_params){LSF_BLUR_PARAMS_DEFAULTS, .phases = 5};
    surface_rig_begin(&r->s, width, height, orthographic);
    r->in = calloc(width * height, sizeof *r->in);
    r->out = calloc(width * height, sizeof *r->out);
    r->texels = calloc(width * height, sizeof *r->texels);
    assert_true(r->in && r->out && r->texels);
}

static void rig_begin(rig *r, uint32_t width, uint32_t height)
{
    rig_begin_view(r, width, height, false);
}

/* With the params that the test has set. */
static void rig_start(rig *r)
{
    lsf_error error = {0};
    lsf_plan *plan = r->s.setup.plan;
    lsf_blur_plan(plan, &r->params);
    surface_rig_start(&r->s);
    if (!lsf_blur_create(&r->pass, r->s.context, plan, &r->params, &error))
        fail_msg("%s", error.message);
    r->irradiance = surface_rig_texture(&r->s, GL_RGBA32F, r->s.width, r->s.height);
    r->specular = surface_rig_texture(&r->s, GL_RGBA32F, r->s.width, r->s.height);
}

static void rig_end(rig *r)
{
    lsf_texture_destroy(r->s.context, &r->irradiance);
    lsf_texture_destroy(r->s.context, &r->specular);
    lsf_blur_destroy(&r->pass);
    surface_rig_end(&r->s);
    free(r->in);
    free(r->out);
    free(r->texels);
}

static void rig_run(rig *r)
{
    uint32_t w = r->s.width, h = r->s.height;
    const GLuint in[2] = {r->irradiance, r->specular};
    surface_rig_upload(&r->s);
    for (int part = 0; part < 2; part++) {
        for (uint32_t i = 0; i < w * h; i++)
            memcpy(r->texels[i], r->in[i][part], sizeof *r->texels);
        surface_rig_write(in[part], w, h, r->texels[0]);
    }
    const lsf_split_light light = {r->irradiance, r->specular};
    const lsf_blur_inputs inputs = {.seen = &r->s.maps, .light = &light};
    lsf_blur_run(&r->pass, &r->s.iteration, &inputs);
    const GLuint out[2] = {r->pass.light.irradiance, r->pass.light.specular};
    for (int part = 0; part < 2; part++) {
        surface_rig_read(out[part], w, h, r->texels[0]);
        for (uint32_t i = 0; i < w * h; i++)
            memcpy(r->out[i][part], r->texels[i], sizeof *r->texels);
    }
}

static void set_light(rig *r, uint32_t x, uint32_t y, float irradiance, float specular)
{
    for (int c = 0; c < 4; c++) {
        r->in[y * r->s.width + x][0][c] = irradiance;
        r->in[y * r->s.width + x][1][c] = specular;
    }
}

/* Over any surfaces. */
static void a_constant_stays_to_the_bit(void **unused)
{
    (void)unused;
    static const uint32_t sizes[][2] = {{1, 1}, {7, 13}, {80, 33}};
    for (size_t s = 0; s < LSF_COUNT(sizes); s++) {
        rig r;
        rig_begin(&r, sizes[s][0], sizes[s][1]);
        rig_start(&r);
        for (uint32_t y = 0; y < r.s.height; y++)
            for (uint32_t x = 0; x < r.s.width; x++) {
                uint32_t i = y * r.s.width + x;
                seen point = surface_rig_wall(&r.s, 1.0f + 0.01f * lsf_random_float(3, i));
                point.normal.x += 0.3f * lsf_random_float(5, i);
                point.normal = lsf_f3_normalize(point.normal);
                point.roughness = lsf_random_float(4, i);
                surface_rig_see(&r.s, x, y, &point);
                set_light(&r, x, y, 0.1f, 1.3e5f);
            }
        rig_run(&r);
        assert_memory_equal(r.out, r.in, r.s.width * r.s.height * sizeof *r.in);
        rig_end(&r);
    }
}

/* The half width of an impulse's picture along x, and its sum. */
static void measure(const rig *r, int part, uint32_t cx, uint32_t cy, uint32_t *reach, double *sum)
{
    *reach = 0;
    *sum = 0.0;
    for (uint32_t y = 0; y < r->s.height; y++)
        for (uint32_t x = 0; x < r->s.width; x++) {
            float value = r->out[y * r->s.width + x][part][0];
            *sum += (double)value;
            uint32_t away = x > cx ? x - cx : cx - x;
            if (value > 0.0f && y == cy && away > *reach)
                *reach = away;
        }
}

/* On a wall across the view, phases with steps 1, 2, 4, ... make a tent of half width 2^phases in
 * which an impulse's energy is kept. Irradiance takes all phases; the specular part those of its
 * roughness. */
static void an_impulse_becomes_a_tent(void **unused)
{
    (void)unused;
    /* Brackets from 0.1, 0.18 wide each. */
    static const struct {
        float roughness, anisotropy;
        int phases;
    } cases[] = {{0.0f, 0.0f, 0},
                 {0.09f, 0.0f, 0},
                 {0.11f, 0.0f, 1},
                 {0.27f, 0.0f, 1},
                 {0.29f, 0.0f, 2},
                 {0.47f, 0.0f, 3},
                 {0.65f, 0.0f, 4},
                 {0.83f, 0.0f, 5},
                 {1.0f, 0.0f, 5},
                 /* along the tangent alpha is 1 (0.5)^2 of the way from 0.01 to 1: sqrt(0.2575) */
                 {0.1f, 0.5f, 3}};
    rig r;
    rig_begin(&r, 81, 81);
    r.params.ratio = 2.0f;
    r.params.growth = 0.0f;
    rig_start(&r);
    for (size_t c = 0; c < LSF_COUNT(cases); c++) {
        seen point = surface_rig_wall(&r.s, 1.0f);
        point.roughness = cases[c].roughness;
        point.anisotropy = cases[c].anisotropy;
        for (uint32_t y = 0; y < r.s.height; y++)
            for (uint32_t x = 0; x < r.s.width; x++) {
                surface_rig_see(&r.s, x, y, &point);
                set_light(&r, x, y, 0.0f, 0.0f);
            }
        set_light(&r, 40, 40, 1.0f, 1.0f);
        rig_run(&r);
        const int phases[2] = {5, cases[c].phases};
        for (int part = 0; part < 2; part++) {
            uint32_t reach;
            double sum, half_width = ldexp(1.0, phases[part]), worst = 0.0;
            measure(&r, part, 40, 40, &reach, &sum);
            assert_int_equal(reach, (1 << phases[part]) - 1);
            assert_true(fabs(sum - 1.0) < 1e-5);
            for (int y = 0; y < 81; y++)
                for (int x = 0; x < 81; x++) {
                    double tent = fmax(half_width - abs(x - 40), 0.0) *
                                  fmax(half_width - abs(y - 40), 0.0) / pow(half_width, 4.0);
                    worst = fmax(worst, fabs((double)r.out[y * 81 + x][part][0] - tent));
                }
            /* Ten roundings of weights and normals of 7 bits that agree everywhere. */
            assert_true(worst < 1e-6);
        }
    }
    rig_end(&r);
}

static double sum_of(const float (*texels)[2][4], uint32_t count)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++)
        sum += (double)texels[i][0][0];
    return sum;
}

/* On a plane that the view meets at a slant, light is kept where texels of all distances take the
 * same steps; where steps grow with distance a texel may take from one that takes from others. */
static void energy_is_kept_but_for_growth(void **unused)
{
    (void)unused;
    static const double tolerance[] = {1e-5, 0.004};
    for (int grows = 0; grows < 2; grows++) {
        rig r;
        rig_begin(&r, 96, 64);
        r.params.cutoff = 1e3f; /* no texel is too far */
        if (!grows)
            r.params.growth = 0.0f;
        rig_start(&r);
        seen point = surface_rig_ground();
        for (uint32_t y = 0; y < r.s.height; y++)
            for (uint32_t x = 0; x < r.s.width; x++) {
                surface_rig_see(&r.s, x, y, &point);
                float light = lsf_random_float(7, y * r.s.width + x);
                set_light(&r, x, y, light * light * light, 0.0f);
            }
        rig_run(&r);
        uint32_t count = r.s.width * r.s.height;
        double kept =
            sum_of((const float(*)[2][4])r.out, count) / sum_of((const float(*)[2][4])r.in, count);
        print_message("%s: %.6f of the light is left\n", grows ? "growing" : "alike", kept);
        assert_true(fabs(kept - 1.0) < tolerance[grows]);
        rig_end(&r);
    }
}

/* Reach grows with distance from the viewer by the law of the page, rounded in each phase. */
static void reach_grows_with_distance(void **unused)
{
    (void)unused;
    /* None brings a step near the middle between two texels. */
    static const float distances[] = {0.3f, 1.0f, 2.1f, 4.0f};
    for (size_t d = 0; d < LSF_COUNT(distances); d++) {
        rig r;
        rig_begin(&r, 201, 9);
        r.params.phases = 4;
        r.params.ratio = 2.0f;
        r.params.growth = 1.0f;
        rig_start(&r);
        seen point = surface_rig_wall(&r.s, distances[d]);
        for (uint32_t y = 0; y < r.s.height; y++)
            for (uint32_t x = 0; x < r.s.width; x++)
                surface_rig_see(&r.s, x, y, &point);
        set_light(&r, 100, 4, 1.0f, 1.0f);
        rig_run(&r);
        uint32_t reach, expected = 0;
        double sum;
        for (int phase = 0; phase < 4; phase++)
            expected +=
                (uint32_t)lround(ldexp(pow(1.0 + (double)distances[d], phase / 3.0), phase));
        measure(&r, 0, 100, 4, &reach, &sum);
        assert_int_equal(reach, expected);
        rig_end(&r);
    }
}

/* Taps are as far apart as on a wall in perspective where a texel is as wide: the cut-off, of one
 * step here, lets all of them through on the wall and none on a slanted floor. */
static void cutoff_is_a_step(void **unused)
{
    (void)unused;
    for (int orthographic = 0; orthographic < 2; orthographic++)
        for (int slanted = 0; slanted < 2; slanted++) {
            rig r;
            rig_begin_view(&r, 9, 41, orthographic);
            r.params.phases = 1;
            r.params.cutoff = 1.01f;
            rig_start(&r);
            seen point = surface_rig_wall(&r.s, 2.0f);
            if (slanted) { /* through the same point of the view's axis */
                const struct lsf_view_data *view = &r.s.iteration.view;
                point.plane = point.normal = (lsf_float3){0, 1, 0};
                point.offset = view->start.y + 2.0f * view->forward.y;
            }
            for (uint32_t y = 0; y < 41; y++)
                for (uint32_t x = 0; x < 9; x++)
                    surface_rig_see(&r.s, x, y, &point);
            set_light(&r, 4, 20, 1.0f, 1.0f);
            rig_run(&r);
            float above = r.out[21 * 9 + 4][0][0], beside = r.out[20 * 9 + 5][0][0];
            assert_true(fabsf(above - (slanted ? 0.0f : 0.125f)) < 1e-6f);
            assert_true(fabsf(beside - (slanted ? 0.25f : 0.125f)) < 1e-6f);
            rig_end(&r);
        }
}

/* Left and right halves see `sides` and have light 1 and 0 (specular 3 and 0). */
static void check_halves(rig *r, const seen sides[2])
{
    for (uint32_t y = 0; y < r->s.height; y++)
        for (uint32_t x = 0; x < r->s.width; x++) {
            bool right = x >= r->s.width / 2;
            surface_rig_see(&r->s, x, y, &sides[right]);
            /* What stands where nothing is seen is never looked at. */
            float nothing = sides[right].background ? NAN : 0.0f;
            set_light(r, x, y, right ? nothing : 1.0f, right ? nothing : 3.0f);
        }
    rig_run(r);
    const float *in = &r->in[0][0][0], *out = &r->out[0][0][0];
    for (size_t i = 0; i < r->s.width * r->s.height * sizeof *r->in / sizeof *in; i++)
        assert_true(gl_test_same_float(out[i], in[i]));
}

/* Steps, edges, background and unlit surfaces: the light of either side stays to the bit. */
static void nothing_crosses_an_edge(void **unused)
{
    (void)unused;
    for (int edge = 0; edge < 5; edge++) {
        rig r;
        rig_begin(&r, 96, 48);
        rig_start(&r);
        seen sides[2] = {surface_rig_wall(&r.s, 1.0f), surface_rig_wall(&r.s, 1.0f)};
        float pixel = surface_rig_pixel(&r.s);
        if (edge == 0) /* further than the last phase's taps times its slope */
            sides[1] = surface_rig_wall(&r.s, 1.0f + 48.0f * pixel);
        else if (edge == 1) /* a perpendicular normal on the same plane */
            sides[1].normal = lsf_basis_about(sides[0].normal).t;
        else if (edge == 2)
            sides[1].background = true;
        else if (edge == 3)
            sides[1].unlit = true;
        else /* parallel, far behind */
            sides[1] = surface_rig_wall(&r.s, 3.0f);
        check_halves(&r, sides);
        rig_end(&r);
    }
}

/* A mirror beside a rough surface on one plane: neither takes the other's specular light. */
static void mirrors_keep_their_own(void **unused)
{
    (void)unused;
    rig r;
    rig_begin(&r, 64, 32);
    rig_start(&r);
    for (uint32_t y = 0; y < 32; y++)
        for (uint32_t x = 0; x < 64; x++) {
            seen point = surface_rig_wall(&r.s, 1.0f);
            point.roughness = x < 32 ? 0.0f : 1.0f;
            surface_rig_see(&r.s, x, y, &point);
            set_light(&r, x, y, 1.0f, x < 32 ? lsf_random_float(7, y * 64 + x) : 2.0f);
        }
    rig_run(&r);
    for (uint32_t i = 0; i < 64 * 32; i++)
        assert_memory_equal(r.out[i], r.in[i], sizeof *r.in);
    rig_end(&r);
}

/* A corner whose sides the viewer sees at a slant: light of either side stays on it. */
static void nothing_crosses_a_corner(void **unused)
{
    (void)unused;
    rig r;
    rig_begin(&r, 96, 96);
    rig_start(&r);
    lsf_basis basis = lsf_basis_about(surface_rig_wall(&r.s, 1.0f).plane);
    seen sides[2];
    for (int i = 0; i < 2; i++) {
        lsf_float3 n = lsf_f3_normalize(
            lsf_f3_mad(surface_rig_wall(&r.s, 1.0f).plane, basis.t, i == 0 ? 1.0f : -1.0f));
        lsf_float3 centre = lsf_f3_mad(lsf_f3_load(&r.s.iteration.view.start.x),
                                       lsf_f3_load(&r.s.iteration.view.forward.x), 1.0f);
        sides[i] =
            (seen){.plane = n, .normal = n, .offset = lsf_f3_dot(n, centre), .roughness = 1.0f};
    }
    for (uint32_t y = 0; y < 96; y++)
        for (uint32_t x = 0; x < 96; x++) {
            /* The nearer side is seen: the corner points at the viewer. */
            lsf_float3 ray = surface_rig_ray(&r.s, x, y);
            int side = lsf_f3_dot(ray, basis.t) > 0.0f ? 0 : 1;
            surface_rig_see(&r.s, x, y, &sides[side]);
            set_light(&r, x, y, (float)side, 3.0f * (float)side);
        }
    rig_run(&r);
    /* Cosine 0, up to how normals are stored: 7 bits, 1 degree a side. */
    for (uint32_t i = 0; i < 96 * 96; i++)
        assert_true(fabsf(r.out[i][0][0] - r.in[i][0][0]) < 0.02f);
    rig_end(&r);
}

static void same_bits_with_any_threads(void **unused)
{
    (void)unused;
    static const char *const threads[] = {"0", "1", "8"};
    enum { WIDTH = 150, HEIGHT = 90 };
    float(*first)[2][4] = NULL;
    for (size_t t = 0; t < LSF_COUNT(threads); t++) {
        rig r;
        setenv("LP_NUM_THREADS", threads[t], 1);
        rig_begin(&r, WIDTH, HEIGHT);
        rig_start(&r);
        unsetenv("LP_NUM_THREADS");
        for (uint32_t y = 0; y < HEIGHT; y++)
            for (uint32_t x = 0; x < WIDTH; x++) {
                uint32_t i = y * WIDTH + x;
                seen point = x + y < 120 ? surface_rig_wall(&r.s, 1.0f) : surface_rig_ground();
                point.roughness = lsf_random_float(4, i);
                surface_rig_see(&r.s, x, y, &point);
                set_light(&r, x, y, lsf_random_float(1, i), lsf_random_float(2, i));
            }
        rig_run(&r);
        if (t == 0) {
            first = malloc(WIDTH * HEIGHT * sizeof *first);
            assert_non_null(first);
            memcpy(first, r.out, WIDTH * HEIGHT * sizeof *first);
        } else {
            assert_memory_equal(first, r.out, WIDTH * HEIGHT * sizeof *first);
        }
        rig_end(&r);
    }
    free(first);
}

static void no_phases_no_pass(void **unused)
{
    (void)unused;
    rig r;
    rig_begin(&r, 8, 8);
    r.params.phases = 0;
    rig_start(&r);
    assert_null(lsf_plan_find_pass(r.s.setup.plan, "blur"));
    assert_int_equal(r.pass.light.irradiance, 0);
    rig_end(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_constant_stays_to_the_bit),
        cmocka_unit_test(an_impulse_becomes_a_tent),
        cmocka_unit_test(reach_grows_with_distance),
        cmocka_unit_test(cutoff_is_a_step),
        cmocka_unit_test(nothing_crosses_an_edge),
        cmocka_unit_test(nothing_crosses_a_corner),
        cmocka_unit_test(mirrors_keep_their_own),
        cmocka_unit_test(same_bits_with_any_threads),
        cmocka_unit_test(no_phases_no_pass),
        cmocka_unit_test(energy_is_kept_but_for_growth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
