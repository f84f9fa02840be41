/* The network on light made by hand, by OpenGL and by the CPU, against plain C. */
#include <math.h>

#include "base/base.h"
#include "math/half.h"
#include "math/sampling.h"
#include "net_rig.h"
#include "passes/denoise.h"
#include "surface_rig.h"

enum { MAX_PIXELS = 48 * 40, PADDED = 64 * 48 };
static const double PI_D = 3.14159265358979;

typedef float texels[MAX_PIXELS][4];

typedef struct rig {
    surface_rig s;
    lsf_denoise pass;
    const lsf_net *net;
    GLuint mean, factors[2], light[2], filtered[2]; /* textures */
    texels mean_texels, factor_texels[2], light_texels[2], filtered_texels[2];
    texels out[2];
} rig;

static uint32_t pixels_of(const rig *r)
{
    return r->s.width * r->s.height;
}

static void rig_begin(rig *r, uint32_t width, uint32_t height, bool orthographic,
                      const lsf_net *net, lsf_denoise_processor processor, bool recurrent)
{
    lsf_error error = {0};
    const lsf_denoise_params params = {processor};
    memset(r, 0, sizeof *r);
    assert_true(width * height <= MAX_PIXELS);
    surface_rig_begin(&r->s, width, height, orthographic);
    r->net = net;
    r->s.setup.plan->temporal = recurrent;
    lsf_denoise_plan(r->s.setup.plan, net);
    surface_rig_start(&r->s);
    if (!lsf_denoise_create(&r->pass, r->s.context, r->s.setup.plan, &params, net, &error))
        fail_msg("%s", error.message);
    GLuint *textures[] = {&r->mean,     &r->factors[0],  &r->factors[1], &r->light[0],
                          &r->light[1], &r->filtered[0], &r->filtered[1]};
    for (size_t i = 0; i < LSF_COUNT(textures); i++)
        *textures[i] = surface_rig_texture(&r->s, GL_RGBA32F, width, height);
}

static void rig_end(rig *r)
{
    GLuint *textures[] = {&r->mean,     &r->factors[0],  &r->factors[1], &r->light[0],
                          &r->light[1], &r->filtered[0], &r->filtered[1]};
    for (size_t i = 0; i < LSF_COUNT(textures); i++)
        lsf_texture_destroy(r->s.context, textures[i]);
    lsf_denoise_destroy(&r->pass);
    surface_rig_end(&r->s);
}

/* Noisy light on a bent wall, with background, black pixels, and some that are far too bright. */
static void set_texels(rig *r, uint32_t seed)
{
    for (uint32_t i = 0; i < pixels_of(r); i++) {
        float u[8];
        for (uint32_t k = 0; k < 8; k++)
            u[k] = lsf_random_float(seed + k, i);
        lsf_float3 normal = {0.3f * (u[0] - 0.5f), 0.2f + 0.3f * u[1], 0.9f};
        bool background = i % 11 == 5;
        float *mean = r->mean_texels[i];
        mean[0] = normal.x;
        mean[1] = normal.y;
        mean[2] = normal.z;
        mean[3] = background ? 0.0f : 0.01f + 0.3f * u[2];
        for (int part = 0; part < 2; part++) {
            float tells = background || u[3 + part] < 0.1f ? -1.0f : 1.0f;
            for (int c = 0; c < 3; c++) {
                float light = -logf(1.0f - u[4 + c]) * (u[7] > 0.97f ? 30.0f : 1.0f);
                r->light_texels[part][i][c] = tells > 0.0f ? light : 0.0f;
                r->filtered_texels[part][i][c] =
                    tells > 0.0f ? 0.7f + 0.3f * light + 0.1f * (float)part : 0.0f;
                r->factor_texels[part][i][c] = tells > 0.0f ? 0.1f + 0.5f * u[5] : 0.0f;
            }
            r->factor_texels[part][i][3] = u[6];
            r->light_texels[part][i][3] = tells > 0.0f ? u[2] : -1.0f;
            r->filtered_texels[part][i][3] = tells > 0.0f ? 0.01f * u[2] : -1.0f;
        }
    }
}

static void write_texels(rig *r)
{
    const uint32_t w = r->s.width, h = r->s.height;
    surface_rig_write(r->mean, w, h, r->mean_texels[0]);
    for (int part = 0; part < 2; part++) {
        surface_rig_write(r->factors[part], w, h, r->factor_texels[part][0]);
        surface_rig_write(r->light[part], w, h, r->light_texels[part][0]);
        surface_rig_write(r->filtered[part], w, h, r->filtered_texels[part][0]);
    }
}

