/* Means of light and their filter, on surfaces and light made by hand: what is kept, what is taken
 * out and what vanishes. */
#include <math.h>

#include "base/base.h"
#include "math/sampling.h"
#include "passes/light_filter.h"
#include "passes/light_guide.h"
#include "passes/light_mean.h"
#include "surface_rig.h"

enum { MAX_PIXELS = 96 * 96 };
static const float PI_F = 3.14159265f;

typedef float texels[MAX_PIXELS][4];

typedef struct rig {
    surface_rig s;
    lsf_light_mean mean;
    lsf_light_guide guide;
    lsf_light_filter filter;
    lsf_gbuffer_maps gbuffer;
    GLuint irradiance, specular, picture;
    texels light, specular_params; /* of the next iteration */
    texels raw, out; /* the means of all of them, and what the filter makes of these */
    uint32_t iterations;
} rig;

static void rig_begin(rig *r, uint32_t width, uint32_t height, bool orthographic,
                      const lsf_light_filter_params *params)
{
    lsf_error error = {0};
    memset(r, 0, sizeof *r);
    assert_true(width * height <= MAX_PIXELS);
    surface_rig_begin(&r->s, width, height, orthographic);
    r->s.setup.plan->pattern = 1; /* pixels have noise of their own */
    lsf_light_mean_plan(r->s.setup.plan, &(lsf_light_mean_use){.indirect = true});
    lsf_light_guide_plan(r->s.setup.plan);
    lsf_light_filter_plan(r->s.setup.plan, params);
    surface_rig_start(&r->s);
    if (!lsf_light_mean_create(&r->mean, r->s.context, r->s.setup.plan, &error) ||
        !lsf_light_guide_create(&r->guide, r->s.context, r->s.setup.plan, &error) ||
        !lsf_light_filter_create(&r->filter, r->s.context, r->s.setup.plan, params, &error))
        fail_msg("%s", error.message);
    r->gbuffer.seen = r->s.maps;
    r->irradiance = surface_rig_texture(&r->s, GL_RGBA32F, width, height);
    r->specular = surface_rig_texture(&r->s, GL_RGBA32F, width, height);
    r->picture = surface_rig_texture(&r->s, GL_RGBA32F, width, height);
}

static void rig_end(rig *r)
{
    lsf_texture_destroy(r->s.context, &r->irradiance);
    lsf_texture_destroy(r->s.context, &r->specular);
    lsf_texture_destroy(r->s.context, &r->picture);
    lsf_light_filter_destroy(&r->filter);
    lsf_light_guide_destroy(&r->guide);
    lsf_light_mean_destroy(&r->mean);
    surface_rig_end(&r->s);
}

static uint32_t pixels_of(const rig *r)
{
    return r->s.width * r->s.height;
}

/* What a pixel sees, white. */
static void see(rig *r, uint32_t i, const seen *point)
{
    surface_rig_see(&r->s, i % r->s.width, i / r->s.width, point);
    r->s.surfaces[i][2] = 0xffffffffu;
    r->s.surfaces[i][3] |= 0xffffu;
    r->s.glosses[i][0] |= 2621u << 16; /* f0 of 0.04 */
}

static void see_everywhere(rig *r, const seen *point)
{
    for (uint32_t i = 0; i < pixels_of(r); i++)
        see(r, i, point);
}

static void set_light(rig *r, uint32_t i, float irradiance, float specular)
{
    for (int c = 0; c < 3; c++) {
        r->light[i][c] = irradiance;
        r->specular_params[i][c] = specular;
    }
}

/* An iteration of the light that is set. */
static void iterate(rig *r)
{
    if (r->iterations == 0)
        surface_rig_upload(&r->s);
    surface_rig_write(r->irradiance, r->s.width, r->s.height, r->light[0]);
    surface_rig_write(r->specular, r->s.width, r->s.height, r->specular_params[0]);
    const lsf_light_parts parts = {.gbuffer = &r->gbuffer,
                                   .indirect = {r->irradiance, r->specular}};
    r->s.iteration.done = r->iterations++;
    lsf_light_mean_run(&r->mean, &r->s.iteration, &parts, 0);
}

