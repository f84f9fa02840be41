/* Means of light and their filter, on surfaces and light made by hand: what is kept, what is taken
 * out and what vanishes. */
#include <math.h>

#include "base/base.h"
#include "light_filter_rig.h"
#include "math/sampling.h"

static const lsf_light_filter_params defaults = {LSF_LIGHT_FILTER_PARAMS_DEFAULTS};

/* Over any surfaces of one colour; and over any colours, once it is known not to vary. */
static void a_constant_stays_to_the_bit(void **unused)
{
    (void)unused;
    static filter_rig r;
    static const uint32_t sizes[][2] = {{1, 1}, {7, 13}, {33, 5}, {48, 48}};
    for (uint32_t s = 0; s < 4 * LSF_COUNT(sizes); s++) {
        bool orthographic = s % 2, colours = s / 2 % 2;
        filter_rig_begin(&r, sizes[s / 4][0], sizes[s / 4][1], orthographic, &defaults);
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
        filter_rig_end(&r);
    }
}

/* One side's light is 100 without noise, the other's 1 with noise: neither takes of the other,
 * whether or not the limit helps. A step in depth is as far as 2^-(s / (16 d))^2 < 2^-10 of the
 * last step's weights needs, at s pixels. */
static void nothing_crosses_an_edge(void **unused)
{
    (void)unused;
    static filter_rig r;
    for (int test = 0; test < 16; test++) {
        int edge = test % 4;
        bool orthographic = test & 4;
        lsf_light_filter_params params = defaults;
        params.limit = test / 8;
        filter_rig_begin(&r, 48, 32, orthographic, &params);
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
        filter_rig_end(&r);
    }
}

/* Channel A is the variance that is left: on a plane that of the filtered pixels themselves, and
 * that of the mean without steps. */
static void what_is_left_is_told(void **unused)
{
    (void)unused;
    static filter_rig r;
    for (int steps = 0; steps < 3; steps += 2) {
        lsf_light_filter_params params = defaults;
        params.steps = steps;
        filter_rig_begin(&r, 96, 64, false, &params);
        seen wall = surface_rig_wall(&r.s, 1.0f);
        see_everywhere(&r, &wall);
        for (int n = 0; n < 16; n++) {
            for (uint32_t i = 0; i < pixels_of(&r); i++)
                noisy_light(&r, i, 1.0f);
            iterate(&r);
        }
        filter(&r);
        double told = 0.0, left = 0.0, count = pixels_of(&r);
        for (uint32_t i = 0; i < pixels_of(&r); i++) {
            double d = (double)r.out[i][0] - 1.0 / M_PI;
            told += (double)r.out[i][3] / count;
            left += d * d / count;
        }
        print_message("%d steps: a variance of %.6f, told as %.6f\n", steps, left, told);
        assert_true(told < 1.5 * left && left < 1.5 * told);
        filter_rig_end(&r);
    }
}

/* Colours as different as a texture's: light without them is filtered as on a white wall. */
static void textures_stay(void **unused)
{
    (void)unused;
    static filter_rig r;
    static texels white;
    for (int textured = 0; textured < 2; textured++) {
        filter_rig_begin(&r, 48, 32, false, &defaults);
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
        filter_rig_end(&r);
    }
}

/* Black, red and metal beside white: what reflects no light, or none of a colour, does not tell how
 * much there is, and the white is as bright as without it. */
static void what_reflects_nothing_tells_nothing(void **unused)
{
    (void)unused;
    static filter_rig r;
    static const uint32_t colours[][2] = {{0, 0}, {0x0000ffffu, 0}, {0xffffffffu, 0x7fffffffu}};
    for (size_t k = 0; k < LSF_COUNT(colours); k++) {
        filter_rig_begin(&r, 32, 32, false, &defaults);
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
        filter_rig_end(&r);
    }
}