static void run(rig *r)
{
    const lsf_denoise_inputs inputs = {.mean = r->mean,
                                       .specular_factor = r->factors[1],
                                       .light = {r->light[0], r->light[1]},
                                       .filtered = {r->filtered[0], r->filtered[1]},
                                       .factors = {r->factors[0], r->factors[1]}};
    write_texels(r);
    lsf_denoise_run(&r->pass, &r->s.iteration, &inputs);
    for (int part = 0; part < 2; part++)
        surface_rig_read(r->pass.light[part], r->s.width, r->s.height, r->out[part][0]);
    gl_test_check(r->s.context);
}

/* --- the same in plain C --- */

static double luminance_of(const float c[4])
{
    return 0.2126 * (double)c[0] + 0.7152 * (double)c[1] + 0.0722 * (double)c[2];
}

static double unit_of(int part)
{
    return part == 0 ? PI_D : 1.0;
}

static double expected_scale(const rig *r)
{
    double sum = 0.0, count = 0.0;
    for (uint32_t i = 0; i < pixels_of(r); i++) {
        double light = 0.0;
        bool tells = false;
        for (int part = 0; part < 2; part++)
            if (r->filtered_texels[part][i][3] >= 0.0f) {
                light += luminance_of(r->filtered_texels[part][i]) / unit_of(part);
                tells = true;
            }
        sum += tells ? sqrt(light) : 0.0;
        count += tells;
    }
    return count > 0.0 ? (sum / count) * (sum / count) : 0.0;
}

static double along(const float v[4], lsf_vec4 axis)
{
    double length = sqrt((double)(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z));
    return ((double)v[0] * (double)axis.x + (double)v[1] * (double)axis.y +
            (double)v[2] * (double)axis.z) /
           length;
}

static double expected_depth(const rig *r, float depth)
{
    const struct lsf_view_data *view = &r->s.iteration.view;
    double a = (double)view->depth.x, b = (double)view->depth.y, start = (double)view->depth.w;
    double d = (double)depth;
    return start + (r->s.setup.plan->orthographic ? (d - b) / a : (b - d * start) / (d - a));
}

static void expected_features(const rig *r, uint32_t i, double scale, float f[LSF_NET_INPUTS])
{
    const struct lsf_view_data *view = &r->s.iteration.view;
    bool orthographic = r->s.setup.plan->orthographic;
    const float *mean = r->mean_texels[i];
    memset(f, 0, LSF_NET_INPUTS * sizeof *f);
    if (mean[3] == 0.0f)
        return;
    for (int part = 0; part < 2; part++) {
        const float *light = r->light_texels[part][i], *filtered = r->filtered_texels[part][i];
        double unit = 10.0 / (unit_of(part) * scale);
        if (light[3] < 0.0f)
            continue;
        for (int c = 0; c < 3; c++) {
            f[3 * part + c] = (float)log(1.0 + unit * (double)light[c]);
            f[6 + 3 * part + c] = (float)log(1.0 + unit * (double)filtered[c]);
        }
        f[18 + part] = (float)log(1.0 + unit * sqrt((double)light[3]));
    }
    f[12] = (float)along(mean, orthographic ? view->start_dx : view->forward_dx);
    f[13] = (float)along(mean, orthographic ? view->start_dy : view->forward_dy);
    f[14] = (float)-along(mean, view->forward);
    f[15] = (float)(1.0 / (1.0 + fmax(expected_depth(r, mean[3]), 0.0)));
    f[16] = r->factor_texels[1][i][3];
    f[17] = (float)luminance_of(r->factor_texels[1][i]);
}

/* Of the light before and after. */
static double gain_of(const double sums[2])
{
    return sums[0] > 0.0 && sums[1] > 0.0 ? fmin(fmax(sums[0] / sums[1], 0.5), 2.0) : 1.0;
}

/* Specular light lies between what was filtered and the mean of its logarithms over 3 x 3 pixels.
 */
static double blended(const rig *r, uint32_t i, int c, double light, double unit)
{
    int w = (int)r->s.width, h = (int)r->s.height, x = (int)i % w, y = (int)i / w;
    double own = (double)r->filtered_texels[1][i][c], sum = 0.0, count = 0.0;
    for (int v = y - 1; v <= y + 1; v++)
        for (int u = x - 1; u <= x + 1; u++) {
            if (u < 0 || v < 0 || u >= w || v >= h || r->filtered_texels[1][v * w + u][3] < 0.0f)
                continue;
            sum += log(1.0 + (double)r->filtered_texels[1][v * w + u][c] / unit);
            count += 1.0;
        }
    double mean = unit * (exp(sum / count) - 1.0);
    return fmin(fmax(light, fmin(own, mean)), fmax(own, mean));
}