static void filter(rig *r)
{
    static texels specular;
    surface_rig_read(r->mean.diffuse.light, r->s.width, r->s.height, r->raw[0]);
    surface_rig_read(r->mean.specular.light, r->s.width, r->s.height, specular[0]);
    for (uint32_t i = 0; i < pixels_of(r); i++)
        for (int c = 0; c < 4; c++)
            r->raw[i][c] = c < 3 ? r->raw[i][c] + specular[i][c] : 1.0f;
    surface_rig_write(r->picture, r->s.width, r->s.height, r->raw[0]);
    const lsf_light_guide_inputs means = {.mean = r->mean.guide,
                                          .diffuse_factor = r->mean.diffuse.factor,
                                          .specular_factor = r->mean.specular.factor};
    lsf_light_guide_run(&r->guide, r->s.setup.plan, r->iterations, &means);
    const lsf_light_filter_inputs inputs = {
        .guide = r->guide.maps,
        .half = r->mean.half,
        .half_count = lsf_light_mean_half(r->iterations),
        .picture = r->picture,
        .parts = {{r->mean.diffuse.light, r->mean.diffuse.factor},
                  {r->mean.specular.light, r->mean.specular.factor}}};
    lsf_light_filter_run(&r->filter, &r->s.iteration, r->iterations, &inputs);
    lsf_light_filter_finish(&r->filter, &r->s.iteration, r->iterations, &inputs,
                            r->filter.filtered);
    surface_rig_read(r->filter.picture, r->s.width, r->s.height, r->out[0]);
}

static void assert_unchanged(const rig *r, uint32_t i)
{
    assert_memory_equal(r->out[i], r->raw[i], sizeof *r->out);
}

static float random_at(uint32_t seed, uint32_t i)
{
    return lsf_random_float(seed, i);
}

/* Of mean 1 and standard deviation 1, with a heavy tail. */
static float exponential_at(uint32_t seed, uint32_t i)
{
    return -logf(1.0f - random_at(seed, i));
}

/* Light of mean `mean` and noise that differs between pixels and iterations. */
static void noisy_light(rig *r, uint32_t i, float mean)
{
    set_light(r, i, mean * exponential_at(100 + r->iterations, i), 0.0f);
}

static const lsf_light_filter_params defaults = {LSF_LIGHT_FILTER_PARAMS_DEFAULTS};

/* Over any surfaces of one colour; and over any colours, once it is known not to vary. */
static void a_constant_stays_to_the_bit(void **unused)
{
    (void)unused;
    static rig r;
    static const uint32_t sizes[][2] = {{1, 1}, {7, 13}, {33, 5}, {48, 48}};
    for (uint32_t s = 0; s < 4 * LSF_COUNT(sizes); s++) {
        bool orthographic = s % 2, colours = s / 2 % 2;
        rig_begin(&r, sizes[s / 4][0], sizes[s / 4][1], orthographic, &defaults);
        for (uint32_t i = 0; i < pixels_of(&r); i++) {
            seen point = surface_rig_wall(&r.s, 1.0f + 0.01f * random_at(3, i));
            point.normal.x += 0.3f * random_at(5, i);
            point.normal = lsf_f3_normalize(point.normal);
            point.roughness = colours ? random_at(4, i) : 0.5f;
            see(&r, i, &point);
            if (colours)
                r.s.surfaces[i][2] = lsf_hash(1, i);
            set_light(&r, i, 1.3e5f, colours ? 0.1f : 0.0f);
        }
        for (int i = 0; i < 1 + colours; i++)
            iterate(&r);
        filter(&r);
        for (uint32_t i = 0; i < pixels_of(&r); i++)
            assert_unchanged(&r, i);
        rig_end(&r);
    }
}

/* One side's light is 100 without noise, the other's 1 with noise: neither takes of the other,
 * whether or not the limit helps. A step in depth is as far as 2^-(s / (16 d))^2 < 2^-10 of the
 * last step's weights needs, at s pixels. */
