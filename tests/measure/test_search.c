/* The search for the best configuration, on curves that are known: what it finds, what it costs. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/base.h"
#include "math/sampling.h"
#include "sweep/fit.h"
#include "sweep/search.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 64, SEEDS = 4 };

/* error(N) = floor + noise / N^power, a frame's time fixed + each N. */
typedef struct curve {
    double floor, noise, power, fixed, each;
} curve;

typedef struct world {
    lsf_measurement measurement;
    curve curves[MOST];
    uint32_t count, seed;
    double spread; /* relative, of a seed's error */
    double spent;  /* milliseconds of frames */
    uint32_t stop_after, measured;
    uint32_t broken; /* a configuration that fails */
} world;

static double error_of(const curve *c, double samples)
{
    return c->floor + c->noise * pow(samples, -c->power);
}

static double time_of(const curve *c, double samples)
{
    return c->fixed + c->each * samples;
}

static double noise_of(world *w)
{
    return 1.0 + w->spread * (double)(2.0f * lsf_random_float(w->seed, w->measured++) - 1.0f);
}

static bool measure(void *user, uint32_t configuration, uint32_t samples, uint32_t seeds,
                    bool *stopped, lsf_error *error)
{
    (void)error;
    world *w = user;
    const curve *c = &w->curves[configuration];
    lsf_measured_point *point = lsf_measurement_find(&w->measurement, configuration, samples);
    *stopped = w->stop_after > 0 && w->measured >= w->stop_after;
    if (*stopped || configuration == w->broken || (point && point->seed_count >= seeds))
        return true;
    if (point)
        lsf_measurement_drop_point(&w->measurement, point);
    point = lsf_measurement_add_point(&w->measurement);
    assert_non_null(point);
    point->configuration = configuration;
    point->samples = samples;
    point->seed_count = seeds;
    for (uint32_t s = 0; s < seeds; s++) {
        point->seeds[s].milliseconds = time_of(c, samples);
        for (uint32_t t = 0; t <= s; t++) {
            double value = t < s ? c->floor : error_of(c, samples) * noise_of(w);
            point->relmse.products[s][t] = point->relmse.products[t][s] = value;
        }
        w->spent += point->seeds[s].milliseconds;
    }
    lsf_measured_point_derive(point);
    return true;
}

static world new_world(const curve *curves, uint32_t count)
{
    world w = {.count = count, .broken = UINT32_MAX};
    for (uint32_t i = 0; i < count; i++) {
        char option[32];
        const char *options[] = {option};
        snprintf(option, sizeof option, "vpl.count=%u", i);
        assert_int_equal(lsf_measurement_add_configuration(&w.measurement, "direct", options, 1),
                         i);
        w.curves[i] = curves[i];
    }
    return w;
}

static void ask(world *w, double budget_ms, double relmse)
{
    lsf_error error;
    lsf_search search = {.measurement = &w->measurement,
                         .budget_ms = budget_ms,
                         .relmse = relmse,
                         .seeds = SEEDS,
                         .most_samples = 1 << 20,
                         .measure = measure,
                         .user = w};
    assert_true(lsf_search_run(&search, &error));
}

/* The least error of all of them within a time, by as many samples as fit. */
static double best_within(const world *w, double budget_ms)
{
    double best = INFINITY;
    for (uint32_t i = 0; i < w->count; i++) {
        double samples = floor((budget_ms - w->curves[i].fixed) / w->curves[i].each + 1e-9);
        if (samples >= 1.0)
            best = fmin(best, error_of(&w->curves[i], samples));
    }
    return best;
}

static const curve crossing[] = {
    {1e-1, 0.01, 1.0, 0.0, 1.0},   /* quick and wrong */
    {1e-2, 0.5, 1.0, 5.0, 4.0},    /* in between */
    {1e-5, 8.0, 1.0, 10.0, 8.0},   /* right in the end */
    {2e-1, 1.0, 1.0, 0.0, 100.0},  /* never any good */
    {1e-4, 9.0, 1.0, 0.0, 5000.0}, /* slow */
};

static void test_within_a_time(void **state)
{
    (void)state;
    static const struct {
        double budget;
        uint32_t best;
    } rows[] = {{2.0, 0}, {50.0, 1}, {300.0, 1}, {30000.0, 2}};
    for (size_t i = 0; i < LSF_COUNT(rows); i++) {
        world w = new_world(crossing, LSF_COUNT(crossing));
        ask(&w, rows[i].budget, NAN);
        const lsf_answer *answer = &w.measurement.answer;
        assert_true(answer->given && answer->met);
        assert_int_equal(answer->configuration, rows[i].best);
        assert_true(answer->milliseconds <= rows[i].budget);
        assert_true(answer->error.value <= 1.1 * best_within(&w, rows[i].budget));
        assert_true(answer->confidence > 0.99);
        lsf_measurement_finish(&w.measurement);
    }
}