/* Sets `expected` to what comes out, of the network's state, which is brought to the next frame. */
static void expect(const rig *r, float *state, texels expected[2])
{
    static float input[LSF_NET_INPUTS * PADDED], output[LSF_NET_OUTPUTS * PADDED];
    float features[LSF_NET_INPUTS];
    uint32_t w = r->pass.width, h = r->pass.height, step = lsf_net_granularity(r->net);
    assert_true(w % step == 0 && h % step == 0 && w - r->s.width < step && h - r->s.height < step);
    assert_true(w * h <= PADDED);
    double scale = expected_scale(r), sums[2][3][2] = {{{0}}};
    for (uint32_t y = 0; y < h; y++)
        for (uint32_t x = 0; x < w; x++) {
            uint32_t from_x = x < r->s.width ? x : r->s.width - 1;
            uint32_t from_y = y < r->s.height ? y : r->s.height - 1;
            expected_features(r, from_y * r->s.width + from_x, scale, features);
            for (uint32_t c = 0; c < LSF_NET_INPUTS; c++)
                input[(c * h + y) * w + x] = features[c];
        }
    net_rig_run(r->net, w, h, input, output, state);
    for (uint32_t i = 0; i < pixels_of(r); i++)
        for (int part = 0; part < 2; part++)
            for (int c = 0; c < 3; c++) {
                size_t at = (size_t)(3 * part + c) * w * h + i / r->s.width * w + i % r->s.width;
                double light = (double)r->filtered_texels[part][i][c];
                double unit = unit_of(part) * scale / 10.0;
                double factor = (double)r->factor_texels[part][i][c];
                if (r->filtered_texels[part][i][3] >= 0.0f) {
                    light =
                        unit * (exp(fmax(log(1.0 + light / unit) + (double)output[at], 0.0)) - 1.0);
                    light = part == 1 ? blended(r, i, c, light, unit) : light;
                    sums[part][c][0] += factor * (double)r->light_texels[part][i][c];
                    sums[part][c][1] += factor * light;
                }
                expected[part][i][c] = (float)light;
            }
    for (uint32_t i = 0; i < pixels_of(r); i++)
        for (int part = 0; part < 2; part++)
            for (int c = 0; c < 3; c++)
                expected[part][i][c] *= (float)gain_of(sums[part][c]);
}

static void compare(const rig *r, texels expected[2], const char *what)
{
    double worst = 0.0, changed = 0.0;
    for (int part = 0; part < 2; part++)
        for (uint32_t i = 0; i < pixels_of(r); i++) {
            assert_true(r->out[part][i][3] == r->filtered_texels[part][i][3]);
            for (int c = 0; c < 3; c++) {
                double e = (double)expected[part][i][c], o = (double)r->out[part][i][c];
                worst = fmax(worst, fabs(o - e) / fmax(e, 0.1));
                changed = fmax(changed, fabs((double)r->filtered_texels[part][i][c] - e));
            }
        }
    print_message("%s, %ux%u, %u stages: %.1e apart\n", what, r->s.width, r->s.height,
                  r->net->stages, worst);
    assert_true(changed > 0.1 || r->s.width == 1);
    assert_true(worst < 1e-3); /* half floats have a relative error of 5e-4, in each layer */
}

/* Three frames, the last after a cut; sizes that no stage divides. */
static void both_processors_agree_with_plain_c(void **unused)
{
    (void)unused;
    static rig r;
    static texels expected[2];
    static const uint32_t sizes[][2] = {{1, 1}, {7, 13}, {47, 34}, {20, 40}};
    static const char *const names[] = {[LSF_DENOISE_GL] = "gl", [LSF_DENOISE_CPU] = "cpu"};
    lsf_error missing = {0};
    bool has_module = lsf_denoiser_module_get(&missing);
    for (uint32_t test = 0; test < 2 * LSF_COUNT(sizes); test++)
        for (int processor = LSF_DENOISE_GL; processor <= LSF_DENOISE_CPU; processor++) {
            uint32_t s = test / 2;
            bool recurrent = test % 2;
            if (processor == LSF_DENOISE_CPU && !has_module)
                continue;
            lsf_net *net = net_rig_make(s + 1, 0.1f, 1.0f, 0.3f, s);
            rig_begin(&r, sizes[s][0], sizes[s][1], s % 2, net, (lsf_denoise_processor)processor,
                      recurrent);
            float *state =
                calloc(net_rig_state_size(net, r.pass.width, r.pass.height), sizeof *state);
            for (uint32_t frame = 0; frame < 3; frame++) {
                lsf_denoise_begin(&r.pass, frame == 2);
                if (frame == 2 || !recurrent)
                    memset(state, 0,
                           sizeof *state * net_rig_state_size(net, r.pass.width, r.pass.height));
                set_texels(&r, 10 * frame);
                expect(&r, state, expected);
                run(&r);
                compare(&r, expected, names[processor]);
                texels *before = calloc(2, sizeof *before);
                memcpy(before, r.out, sizeof r.out);
                run(&r); /* the same frame anew has the same bits */
                assert_memory_equal(before, r.out, sizeof r.out);
                free(before);
            }
            free(state);
            rig_end(&r);
            lsf_net_destroy(net);
        }
}