static void nothing_crosses_an_edge(void **unused)
{
    (void)unused;
    static rig r;
    for (int test = 0; test < 16; test++) {
        int edge = test % 4;
        bool orthographic = test & 4;
        lsf_light_filter_params params = defaults;
        params.limit = test / 8;
        rig_begin(&r, 48, 32, orthographic, &params);
        seen sides[2] = {surface_rig_wall(&r.s, 1.0f), surface_rig_wall(&r.s, 1.0f)};
        float step = 16.0f * params.depth_weight * sqrtf(10.0f) * surface_rig_pixel(&r.s);
        if (orthographic)
            step = 16.0f * params.depth_weight * sqrtf(10.0f) * 2.0f *
                   lsf_f3_length(lsf_f3_load(&r.s.iteration.view.start_dx.x)) / 48.0f;
        if (edge == 0)
            sides[1] = surface_rig_wall(&r.s, 1.0f + step);
        else if (edge == 1)
            sides[1].normal = lsf_basis_about(sides[0].normal).t;
        else if (edge == 2)
            sides[1].background = true;
        else
            sides[1].unlit = true;
        for (uint32_t i = 0; i < pixels_of(&r); i++)
            see(&r, i, &sides[i % 48 >= 24]);
        for (int n = 0; n < 4; n++) {
            for (uint32_t i = 0; i < pixels_of(&r); i++)
                if (i % 48 < 24)
                    set_light(&r, i, 100.0f, 0.0f);
                else
                    noisy_light(&r, i, 1.0f);
            iterate(&r);
        }
        filter(&r);
        for (uint32_t i = 0; i < pixels_of(&r); i++)
            if (i % 48 < 24)
                assert_true(fabsf(r.out[i][0] * PI_F / 100.0f - 1.0f) <= 1e-3f);
            else if (edge >= 2)
                assert_unchanged(&r, i);
            else
                assert_true(r.out[i][0] * PI_F <= 3.0f);
        rig_end(&r);
    }
}

/* Colours as different as a texture's: light without them is filtered as on a white wall. */
static void textures_stay(void **unused)
{
    (void)unused;
    static rig r;
    static texels white;
    for (int textured = 0; textured < 2; textured++) {
        rig_begin(&r, 48, 32, false, &defaults);
        seen wall = surface_rig_wall(&r.s, 1.0f);
        see_everywhere(&r, &wall);
        for (uint32_t i = 0; textured && i < pixels_of(&r); i++) {
            uint32_t grey = 0x1000u + (lsf_hash(7, i) & 0xefffu);
            r.s.surfaces[i][2] = grey | grey << 16;
            r.s.surfaces[i][3] = grey;
        }
        for (int n = 0; n < 4; n++) {
            for (uint32_t i = 0; i < pixels_of(&r); i++)
                noisy_light(&r, i, 1.0f);
            iterate(&r);
        }
        filter(&r);
        for (uint32_t i = 0; i < pixels_of(&r); i++) {
            float grey = (float)(r.s.surfaces[i][3] & 0xffffu) / 65535.0f;
            if (!textured)
                white[i][0] = r.out[i][0];
            else
                assert_true(fabsf(r.out[i][0] / (grey * white[i][0]) - 1.0f) <= 1e-4f);
        }
        rig_end(&r);
    }
}

/* Black, red and metal beside white: what reflects no light, or none of a colour, does not tell how
 * much there is, and the white is as bright as without it. */
static void what_reflects_nothing_tells_nothing(void **unused)
{
    (void)unused;
    static rig r;
    static const uint32_t colours[][2] = {{0, 0}, {0x0000ffffu, 0}, {0xffffffffu, 0x7fffffffu}};
    for (size_t k = 0; k < LSF_COUNT(colours); k++) {
        rig_begin(&r, 32, 32, false, &defaults);
        seen wall = surface_rig_wall(&r.s, 1.0f);
        see_everywhere(&r, &wall);
        for (uint32_t i = 0; i < pixels_of(&r); i++)
            if (i % 32 / 2 % 2) {
                r.s.surfaces[i][2] = colours[k][0];
                r.s.surfaces[i][3] = colours[k][1];
            }
        for (int n = 0; n < 4; n++) {
            for (uint32_t i = 0; i < pixels_of(&r); i++)
                noisy_light(&r, i, 1.0f);
            iterate(&r);
        }
        filter(&r);
        for (int c = 0; c < 3; c++) {
            double before = 0.0, after = 0.0;
            for (uint32_t i = 0; i < pixels_of(&r); i++)
                if (i % 32 / 2 % 2 == 0) {
                    before += (double)r.raw[i][c];
                    after += (double)r.out[i][c];
                }
            print_message("beside colour %zu: channel %d %.4f of before\n", k, c, after / before);
            assert_true(fabs(after / before - 1.0) < 0.02);
        }
        rig_end(&r);
    }
}

