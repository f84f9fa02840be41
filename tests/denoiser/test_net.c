/* Files of weights, good and bad; and oneDNN against plain C. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/base.h"
#include "denoiser/chain.h"
#include "denoiser/module.h"
#include "math/half.h"
#include "math/sampling.h"
#include "net_rig.h"

static void halves_come_back(void **unused)
{
    (void)unused;
    for (uint32_t i = 0; i < 0x10000; i++) {
        float value = lsf_half_to_float((uint16_t)i);
        if (!isnan(value))
            assert_int_equal(lsf_float_to_half(value), i);
        else
            assert_true(isnan(lsf_half_to_float(lsf_float_to_half(value))));
    }
    assert_true(lsf_half_to_float(0x3c01) == 1.0f + 0x1p-10f);
    assert_true(lsf_half_to_float(0x0001) == 0x1p-24f);
    assert_int_equal(lsf_float_to_half(1.0f + 0x1p-11f), 0x3c00); /* to the even one */
    assert_int_equal(lsf_float_to_half(1.0f + 0x1.8p-10f), 0x3c02);
    assert_int_equal(lsf_float_to_half(65519.0f), 0x7bff);
    assert_int_equal(lsf_float_to_half(-65520.0f), 0xfc00);
}

static void good_files_are_read(void **unused)
{
    (void)unused;
    for (uint32_t stages = 1; stages <= LSF_NET_STAGES_MAX; stages++) {
        lsf_net *net = net_rig_make(stages, 0.1f, 1.0f, 1.0f, stages);
        assert_non_null(net);
        assert_int_equal(net->stages, stages);
        assert_int_equal(lsf_net_granularity(net), 1u << (stages - 1));
        assert_true(net->recurrent);
        assert_string_equal(lsf_net_out(net)->name, "out");
        if (stages > 1)
            assert_string_equal(lsf_net_decode(net, 1, true)->name, "dec1b");
        lsf_net_destroy(net);
    }
    lsf_net *zeros = net_rig_make(2, 0.0f, 0.0f, 1.0f, 1);
    assert_false(zeros->recurrent);
    lsf_net_destroy(zeros);
    lsf_error error = {0};
    lsf_net *built_in = lsf_net_load(NULL, &error);
    assert_non_null(built_in);
    lsf_net_destroy(built_in);
}

static void assert_refused(const char *bytes, size_t length, const char *what)
{
    lsf_error error = {0};
    assert_null(lsf_net_read(bytes, length, "some.lsfd", &error));
    assert_int_equal(error.code, LSF_ERROR_FILE);
    assert_non_null(strstr(error.message, "some.lsfd"));
    if (!strstr(error.message, what))
        fail_msg("\"%s\" does not say \"%s\"", error.message, what);
}

/* Where the layer enc1a has its size. */
enum { SIZE_AT = 16 + 1 + 5 };

static void bad_files_are_refused(void **unused)
{
    (void)unused;
    size_t length;
    char *good = net_rig_bytes(2, 0.0f, 1.0f, 1.0f, 7, &length);
    char *bad = malloc(length + 1);
    for (size_t cut = 0; cut < length; cut += cut < 64 ? 1 : 97)
        assert_refused(good, cut, cut < 4 ? "no file of weights" : "cut short");
    const struct {
        size_t at, count;
        uint32_t value;
        const char *what;
    } cases[] = {
        {0, 4, 0x46534c4d, "no file of weights"},
        {4, 4, 2, "another version"},
        {8, 4, 8, "number of layers"},
        {8, 4, 0xffffffff, "number of layers"},
        {12, 4, 0x7fc00000, "not a number"},
        {16, 1, 200, "too long"},
        {17, 1, 'x', "stands where \"enc1a\" has to"},
        {17, 1, '\n', "layer \"?nc1a\""},
        {SIZE_AT, 4, 0, "would fit"},
        {SIZE_AT, 4, 0xffffffff, "would fit"},
        {SIZE_AT, 4, 1024, "cut short"},
        {SIZE_AT + 4, 4, 19, "would fit"},
        {SIZE_AT + 8, 4, 5, "would fit"},
        {SIZE_AT + 16, 2, 0x7c00, "not a number"},
        {SIZE_AT + 16, 2, 0x7e00, "not a number"},
    };
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        memcpy(bad, good, length);
        memcpy(bad + cases[i].at, &cases[i].value, cases[i].count);
        assert_refused(bad, length, cases[i].what);
    }
    memcpy(bad, good, length);
    bad[length] = 0;
    assert_refused(bad, length + 1, "bytes follow");
    free(good);
    free(bad);
    lsf_error error = {0};
    assert_null(lsf_net_load("/nowhere/at/all.lsfd", &error));
    assert_int_equal(error.code, LSF_ERROR_FILE);
}