/* Weights of zero leave the light as it was filtered, but for the picture's brightness, which is
 * that of the light before. */
static void the_picture_keeps_its_light(void **unused)
{
    (void)unused;
    static rig r;
    for (uint32_t test = 0; test < 2; test++) {
        lsf_net *net = net_rig_make(2, 0.0f, test ? 1.0f : 0.0f, 0.3f, 4);
        rig_begin(&r, 48, 40, false, net, LSF_DENOISE_GL, false);
        lsf_denoise_begin(&r.pass, true);
        set_texels(&r, 3);
        run(&r);
        for (int part = 0; part < 2; part++)
            for (int c = 0; c < 3; c++) {
                double before = 0.0, after = 0.0, ratio = 0.0;
                for (uint32_t i = 0; i < pixels_of(&r); i++) {
                    if (r.filtered_texels[part][i][3] < 0.0f)
                        continue;
                    double factor = (double)r.factor_texels[part][i][c];
                    before += factor * (double)r.light_texels[part][i][c];
                    after += factor * (double)r.out[part][i][c];
                    double own = (double)(r.out[part][i][c] / r.filtered_texels[part][i][c]);
                    assert_true(test || ratio == 0.0 || fabs(own / ratio - 1.0) < 1e-5);
                    ratio = own;
                }
                print_message("part %d, channel %d: %.6f of the light\n", part, c, after / before);
                assert_true(fabs(after / before - 1.0) < 1e-4);
            }
        rig_end(&r);
        lsf_net_destroy(net);
    }
}

/* A black picture; one without anything; light beyond all bounds in a pixel; as bright as light may
 * be, and as dark. Nothing of it is not finite. */
static void nothing_becomes_infinite(void **unused)
{
    (void)unused;
    static rig r;
    static const float factors[] = {0.0f, 1.0f, 1e17f, 1e-24f, 1e18f};
    lsf_net *net = net_rig_make(3, 0.0f, 3.0f, 1.0f, 5);
    rig_begin(&r, 20, 12, false, net, LSF_DENOISE_GL, false);
    for (uint32_t test = 0; test < 2 * LSF_COUNT(factors); test++) {
        lsf_denoise_begin(&r.pass, false);
        set_texels(&r, test);
        for (int part = 0; part < 2; part++)
            for (uint32_t i = 0; i < pixels_of(&r); i++)
                for (int c = 0; c < 4; c++) {
                    /* All of it, or one pixel. */
                    float factor = test % 2 && i != 40 ? 1.0f : factors[test / 2];
                    float power = c == 3 && r.light_texels[part][i][c] >= 0.0f ? factor * factor
                                  : c == 3                                     ? 1.0f
                                                                               : factor;
                    r.light_texels[part][i][c] = fminf(r.light_texels[part][i][c] * power, 1e36f);
                    r.filtered_texels[part][i][c] =
                        fminf(r.filtered_texels[part][i][c] * power, 1e36f);
                }
        run(&r);
        for (int part = 0; part < 2; part++)
            for (uint32_t i = 0; i < pixels_of(&r); i++)
                for (int c = 0; c < 3; c++) {
                    assert_true(isfinite(r.out[part][i][c]) && r.out[part][i][c] >= 0.0f);
                    assert_true(test > 0 || r.out[part][i][c] == 0.0f);
                }
    }
    for (int part = 0; part < 2; part++)
        for (uint32_t i = 0; i < pixels_of(&r); i++) {
            r.mean_texels[i][3] = 0.0f;
            r.light_texels[part][i][3] = r.filtered_texels[part][i][3] = -1.0f;
        }
    run(&r);
    assert_memory_equal(r.out[0], r.filtered_texels[0], 16 * pixels_of(&r));
    rig_end(&r);
    lsf_net_destroy(net);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_processors_agree_with_plain_c),
        cmocka_unit_test(the_picture_keeps_its_light),
        cmocka_unit_test(nothing_becomes_infinite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