/* Where all differences count as noise, the filter is a tent of 2^steps pixels to each side. */
static void a_plane_gets_the_tent(void **unused)
{
    (void)unused;
    static rig r;
    for (int test = 0; test < 8; test++) {
        bool orthographic = test % 2;
        int steps = 1 + test / 2;
        lsf_light_filter_params params = {LSF_LIGHT_FILTER_ATROUS, steps, 1e3f, 0.5f, 32.0f, 0};
        rig_begin(&r, 64, 64, orthographic, &params);
        seen wall = test & 4 ? surface_rig_ground() : surface_rig_wall(&r.s, 1.0f);
        if (orthographic)
            wall = surface_rig_wall(&r.s, 1.0f);
        see_everywhere(&r, &wall);
        /* Means of 0, but for 1 in the middle, and a standard deviation of 64. */
        for (int n = 0; n < 2; n++) {
            for (uint32_t i = 0; i < pixels_of(&r); i++)
                set_light(&r, i, (n ? -64.0f : 64.0f) + (i == 32 * 64 + 32), 0.0f);
            iterate(&r);
        }
        filter(&r);
        float m = (float)(1 << steps);
        for (uint32_t i = 0; i < pixels_of(&r); i++) {
            float x = fmaxf(m - fabsf((float)(i % 64) - 32.0f), 0.0f);
            float y = fmaxf(m - fabsf((float)(i / 64) - 32.0f), 0.0f);
            assert_true(fabsf(r.out[i][0] * PI_F - x * y / (m * m * m * m)) <= 1e-5f);
        }
        rig_end(&r);
    }
}

/* Root of the mean squared error of light, over pixels whose distance to the picture's middle is at
 * most `within`. */
static double error_of(const rig *r, const float (*light)[4], const float *truth, uint32_t within)
{
    double sum = 0.0, count = 0.0;
    for (uint32_t i = 0; i < pixels_of(r); i++) {
        uint32_t x = i % r->s.width, middle = r->s.width / 2;
        if (x + within < middle || x >= middle + within)
            continue;
        double d = (double)(light[i][0] * PI_F - truth[i]);
        sum += d * d;
        count += 1.0;
    }
    return sqrt(sum / count);
}

/* Noise with a heavy tail about the truth `light`. The filtered error is at most `allowed` times
 * the raw one at any number of iterations, over the picture and beside its middle, and from 16 to
 * 1024 falls at least as that of independent samples does, by 8, to a tenth. (Of fewer iterations
 * it is smaller than that: as little as they tell of the noise, the filter takes more for it.) */
static void check_convergence(const char *name, rig *r, const float *light, const double allowed[2])
{
    static const uint32_t within[2] = {32, 4};
    double at_16 = INFINITY;
    for (uint32_t n = 1; n <= 1024; n++) {
        for (uint32_t i = 0; i < pixels_of(r); i++)
            noisy_light(r, i, light[i]);
        iterate(r);
        if ((n & (n - 1)) != 0 || (n & 0x555u) == 0)
            continue;
        filter(r);
        for (int k = 0; k < 2; k++) {
            double raw = error_of(r, (const float(*)[4])r->raw, light, within[k]);
            double error = error_of(r, (const float(*)[4])r->out, light, within[k]);
            print_message("%s within %2u, %4u iterations: %.4f of %.4f, %.2f\n", name, within[k], n,
                          error, raw, error / raw);
            assert_true(error <= allowed[k] * raw);
            if (n == 16 && k == 0)
                at_16 = error;
            assert_true(n < 1024 || k > 0 || error <= at_16 / 8.0 * 1.1);
        }
    }
}

/* A shadow's border, which geometry does not tell; and none. */
static void light_converges(void **unused)
{
    (void)unused;
    static rig r;
    static float truth[MAX_PIXELS];
    static const double allowed[2][2] = {{0.15, 0.15}, {0.3, 0.5}};
    for (int border = 0; border < 2; border++) {
        rig_begin(&r, 64, 48, border, &defaults);
        seen wall = surface_rig_wall(&r.s, 1.0f), floor = surface_rig_ground();
        see_everywhere(&r, border ? &wall : &floor);
        for (uint32_t i = 0; i < pixels_of(&r); i++)
            truth[i] = border && i % 64 >= 32 ? 0.1f : 1.0f;
        check_convergence(border ? "border" : "plane", &r, truth, allowed[border]);
        rig_end(&r);
    }
}