static void test_nothing_is_quick_enough(void **state)
{
    (void)state;
    world w = new_world(crossing, LSF_COUNT(crossing));
    ask(&w, 0.5, NAN);
    assert_true(w.measurement.answer.given);
    assert_false(w.measurement.answer.met);
    assert_int_equal(w.measurement.answer.configuration, 0); /* the quickest */
    assert_int_equal(w.measurement.answer.samples, 1);
    assert_int_equal(w.measurement.point_count, LSF_COUNT(crossing)); /* one look at each */
    assert_int_equal(w.measurement.points[0].seed_count, 2);
    lsf_measurement_finish(&w.measurement);
}

/* Random curves with noise: at most a tenth more error than the best but in four of 180 answers,
 * for less than half of the time that an exhaustive search would take. */
static void test_regret(void **state)
{
    (void)state;
    enum { WORLDS = 60, COUNT = 24 };
    uint32_t poor = 0;
    double spent = 0.0, exhaustive = 0.0, worst = 0.0;
    for (uint32_t k = 0; k < WORLDS; k++) {
        curve curves[COUNT];
        uint32_t index = 0;
        for (uint32_t i = 0; i < COUNT; i++) {
            double u[5];
            for (int j = 0; j < 5; j++)
                u[j] = (double)lsf_random_float(k + 1, index++);
            curves[i] = (curve){pow(10.0, -5.0 + 3.0 * u[0]), pow(10.0, -2.0 + 2.0 * u[1]),
                                0.7 + 0.6 * u[2], 20.0 * u[3], pow(10.0, 0.5 + 2.0 * u[4])};
        }
        static const double budgets[] = {100.0, 1000.0, 10000.0};
        for (size_t b = 0; b < LSF_COUNT(budgets); b++) {
            world w = new_world(curves, COUNT);
            w.seed = 1000 + k;
            w.spread = 0.15;
            ask(&w, budgets[b], NAN);
            const lsf_answer *answer = &w.measurement.answer;
            double best = best_within(&w, budgets[b]);
            double regret =
                isfinite(best)
                    ? error_of(&curves[answer->configuration], answer->samples) / best - 1.0
                    : 0.0;
            poor += regret > 0.1;
            worst = fmax(worst, regret);
            spent += w.spent;
            exhaustive += (double)SEEDS * COUNT * budgets[b];
            lsf_measurement_finish(&w.measurement);
        }
    }
    print_message("%u of %u answers are worse by more than 10 %%, %.0f %% at most; %.2f of the "
                  "time of an exhaustive search\n",
                  poor, WORLDS * 3, 100.0 * worst, spent / exhaustive);
    assert_true(poor <= 4);
    assert_true(spent < 0.5 * exhaustive);
}

static void test_to_an_error(void **state)
{
    (void)state;
    static const struct {
        double relmse, best_ms;
    } rows[] = {
        {0.2, 1.0},                  /* of the first: 0.11 */
        {0.05, 5.0 + 4.0 * 13.0},    /* of the second: 0.5 / 0.04 = 12.5 samples */
        {1e-3, 10.0 + 8.0 * 8081.0}, /* of the third: 8 / (1e-3 - 1e-5) */
    };
    for (size_t i = 0; i < LSF_COUNT(rows); i++) {
        world w = new_world(crossing, 4);
        ask(&w, NAN, rows[i].relmse);
        const lsf_answer *answer = &w.measurement.answer;
        assert_true(answer->given && answer->met);
        assert_true(answer->error.value <= rows[i].relmse);
        assert_float_equal((float)(answer->milliseconds / rows[i].best_ms), 1.0f, 0.03f);
        lsf_measurement_finish(&w.measurement);
    }
    world w = new_world(crossing, 1); /* whose floor is 0.1 */
    ask(&w, NAN, 0.05);
    assert_true(w.measurement.answer.given);
    assert_false(w.measurement.answer.met);
    lsf_measurement_finish(&w.measurement);
}

static void test_failures_and_interrupts(void **state)
{
    (void)state;
    world w = new_world(crossing, LSF_COUNT(crossing));
    w.broken = 1;
    ask(&w, 300.0, NAN);
    assert_true(w.measurement.answer.met);
    assert_int_not_equal(w.measurement.answer.configuration, 1);
    lsf_measurement_finish(&w.measurement);

    for (uint32_t after = 1; after < 60; after += 7) {
        w = new_world(crossing, LSF_COUNT(crossing));
        w.stop_after = after;
        ask(&w, 300.0, NAN);
        assert_true(w.measurement.answer.given);
        assert_true(isnan(w.measurement.answer.confidence)); /* of what has not been looked at */
        lsf_measurement_finish(&w.measurement);
    }
    w = new_world(crossing, 1);
    w.broken = 0;
    ask(&w, 300.0, NAN);
    assert_false(w.measurement.answer.given);
    ask(&w, NAN, 0.1);
    assert_false(w.measurement.answer.given);
    lsf_measurement_finish(&w.measurement);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_within_a_time),
        cmocka_unit_test(test_nothing_is_quick_enough),
        cmocka_unit_test(test_regret),
        cmocka_unit_test(test_to_an_error),
        cmocka_unit_test(test_failures_and_interrupts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
