/* The tone curve: its published values and its shape. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "shared/tonemap.h"

static float neutral(float r, float g, float b, int channel)
{
    float rgb[3] = {r, g, b};
    return lsf_tonemap_neutral(rgb[channel], fminf(r, fminf(g, b)), fmaxf(r, fmaxf(g, b)));
}

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.9g is not %.9g", value, expected);
}

/* Worked out by hand from the specification's formula. */
static void test_published_values(void **state)
{
    (void)state;
    assert_near(neutral(0, 0, 0, 0), 0.0, 0.0);
    /* Below the knee only the veil goes: 0.04, or x - 6.25 x^2 for a smallest channel below 0.08.
     */
    assert_near(neutral(0.5f, 0.3f, 0.2f, 0), 0.46, 1e-6);
    assert_near(neutral(0.5f, 0.3f, 0.2f, 2), 0.16, 1e-6);
    assert_near(neutral(0.02f, 0.02f, 0.02f, 1), 6.25 * 0.02 * 0.02, 1e-7);
    assert_near(neutral(0.5f, 0.04f, 0.02f, 0), 0.5 - 0.02 + 6.25 * 0.02 * 0.02, 1e-6);
    /* Grey 1: peak 0.96, new peak 1 - 0.24^2 / (0.96 + 0.24 - 0.76). */
    assert_near(neutral(1, 1, 1, 0), 1.0 - 0.0576 / 0.44, 1e-6);
    /* Red 4: peak 4, new peak 1 - 0.0576 / 3.48, g = 1 - 1 / (0.15 (4 - p) + 1). */
    double peak = 1.0 - 0.0576 / 3.48, g = 1.0 - 1.0 / (0.15 * (4.0 - peak) + 1.0);
    assert_near(neutral(4, 0, 0, 0), peak, 1e-6);
    assert_near(neutral(4, 0, 0, 1), peak * g, 1e-6);
}

static void test_monotone_bounded_and_continuous(void **state)
{
    (void)state;
    float before[3] = {0, 0, 0};
    for (int i = 0; i < 40000; i++) {
        float exposed = powf(10.0f, (float)i / 2500.0f - 8.0f); /* 1e-8 to 1e8 */
        float x = lsf_tonemap_expose(exposed, 1.0f);
        float now[3] = {neutral(x, x, x, 0), neutral(x, 0.3f * x, 0.01f * x, 0),
                        lsf_srgb_encode(neutral(x, 0.5f * x, x, 0))};
        for (int c = 0; c < 3; c++) {
            assert_true(now[c] >= before[c] - 1e-6f);
            assert_true(now[c] >= 0.0f && now[c] <= 1.0f);
            assert_true(now[c] - before[c] < 0.01f);
            before[c] = now[c];
        }
    }
    assert_true(before[0] > 0.9999f);
}

static void test_exposure_and_odd_values(void **state)
{
    (void)state;
    assert_true(lsf_tonemap_expose(0.25f, 4.0f) == 1.0f);
    assert_true(lsf_tonemap_expose(NAN, 1.0f) == 0.0f);
    assert_true(lsf_tonemap_expose(-1.0f, 1.0f) == 0.0f);
    assert_true(lsf_tonemap_expose(INFINITY, 1.0f) == LSF_TONEMAP_LARGEST);
    assert_true(isfinite(neutral(LSF_TONEMAP_LARGEST, 0, 0, 0)));
}

static void test_srgb(void **state)
{
    (void)state;
    assert_near(lsf_srgb_encode(0.0f), 0.0, 0.0);
    assert_near(lsf_srgb_encode(1.0f), 1.0, 1e-7);
    assert_near(lsf_srgb_encode(0.5f), 0.735356983, 1e-6);
    assert_near(lsf_srgb_encode(0.002f), 0.02584, 1e-7);
    assert_near(lsf_srgb_encode(0.0031308f), 0.04045, 1e-6);
    assert_near(lsf_srgb_encode(7.0f), 1.0, 0.0);
    for (int i = 0; i <= 255; i++)
        assert_near(lsf_srgb_encode(lsf_srgb_decode((float)i / 255.0f)), i / 255.0, 1e-6);
}

