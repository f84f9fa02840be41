/* The filter of light where few samples find a light: what one of them brings goes, and what they
 * have missed is filled in. */
#include <math.h>

#include "base/base.h"
#include "light_filter_rig.h"

static const lsf_light_filter_params defaults = {LSF_LIGHT_FILTER_PARAMS_DEFAULTS};

/* Where a pixel finds the light: it and its neighbours see the same wall; it sees a pole before the
 * wall; or each pixel sees a leaf of its own. */
typedef enum place { ON_WALL, ON_POLE, ON_LEAF } place;

static void see_place(filter_rig *r, place where)
{
    seen wall = surface_rig_wall(&r->s, 1.0f), pole = surface_rig_wall(&r->s, 0.5f);
    see_everywhere(r, &wall);
    for (uint32_t i = 16; where == ON_POLE && i < pixels_of(r); i += 32)
        see(r, i, &pole);
    for (uint32_t i = 0; where == ON_LEAF && i < pixels_of(r); i++) {
        seen leaf = surface_rig_wall(&r->s, 0.5f + 0.5f * random_at(7, i));
        see(r, i, &leaf);
    }
}

/* How much stays of a light that one pixel finds in one iteration. */
static float rare_light_left(place where, int iterations)
{
    static const char *const names[] = {"on a wall", "on a pole", "on a leaf"};
    static filter_rig r;
    filter_rig_begin(&r, 32, 32, false, &defaults);
    see_place(&r, where);
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
    print_message("a rare light %s, %d iterations: %.3f of it stays\n", names[where], iterations,
                  (double)left);
    filter_rig_end(&r);
    return left;
}

/* How much stays in the middle of a light that one of the points finds, which are so many pixels
 * apart, and which is spread over as many. */
static float point_light_left(uint32_t apart)
{
    static filter_rig r;
    filter_rig_begin(&r, 32, 32, false, &defaults);
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
    filter_rig_end(&r);
    return left;
}

/* Most of it is noise, and goes. */
static void a_rare_light_goes(void **unused)
{
    (void)unused;
    for (int iterations = 1; iterations <= 16; iterations *= 2)
        for (int where = ON_WALL; where <= ON_LEAF; where++) {
            float left = rare_light_left(where, iterations);
            assert_true(left >= (where == ON_LEAF ? -0.005f : 0.0f));
            assert_true(left <= (where == ON_POLE ? 0.05f : 0.005f));
        }
    assert_true(point_light_left(2) <= 0.1f);
}

/* A light that a leaf has in every iteration is no noise, and stays. */
static void a_leaf_keeps_its_light(void **unused)
{
    (void)unused;
    static filter_rig r;
    filter_rig_begin(&r, 32, 32, false, &defaults);
    see_place(&r, ON_LEAF);
    uint32_t bright = 16 * 32 + 16;
    for (int n = 0; n < 4; n++) {
        for (uint32_t i = 0; i < pixels_of(&r); i++)
            noisy_light(&r, i, 1.0f);
        set_light(&r, bright, n % 2 ? 90.0f : 110.0f, 0.0f);
        iterate(&r);
    }
    filter(&r);
    assert_true(fabsf(r.out[bright][0] / r.raw[bright][0] - 1.0f) < 1e-3f);
    filter_rig_end(&r);
}

/* Of a light that one sample in 32 finds on leaves, each pixel tells little, but those around tell
 * it together: most of it is kept, and spread. */
static void leaves_share_what_they_lose(void **unused)
{
    (void)unused;
    static filter_rig r;
    filter_rig_begin(&r, 48, 48, false, &defaults);
    see_place(&r, ON_LEAF);
    for (int n = 0; n < 4; n++) {
        for (uint32_t i = 0; i < pixels_of(&r); i++)
            set_light(&r, i, random_at(300 + r.iterations, i) < 1.0f / 32.0f ? 32.2f : 0.2f, 0.0f);
        iterate(&r);
    }
    filter(&r);
    double raw[2] = {0}, out[2] = {0}; /* sums and sums of squares */
    for (uint32_t i = 0; i < pixels_of(&r); i++) {
        raw[0] += (double)r.raw[i][0];
        raw[1] += (double)r.raw[i][0] * (double)r.raw[i][0];
        out[0] += (double)r.out[i][0];
        out[1] += (double)r.out[i][0] * (double)r.out[i][0];
    }
    print_message("light on leaves: %.3f of its mean, %.3f of its mean square\n", out[0] / raw[0],
                  out[1] / raw[1]);
    assert_true(out[0] > 0.85 * raw[0] && out[0] < 1.02 * raw[0]);
    assert_true(out[1] < 0.5 * raw[1]);
    filter_rig_end(&r);
}

/* The variance of faint light is 0 in a float. Differences relative to it, in the steps, must not
 * make pixels that are not a number. */
static void faint_light_stays_finite(void **unused)
{
    (void)unused;
    static filter_rig r;
    for (float scale = 1e10f; scale > 1e-36f; scale *= 1e-3f) {
        filter_rig_begin(&r, 32, 32, false, &defaults);
        see_place(&r, ON_LEAF);
        for (int n = 0; n < 4; n++) {
            for (uint32_t i = 0; i < pixels_of(&r); i++)
                set_light(&r, i, scale * (random_at(400 + r.iterations, i) < 0.03f ? 32.2f : 0.2f),
                          0.0f);
            iterate(&r);
        }
        filter(&r);
        for (uint32_t i = 0; i < pixels_of(&r); i++)
            if (!isfinite(r.out[i][0]))
                fail_msg("light of %g: pixel %u is %g", (double)scale, i, (double)r.out[i][0]);
        filter_rig_end(&r);
    }
}

/* Pixels that have missed a light, which one sample in 16 finds, do not stay as dark dots. */
static void a_missed_light_is_filled_in(void **unused)
{
    (void)unused;
    static filter_rig r;
    filter_rig_begin(&r, 48, 48, false, &defaults);
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
    filter_rig_end(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rare_light_goes),           cmocka_unit_test(a_leaf_keeps_its_light),
        cmocka_unit_test(leaves_share_what_they_lose), cmocka_unit_test(faint_light_stays_finite),
        cmocka_unit_test(a_missed_light_is_filled_in),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