/* How much stays of a light that one pixel finds in one iteration, before a wall or on a pole. */
static float rare_light_left(bool on_pole, int iterations)
{
    static rig r;
    rig_begin(&r, 32, 32, false, &defaults);
    seen wall = surface_rig_wall(&r.s, 1.0f), pole = surface_rig_wall(&r.s, 0.5f);
    see_everywhere(&r, &wall);
    for (uint32_t i = 16; on_pole && i < pixels_of(&r); i += 32)
        see(&r, i, &pole);
    uint32_t finds = 16 * 32 + 16;
    for (int n = 0; n < iterations; n++) {
        for (uint32_t i = 0; i < pixels_of(&r); i++)
            noisy_light(&r, i, 1.0f);
        if (n == iterations / 2)
            set_light(&r, finds, 400.0f, 0.0f);
        iterate(&r);
    }
    filter(&r);
    float left = (r.out[finds][0] * PI_F - 1.0f) / (r.raw[finds][0] * PI_F - 1.0f);
    print_message("a rare light %s, %d iterations: %.3f of it stays\n",
                  on_pole ? "on a pole" : "on a wall", iterations, (double)left);
    rig_end(&r);
    return left;
}

/* How much stays in the middle of a light that one of the points finds, which are so many pixels
 * apart, and which is spread over as many. */
static float point_light_left(uint32_t apart)
{
    static rig r;
    rig_begin(&r, 32, 32, false, &defaults);
    seen wall = surface_rig_wall(&r.s, 1.0f);
    see_everywhere(&r, &wall);
    for (uint32_t i = 0; i < pixels_of(&r); i++)
        set_light(&r, i, i % 32 / apart == 4 && i / 32 / apart == 4 ? 400.0f : 1.0f, 0.0f);
    iterate(&r);
    r.s.iteration.grid.stride = apart;
    filter(&r);
    uint32_t middle = (9 * apart / 2) * 33;
    float left = (r.out[middle][0] * PI_F - 1.0f) / (r.raw[middle][0] * PI_F - 1.0f);
    print_message("a rare light, points %u pixels apart: %.3f of it stays\n", apart, (double)left);
    rig_end(&r);
    return left;
}

/* Most of it is noise, and goes. */
static void a_rare_light_goes(void **unused)
{
    (void)unused;
    float at_once = rare_light_left(false, 1), later = rare_light_left(true, 4);
    assert_true(at_once >= 0.0f && at_once <= 0.05f);
    assert_true(later >= 0.0f && later <= 0.1f);
    for (int iterations = 2; iterations <= 16; iterations *= 2)
        assert_true(fabsf(rare_light_left(false, iterations)) <= 0.005f);
    assert_true(point_light_left(2) <= 0.1f);
}

/* Pixels that have missed a light, which one sample in 16 finds, do not stay as dark dots. */
static void a_missed_light_is_filled_in(void **unused)
{
    (void)unused;
    static rig r;
    rig_begin(&r, 48, 48, false, &defaults);
    seen wall = surface_rig_wall(&r.s, 1.0f);
    see_everywhere(&r, &wall);
    for (int n = 0; n < 16; n++) {
        for (uint32_t i = 0; i < pixels_of(&r); i++)
            set_light(&r, i, random_at(200 + r.iterations, i) < 1.0f / 16.0f ? 16.2f : 0.2f, 0.0f);
        iterate(&r);
    }
    filter(&r);
    float sum = 0.0f, missed = 0.0f;
    for (uint32_t i = 0; i < pixels_of(&r); i++)
        if (r.raw[i][0] * PI_F < 0.3f) {
            sum += r.out[i][0] * PI_F;
            missed += 1.0f;
        }
    print_message("where a light is missed: %.2f of 1.20\n", (double)(sum / missed));
    assert_true(sum / missed > 0.8f);
    rig_end(&r);
}

/* Light that repeats with the pattern of interleaving, but for the 1 + 2 pixels beside the
 * picture's border: gone where all differences count as noise, nearly so with defaults. */
static void the_pattern_of_interleaving_vanishes(void **unused)
{
    (void)unused;
    static rig r;
    for (int32_t steps = 2; steps <= 5; steps += 3) {
        lsf_light_filter_params params = defaults;
        params.steps = steps;
        params.tolerance = steps == 2 ? 1e3f : params.tolerance;
        rig_begin(&r, 96, 48, false, &params);
        seen floor = surface_rig_ground();
        see_everywhere(&r, &floor);
        float mean = 0.0f, worst = 0.0f;
        for (uint32_t i = 0; i < 16; i++)
            mean += random_at(6, i) / 16.0f;
        for (uint32_t i = 0; i < pixels_of(&r); i++)
            set_light(&r, i, random_at(6, i / 96 % 4 * 4 + i % 96 % 4), 0.0f);
        iterate(&r);
        filter(&r);
        uint32_t border = 3;
        for (uint32_t i = 0; i < pixels_of(&r); i++)
            if (i % 96 >= border && i % 96 < 96 - border && i / 96 >= border &&
                i / 96 < 48 - border)
                worst = fmaxf(worst, fabsf(r.out[i][0] * PI_F - mean));
        print_message("%d steps: pattern left %.1e of %.2f\n", steps, (double)worst, (double)mean);
        assert_true(worst <= (steps == 2 ? 1e-5f : 0.05f * mean));
        rig_end(&r);
    }
}

