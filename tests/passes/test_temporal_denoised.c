/* Denoised light blended with that of the frames before, against plain C. */
#include <math.h>

#include "base/base.h"
#include "math/sampling.h"
#include "surface_rig.h"

enum { WIDTH = 12, HEIGHT = 8, PIXELS = WIDTH * HEIGHT, ITERATIONS = 3, FRAMES = 4 };

typedef float texels[PIXELS][4];

static const lsf_temporal_params temporal_params = {
    .frames = 32, .lag = 8, .denoised_frames = FRAMES};

/* Noisy light with its history; some of it tells nothing, is black, or not finite. */
static void set_texels(texels now, texels carried, uint32_t seed)
{
    for (uint32_t i = 0; i < PIXELS; i++)
        for (uint32_t c = 0; c < 4; c++) {
            float u = lsf_random_float(seed + c, i), v = lsf_random_float(seed + 4 + c, i);
            now[i][c] = i % 7 == 1 ? 0.0f : 4.0f * u;
            carried[i][c] = i % 5 == 2 ? now[i][c] : i % 9 == 4 ? 0.0f : 4.0f * v;
            if (c == 3) {
                now[i][c] = i % 8 == 3 ? -1.0f : u; /* variance */
                carried[i][c] = i % 6 == 5 ? 0.0f : 40.0f * v;
            }
        }
    now[20][1] = NAN;
    now[21][0] = INFINITY;
}

static double luminance_of(const float c[4])
{
    return 0.2126 * (double)c[0] + 0.7152 * (double)c[1] + 0.0722 * (double)c[2];
}

static bool told(const float now[4])
{
    return now[3] >= 0.0f && isfinite(now[0]) && isfinite(now[1]) && isfinite(now[2]);
}

/* Of the history in the sum. */
static double expected_share(const float now[4], const float carried[4])
{
    double before = fmin((double)carried[3], (double)FRAMES * ITERATIONS);
    double a = luminance_of(now), b = luminance_of(carried), most = fmax(a, b);
    double gradient = most > 0.0 ? fabs(a - b) / most : 0.0;
    return before / (before + ITERATIONS) * (1.0 - gradient);
}

static void check(texels now, texels carried, texels out, texels counts, int part)
{
    for (uint32_t i = 0; i < PIXELS; i++) {
        double share = told(now[i]) ? expected_share(now[i], carried[i]) : 0.0;
        double count = told(now[i]) ? ITERATIONS / (1.0 - share) : 0.0;
        assert_true(fabs((double)counts[i][part] - count) < 1e-4 * (1.0 + count));
        for (int c = 0; c < 4; c++)
            assert_true((c < 3 && share != 0.0) || gl_test_same_float(out[i][c], now[i][c]));
        for (int c = 0; c < 3 && told(now[i]); c++) {
            double e = (1.0 - share) * (double)now[i][c] + share * (double)carried[i][c];
            assert_true(fabs((double)out[i][c] - e) < 1e-5 * (1.0 + e));
        }
    }
}

static void history_counts_by_its_gradient(void **unused)
{
    (void)unused;
    static surface_rig rig;
    static lsf_temporal pass;
    static texels now[2], carried[2], out, counts;
    const lsf_temporal_change cut = {.cut = true};
    lsf_error error = {0};
    GLuint denoised[2];
    surface_rig_begin(&rig, WIDTH, HEIGHT, false);
    lsf_plan *plan = rig.setup.plan;
    lsf_temporal_plan(plan, &temporal_params, true);
    surface_rig_start(&rig);
    if (!lsf_temporal_create(&pass, rig.context, plan, &temporal_params, 0, &error))
        fail_msg("%s", error.message);
    lsf_temporal_begin(&pass, &cut, ITERATIONS, &rig.setup.state.camera);
    for (int part = 0; part < 2; part++) {
        set_texels(now[part], carried[part], 100 * (uint32_t)part);
        denoised[part] = surface_rig_texture(&rig, GL_RGBA32F, WIDTH, HEIGHT);
        surface_rig_write(denoised[part], WIDTH, HEIGHT, now[part][0]);
        surface_rig_write(pass.parts[part].denoised_carried, WIDTH, HEIGHT, carried[part][0]);
    }
    lsf_temporal_blend_denoised(&pass, plan, ITERATIONS, denoised);
    surface_rig_read(pass.denoised_count, WIDTH, HEIGHT, counts[0]);
    for (int part = 0; part < 2; part++) {
        surface_rig_read(pass.parts[part].denoised, WIDTH, HEIGHT, out[0]);
        check(now[part], carried[part], out, counts, part);
        lsf_texture_destroy(rig.context, &denoised[part]);
    }
    gl_test_check(rig.context);
    lsf_temporal_destroy(&pass);
    surface_rig_end(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(history_counts_by_its_gradient)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