static void test_none_cuts_off(void **state)
{
    (void)state;
    assert_near(lsf_tonemap_code(LSF_CURVE_NONE, 1, 3, 0.5f, 0), 0.735356983, 1e-6);
    assert_near(lsf_tonemap_code(LSF_CURVE_NONE, 0, 3, 0.5f, 0), 1.0, 0.0);
    assert_near(lsf_tonemap_code(LSF_CURVE_NEUTRAL, 0, 0.5f, 0.3f, 0.2f), lsf_srgb_encode(0.46f),
                1e-6);
}

/* Greys stay grey, so that the fit alone is left; worked out by hand for middle grey. */
static void test_aces(void **state)
{
    (void)state;
    for (int c = 0; c < 3; c++) {
        assert_near(lsf_tonemap_aces(c, 0.18f, 0.18f, 0.18f), 0.036733611 / 0.347885021, 2e-5);
        assert_near(lsf_tonemap_aces(c, 1e6f, 1e6f, 1e6f), 1 / 0.983729, 1e-4);
    }
    /* Saturated light bleaches: red of 16 is far from (1, 0, 0). */
    assert_true(lsf_tonemap_aces(1, 16, 0, 0) > 0.2f);
}

/* Fit of the same curve by B. Wrensch, "Minimal AgX Implementation", 2023; half a percent of the
 * range is what it leaves. */
static double agx_polynomial(double v)
{
    return ((((((15.5 * v - 40.14) * v + 31.96) * v - 6.868) * v + 0.4298) * v) + 0.1191) * v -
           0.00232;
}

static void test_agx(void **state)
{
    (void)state;
    assert_near(lsf_tonemap_agx_curve(0.18f), 0.5, 1e-6);
    assert_near(lsf_tonemap_agx_curve(0.18f * exp2f(-10)), 0.0, 1e-6);
    assert_near(lsf_tonemap_agx_curve(0.18f * exp2f(6.5f)), 1.0, 1e-6);
    assert_near(lsf_tonemap_agx_curve(0), 0.0, 1e-6);
    double squares = 0;
    for (int i = 0; i <= 1000; i++) {
        double v = i / 1000.0, linear = 0.18 * exp2(16.5 * v - 10);
        double difference = (double)lsf_tonemap_agx_curve((float)linear) - agx_polynomial(v);
        squares += difference * difference / 1001;
    }
    assert_near(sqrt(squares), 0.0, 0.005);
    /* The outset undoes the inset; greys stay grey but for the matrices' rounding. */
    for (int c = 0; c < 3; c++)
        assert_near(lsf_tonemap_code(LSF_CURVE_AGX, c, 0.18f, 0.18f, 0.18f), 0.5, 1e-3);
    /* Bright red fades towards white. */
    assert_true(lsf_tonemap_code(LSF_CURVE_AGX, 1, 100, 0, 0) > 0.5f);
}

static void test_every_curve_is_monotone_and_bounded(void **state)
{
    (void)state;
    for (int curve = 0; curve < 4; curve++) {
        float before = 0;
        for (int i = 0; i < 16000; i++) {
            float x = lsf_tonemap_expose(powf(10.0f, (float)i / 1000.0f - 8.0f), 1.0f);
            for (int c = 0; c < 3; c++) {
                float code = lsf_tonemap_code(curve, c, x, 0.3f * x, 0.01f * x);
                assert_true(code >= 0.0f && code <= 1.0f);
            }
            float grey = lsf_tonemap_code(curve, 0, x, x, x);
            assert_true(grey >= before - 1e-6f && grey - before < 0.02f);
            before = grey;
        }
        assert_true(before > 0.999f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_published_values),
        cmocka_unit_test(test_monotone_bounded_and_continuous),
        cmocka_unit_test(test_exposure_and_odd_values),
        cmocka_unit_test(test_srgb),
        cmocka_unit_test(test_none_cuts_off),
        cmocka_unit_test(test_aces),
        cmocka_unit_test(test_agx),
        cmocka_unit_test(test_every_curve_is_monotone_and_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