static void mirrors_stay(void **unused)
{
    (void)unused;
    static rig r;
    for (int rough = 0; rough < 2; rough++) {
        rig_begin(&r, 32, 32, false, &defaults);
        seen wall = surface_rig_wall(&r.s, 1.0f);
        wall.roughness = rough ? 1.0f : 0.0f;
        see_everywhere(&r, &wall);
        for (int n = 0; n < 4; n++) {
            for (uint32_t i = 0; i < pixels_of(&r); i++)
                set_light(&r, i, 0.0f, exponential_at(100 + r.iterations, i));
            iterate(&r);
        }
        filter(&r);
        double before = 0.0, after = 0.0;
        for (uint32_t i = 0; i < pixels_of(&r); i++) {
            if (!rough)
                assert_unchanged(&r, i);
            before += pow((double)r.raw[i][0] - 1.0, 2.0);
            after += pow((double)r.out[i][0] - 1.0, 2.0);
        }
        print_message("specular, roughness %d: %.2f of the squared error\n", rough, after / before);
        assert_true(!rough || after < 0.1 * before);
        rig_end(&r);
    }
}

/* Known without noise, light stays, however much it varies over a plane. */
static void light_without_variance_stays(void **unused)
{
    (void)unused;
    static rig r;
    rig_begin(&r, 48, 32, false, &defaults);
    seen wall = surface_rig_wall(&r.s, 1.0f);
    see_everywhere(&r, &wall);
    for (uint32_t i = 0; i < pixels_of(&r); i++)
        set_light(&r, i, random_at(8, i), random_at(9, i));
    iterate(&r);
    iterate(&r);
    filter(&r);
    for (uint32_t i = 0; i < pixels_of(&r); i++)
        assert_unchanged(&r, i);
    rig_end(&r);
}

/* A pixel that is not finite stays what it is, and its neighbours are as without it. */
static void what_is_not_finite_stays_alone(void **unused)
{
    (void)unused;
    static rig r;
    static const float values[] = {NAN, INFINITY, -INFINITY, 3e38f};
    for (uint32_t test = 0; test < 2 * LSF_COUNT(values); test++) {
        uint32_t wrong = 16 * 32 + 16, iterations = 1 + test % 2 * 3;
        rig_begin(&r, 32, 32, false, &defaults);
        seen wall = surface_rig_wall(&r.s, 1.0f);
        see_everywhere(&r, &wall);
        for (uint32_t n = 0; n < iterations; n++) {
            for (uint32_t i = 0; i < pixels_of(&r); i++)
                set_light(&r, i, exponential_at(100 + n, i), exponential_at(200 + n, i));
            if (n == 0)
                set_light(&r, wrong, values[test / 2], values[test / 2]);
            iterate(&r);
        }
        filter(&r);
        double before = 0.0, after = 0.0;
        for (uint32_t i = 0; i < pixels_of(&r); i++) {
            if (i == wrong) {
                assert_true(!(fabsf(r.out[i][0]) < 1e30f));
                continue;
            }
            assert_true(isfinite(r.out[i][0]));
            before += pow((double)r.raw[i][0] - 1.0 / M_PI - 1.0, 2.0);
            after += pow((double)r.out[i][0] - 1.0 / M_PI - 1.0, 2.0);
        }
        assert_true(after < 0.2 * before);
        rig_end(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_constant_stays_to_the_bit),
        cmocka_unit_test(nothing_crosses_an_edge),
        cmocka_unit_test(textures_stay),
        cmocka_unit_test(what_reflects_nothing_tells_nothing),
        cmocka_unit_test(a_plane_gets_the_tent),
        cmocka_unit_test(light_converges),
        cmocka_unit_test(a_rare_light_goes),
        cmocka_unit_test(a_missed_light_is_filled_in),
        cmocka_unit_test(the_pattern_of_interleaving_vanishes),
        cmocka_unit_test(mirrors_stay),
        cmocka_unit_test(light_without_variance_stays),
        cmocka_unit_test(what_is_not_finite_stays_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