/* Maps that are needed at the same time share no bytes; all of them take fewer than one by one. */
static void maps_share_bytes(void **unused)
{
    (void)unused;
    for (int recurrent = 0; recurrent < 2; recurrent++) {
        lsf_net *net = net_rig_make(4, 0.0f, 1.0f, 1.0f, 1);
        lsf_net_chain chain;
        uint64_t sum = 0;
        lsf_net_chain_make(&chain, net, 64, 32, recurrent);
        chain.maps[chain.step_count].home = LSF_NET_SHARED; /* as on the CPU */
        for (uint32_t i = 0; i <= chain.step_count; i++)
            chain.maps[i].bytes =
                (uint64_t)chain.maps[i].features * chain.maps[i].width * chain.maps[i].height;
        lsf_net_chain_assign_offsets(&chain, 64);
        for (uint32_t step = 0; step < chain.step_count; step++)
            for (uint32_t a = 1; a <= chain.step_count; a++)
                for (uint32_t b = 1; b < a; b++) {
                    bool needed[2] = {false, false};
                    const uint32_t maps[2] = {a, b};
                    for (int k = 0; k < 2; k++)
                        for (uint32_t user = step; user < chain.step_count; user++)
                            needed[k] = needed[k] || (maps[k] <= step + 1 &&
                                                      (chain.steps[user].source == maps[k] ||
                                                       chain.steps[user].beside == maps[k] ||
                                                       (user == step && step + 1 == maps[k])));
                    const lsf_net_map *x = &chain.maps[a], *y = &chain.maps[b];
                    if (needed[0] && needed[1] && x->home == y->home && x->home != LSF_NET_OUTSIDE)
                        assert_true(x->offset >= y->offset + y->bytes ||
                                    y->offset >= x->offset + x->bytes);
                }
        for (uint32_t i = 1; i <= chain.step_count; i++)
            sum += chain.maps[i].home == LSF_NET_SHARED ? chain.maps[i].bytes : 0;
        print_message("%llu bytes for %llu\n", (unsigned long long)chain.shared_bytes,
                      (unsigned long long)sum);
        assert_true(chain.shared_bytes < sum * 3 / 4);
        lsf_net_destroy(net);
    }
}

static void compare(const float *a, const float *b, size_t count, float tolerance)
{
    float most = 0.0f, apart = 0.0f;
    for (size_t i = 0; i < count; i++) {
        most = fmaxf(most, fabsf(b[i]));
        apart = fmaxf(apart, fabsf(a[i] - b[i]));
    }
    print_message("up to %g, %g apart\n", (double)most, (double)apart);
    assert_true(most > 0.1f);
    assert_true(apart <= tolerance * most);
}

/* One stage is convolutions alone, two add the pooling, the doubling and what is read beside it.
 * Three frames, and a cut before the third. */
static void onednn_agrees_with_plain_c(void **unused)
{
    (void)unused;
    lsf_error error = {0};
    const lsf_denoiser_module *module = lsf_denoiser_module_get(&error);
    if (!module) {
        print_message("%s\n", error.message);
        skip();
    }
    enum { WIDTH = 24, HEIGHT = 16, PIXELS = WIDTH * HEIGHT };
    static float input[LSF_NET_INPUTS * PIXELS], again[LSF_NET_OUTPUTS * PIXELS];
    static float output[LSF_NET_OUTPUTS * PIXELS], expected[LSF_NET_OUTPUTS * PIXELS];
    for (uint32_t test = 0; test < 8; test++) {
        uint32_t stages = 1 + test / 2;
        bool recurrent = test % 2;
        lsf_net *net = net_rig_make(stages, stages % 2 ? 0.1f : 0.0f, 1.4f, 1.0f, stages);
        size_t size = net_rig_state_size(net, WIDTH, HEIGHT);
        float *state = calloc(size, sizeof *state);
        void *runner = module->create(net, WIDTH, HEIGHT, recurrent, &error);
        assert_non_null(runner);
        for (uint32_t frame = 0; frame < 3; frame++) {
            for (uint32_t i = 0; i < LSF_COUNT(input); i++)
                input[i] = 2.0f * lsf_random_float(50 + frame, i);
            if (frame == 2 || !recurrent)
                memset(state, 0, size * sizeof *state);
            bool kept = recurrent && frame == 1;
            net_rig_run(net, WIDTH, HEIGHT, input, expected, state);
            assert_true(module->run(runner, input, output, kept, &error));
            assert_true(module->run(runner, input, again, kept, &error));
            assert_memory_equal(output, again, sizeof output);
            compare(output, expected, LSF_COUNT(output), 1e-5f);
            if (recurrent)
                module->keep(runner);
        }
        module->destroy(runner);
        free(state);
        lsf_net_destroy(net);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(halves_come_back),           cmocka_unit_test(good_files_are_read),
        cmocka_unit_test(bad_files_are_refused),      cmocka_unit_test(maps_share_bytes),
        cmocka_unit_test(onednn_agrees_with_plain_c),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