/* Where all differences count as noise, the filter is a tent of 2^steps pixels to each side. */
static void a_plane_gets_the_tent(void **unused)
{
    (void)unused;
    static filter_rig r;
    for (int test = 0; test < 8; test++) {
        bool orthographic = test % 2;
        int steps = 1 + test / 2;
        lsf_light_filter_params params = {LSF_LIGHT_FILTER_ATROUS, steps, 1e3f, 0.5f, 32.0f, 0};
        filter_rig_begin(&r, 64, 64, orthographic, &params);
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
        filter_rig_end(&r);
    }
}

/* Root of the mean squared error of light, over pixels whose distance to the picture's middle is at
 * most `within`. */
static double error_of(const filter_rig *r, const float (*light)[4], const float *truth,
                       uint32_t within)
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
static void check_convergence(const char *name, filter_rig *r, const float *light,
                              const double allowed[2])
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
    static filter_rig r;
    static float truth[MAX_PIXELS];
    static const double allowed[2][2] = {{0.15, 0.15}, {0.3, 0.5}};
    for (int border = 0; border < 2; border++) {
        filter_rig_begin(&r, 64, 48, border, &defaults);
        seen wall = surface_rig_wall(&r.s, 1.0f), floor = surface_rig_ground();
        see_everywhere(&r, border ? &wall : &floor);
        for (uint32_t i = 0; i < pixels_of(&r); i++)
            truth[i] = border && i % 64 >= 32 ? 0.1f : 1.0f;
        check_convergence(border ? "border" : "plane", &r, truth, allowed[border]);
        filter_rig_end(&r);
    }
}

/* Light that repeats with the pattern of interleaving, but for the 1 + 2 pixels beside the
 * picture's border: gone where all differences count as noise, nearly so with defaults. */
static void the_pattern_of_interleaving_vanishes(void **unused)
{
    (void)unused;
    static filter_rig r;
    for (int32_t steps = 2; steps <= 5; steps += 3) {
        lsf_light_filter_params params = defaults;
        params.steps = steps;
        params.tolerance = steps == 2 ? 1e3f : params.tolerance;
        filter_rig_begin(&r, 96, 48, false, &params);
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
        filter_rig_end(&r);
    }
}

static void mirrors_stay(void **unused)
{
    (void)unused;
    static filter_rig r;
    for (int rough = 0; rough < 2; rough++) {
        filter_rig_begin(&r, 32, 32, false, &defaults);
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
        filter_rig_end(&r);
    }
}

/* Known without noise, light stays, however much it varies over a plane. */
static void light_without_variance_stays(void **unused)
{
    (void)unused;
    static filter_rig r;
    filter_rig_begin(&r, 48, 32, false, &defaults);
    seen wall = surface_rig_wall(&r.s, 1.0f);
    see_everywhere(&r, &wall);
    for (uint32_t i = 0; i < pixels_of(&r); i++)
        set_light(&r, i, random_at(8, i), random_at(9, i));
    iterate(&r);
    iterate(&r);
    filter(&r);
    for (uint32_t i = 0; i < pixels_of(&r); i++)
        assert_unchanged(&r, i);
    filter_rig_end(&r);
}

/* A pixel that is not finite stays what it is, and its neighbours are as without it. */
static void what_is_not_finite_stays_alone(void **unused)
{
    (void)unused;
    static filter_rig r;
    static const float values[] = {NAN, INFINITY, -INFINITY, 3e38f};
    for (uint32_t test = 0; test < 2 * LSF_COUNT(values); test++) {
        uint32_t wrong = 16 * 32 + 16, iterations = 1 + test % 2 * 3;
        filter_rig_begin(&r, 32, 32, false, &defaults);
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
        filter_rig_end(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_constant_stays_to_the_bit),
        cmocka_unit_test(nothing_crosses_an_edge),
        cmocka_unit_test(what_is_left_is_told),
        cmocka_unit_test(textures_stay),
        cmocka_unit_test(what_reflects_nothing_tells_nothing),
        cmocka_unit_test(a_plane_gets_the_tent),
        cmocka_unit_test(light_converges),
        cmocka_unit_test(the_pattern_of_interleaving_vanishes),
        cmocka_unit_test(mirrors_stay),
        cmocka_unit_test(light_without_variance_stays),
        cmocka_unit_test(what_is_not_finite_stays_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
