#include "sweep/search.h"

#include <math.h>
#include <stdlib.h>

#include "base/base.h"
#include "sweep/fit.h"
#include "sweep/front.h"
#include "sweep/statistics.h"

enum { ROUGH_SEEDS = 2, FEWEST = 3, FEW_SAMPLES = 4, MOST_CONTENDERS = 6, DECISIONS = 2 };
#define FIRST_PART (1.0 / 64.0) /* of the time; GROWTH is the factor of each rung */
#define GROWTH 4.0
#define CHANCE 1.5   /* standard deviations that an error estimated from seeds may be off */
#define SURE 0.9     /* probability that no other is better by 10 % */
#define HOPELESS 2.0 /* times the requested error: a floor that ends the search */

typedef struct candidate {
    uint32_t configuration;
    double least, most; /* bounds of the relMSE predicted for the whole time */
} candidate;

typedef struct search_run {
    const lsf_search *search;
    lsf_measurement *m;
    candidate *candidates;
    uint32_t count;
    double seed_variance; /* of the logarithm of an error, between seeds */
    bool stopped;
} search_run;

static bool measure(search_run *run, uint32_t configuration, uint32_t samples, uint32_t seeds,
                    lsf_error *error)
{
    return run->search->measure(run->search->user, configuration, samples, seeds, &run->stopped,
                                error);
}

/* All configurations that have not failed. */
static bool list_candidates(search_run *run, lsf_error *error)
{
    run->candidates = lsf_alloc((uint64_t)run->m->configuration_count + 1, sizeof(candidate));
    if (!run->candidates)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    for (uint32_t c = 0; c < run->m->configuration_count; c++)
        run->candidates[run->count++].configuration = c;
    return true;
}

/* Configurations without a point have failed. */
static void drop_failures(search_run *run)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < run->count; i++)
        if (lsf_measurement_last(run->m, run->candidates[i].configuration))
            run->candidates[kept++] = run->candidates[i];
    run->count = kept;
}

/* The most samples whose frame fits into the time, from the measured times; 0: not even one. */
static uint32_t samples_within(const search_run *run, uint32_t configuration, double milliseconds)
{
    uint32_t low = 0, high = run->search->most_samples;
    while (low < high) {
        uint32_t middle = low + (high - low + 1) / 2;
        if (lsf_front_milliseconds(run->m, configuration, middle) <= milliseconds)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

static uint32_t power_of_two_within(uint32_t samples)
{
    uint32_t power = 1;
    while (power <= samples / 2)
        power *= 2;
    return power;
}

/* --- within a time --- */

/* Bounds of the error at so many samples, from that of the most samples measured: the variance
 * falls at least as their power 0.7; the apparent bias stays, or belongs to a filter and falls
 * with the variance, as 1 / N then. */
static void foretell(const search_run *run, uint32_t configuration, uint32_t samples, double *least,
                     double *most)
{
    const lsf_measured_point *last = lsf_measurement_last(run->m, configuration);
    double error = last->relmse.error.value;
    double variance = fmin(fmax(last->relmse.variance, 0.0), error);
    double more = fmax((double)samples / last->samples, 1.0);
    *least = error / more;
    *most = error - variance + variance * pow(more, -0.7);
}

static int by_foretold(const void *a, const void *b)
{
    const candidate *x = a, *y = b;
    double left = x->least * x->most, right = y->least * y->most;
    return (left > right) - (left < right);
}

/* Variance of the logarithm of one seed's error, pooled over all candidates, because few seeds
 * do not give that of one alone. */
static double pooled_variance(const search_run *run)
{
    double sum = 0.0;
    uint32_t degrees = 0;
    for (uint32_t i = 0; i < run->count; i++) {
        const lsf_measured_point *p =
            lsf_measurement_last(run->m, run->candidates[i].configuration);
        for (uint32_t s = 0; s < p->seed_count; s++)
            sum += pow(p->relmse.products[s][s] / p->relmse.error.value - 1.0, 2.0);
        degrees += p->seed_count - 1;
    }
    return degrees > 0 && isfinite(sum) ? sum / degrees : 0.0;
}

/* Factor by which two errors with so many seeds may differ by chance. */
static double chance_factor(double variance_of_seed, uint32_t seeds)
{
    return exp(CHANCE * sqrt(2.0 * variance_of_seed / seeds));
}

/* Drops candidates whose first sample takes too long, those that are predicted to be worse than
 * another one in any case, and the worst of too many. */
static void thin_out(search_run *run)
{
    uint32_t kept = 0, allowed = FEWEST + 2 * run->count / 3;
    double bound = INFINITY;
    run->seed_variance = pooled_variance(run);
    for (uint32_t i = 0; i < run->count; i++) {
        candidate c = run->candidates[i];
        uint32_t samples = samples_within(run, c.configuration, run->search->budget_ms);
        if (samples == 0)
            continue;
        foretell(run, c.configuration, samples, &c.least, &c.most);
        bound = fmin(bound, c.most * chance_factor(run->seed_variance, run->search->seeds));
        run->candidates[kept++] = c;
    }
    qsort(run->candidates, kept, sizeof *run->candidates, by_foretold);
    run->count = 0;
    for (uint32_t i = 0; i < kept && run->count < allowed; i++)
        if (run->candidates[i].least <= bound)
            run->candidates[run->count++] = run->candidates[i];
}

/* Announces the number of frames of a rung. */
static void expect_rung(const search_run *run, double milliseconds, uint32_t seeds)
{
    uint32_t iterations = 0;
    for (uint32_t i = 0; i < run->count; i++)
        iterations += seeds * samples_within(run, run->candidates[i].configuration, milliseconds);
    if (run->search->expect)
        run->search->expect(run->search->user, iterations);
}

static bool measure_rung(search_run *run, double milliseconds, lsf_error *error)
{
    bool good = true;
    expect_rung(run, milliseconds, run->search->seeds);
    for (uint32_t i = 0; good && !run->stopped && i < run->count; i++) {
        uint32_t c = run->candidates[i].configuration;
        uint32_t samples = samples_within(run, c, milliseconds);
        if (samples_within(run, c, run->search->budget_ms) > 0)
            good = measure(run, c, samples ? samples : 1, run->search->seeds, error);
    }
    return good;
}

/* Measures with as many samples as fit. Each attempt knows better how long a sample takes. */
static bool measure_finalist(search_run *run, uint32_t configuration, lsf_error *error)
{
    const lsf_search *search = run->search;
    bool good = true, settled = false;
    uint32_t samples = 0;
    for (int attempt = 0; good && !settled && !run->stopped && attempt < 3; attempt++) {
        uint32_t before = samples;
        samples = samples_within(run, configuration, search->budget_ms);
        settled = samples == 0 || (samples <= before + before / 16 && samples >= before);
        if (!settled)
            good = measure(run, configuration, samples, search->seeds, error);
    }
    uint32_t power = power_of_two_within(samples);
    if (good && !run->stopped && samples > 0 && power < samples)
        good = measure(run, configuration, power, search->seeds, error);
    return good;
}

/* The point of the least error among all that fit and have enough seeds. */
static const lsf_measured_point *best_within(const search_run *run)
{
    const lsf_measured_point *best = NULL;
    for (uint32_t i = 0; i < run->m->point_count; i++) {
        const lsf_measured_point *point = &run->m->points[i];
        if (point->milliseconds.median > run->search->budget_ms ||
            (best && best->seed_count > point->seed_count))
            continue;
        if (!best || point->seed_count > best->seed_count ||
            point->relmse.error.value < best->relmse.error.value)
            best = point;
    }
    return best;
}

/* Measures the candidates among which the seeds have not decided with twice as many; false when
 * there is nothing to decide, or on failure. */
static bool measure_contenders(search_run *run, lsf_error *error, bool *good)
{
    const lsf_measured_point *best = best_within(run);
    uint32_t list[2 * MOST_CONTENDERS], count = 0;
    if (!best || 2 * best->seed_count > LSF_SWEEP_MAX_SEEDS)
        return false;
    uint32_t seeds = best->seed_count;
    double most = best->relmse.error.value * chance_factor(run->seed_variance, seeds);
    for (uint32_t i = 0; i < run->m->point_count && count < MOST_CONTENDERS; i++) {
        const lsf_measured_point *point = &run->m->points[i];
        if (point->seed_count < seeds || point->relmse.error.value > most ||
            point->milliseconds.median > run->search->budget_ms)
            continue;
        list[2 * count] = point->configuration;
        list[2 * count++ + 1] = point->samples;
    }
    for (uint32_t i = 0; *good && count > 1 && !run->stopped && i < count; i++)
        *good = measure(run, list[2 * i], list[2 * i + 1], 2 * seeds, error);
    return *good && count > 1 && !run->stopped;
}

/* Standard deviation of the mean error due to the seeds alone: errors of the reference are
 * common to all. */
static double deviation_of(const lsf_measured_point *point)
{
    double squares = 0.0, mean = point->relmse.error.value;
    uint32_t n = point->seed_count;
    for (uint32_t s = 0; s < n; s++)
        squares += pow(point->relmse.products[s][s] - mean, 2.0);
    return n > 1 ? sqrt(squares / (n - 1) / n) : INFINITY;
}

/* Probability that no configuration has another point that fits and is better by 10 %, by
 * Student's distribution of the difference; the probabilities of error add up. Points of few
 * seeds belong to candidates that were dropped, and do not count. */
static double confidence_in(const search_run *run, const lsf_measured_point *best)
{
    double wrong = 0.0;
    for (uint32_t c = 0; c < run->m->configuration_count; c++) {
        double worst = 0.0;
        for (uint32_t i = 0; i < run->m->point_count; i++) {
            const lsf_measured_point *other = &run->m->points[i];
            if (other == best || other->configuration != c ||
                other->seed_count < best->seed_count ||
                other->milliseconds.median > run->search->budget_ms)
                continue;
            double difference = 1.1 * other->relmse.error.value - best->relmse.error.value;
            double deviation = hypot(1.1 * deviation_of(other), deviation_of(best));
            double right = deviation > 0.0 ? lsf_student_probability(difference / deviation,
                                                                     2 * (best->seed_count - 1))
                                           : difference >= 0.0;
            worst = fmax(worst, 1.0 - right);
        }
        wrong += worst;
    }
    return fmax(1.0 - wrong, 0.0);
}

static bool is_sure(const search_run *run)
{
    const lsf_measured_point *best = best_within(run);
    return !best || confidence_in(run, best) >= SURE;
}

static const lsf_measured_point *quickest(const lsf_measurement *m)
{
    const lsf_measured_point *best = NULL;
    for (uint32_t i = 0; i < m->point_count; i++)
        if (!best || m->points[i].milliseconds.median < best->milliseconds.median)
            best = &m->points[i];
    return best;
}

static void answer_with(search_run *run, const lsf_measured_point *point, bool met,
                        double confidence)
{
    lsf_answer *answer = &run->m->answer;
    answer->given = point != NULL;
    answer->budget_ms = run->search->budget_ms;
    answer->relmse = run->search->relmse;
    answer->candidates = run->m->configuration_count;
    answer->finalists = run->count;
    if (!point)
        return;
    answer->met = met;
    answer->configuration = point->configuration;
    answer->samples = point->samples;
    answer->error = point->relmse.error;
    answer->milliseconds = point->milliseconds.median;
    answer->confidence = confidence;
}

/* One sample of each, and a few more where they fit: they give a frame's fixed cost, and the
 * rate at which the error falls. */
static bool look(search_run *run, lsf_error *error)
{
    bool good = true;
    for (uint32_t i = 0; good && !run->stopped && i < run->count; i++) {
        uint32_t c = run->candidates[i].configuration;
        good = measure(run, c, 1, ROUGH_SEEDS, error);
        uint32_t few = samples_within(run, c, run->search->budget_ms);
        if (good && !run->stopped && few > 0)
            good = measure(run, c, 1, run->search->seeds, error);
        if (good && !run->stopped && few > 1)
            good =
                measure(run, c, few < FEW_SAMPLES ? few : FEW_SAMPLES, run->search->seeds, error);
    }
    drop_failures(run);
    return good;
}

static bool search_within(search_run *run, lsf_error *error)
{
    const lsf_search *search = run->search;
    bool good = look(run, error);
    for (double part = FIRST_PART; good && !run->stopped && part < 1.0; part *= GROWTH) {
        good = measure_rung(run, part * search->budget_ms, error);
        if (good && !run->stopped)
            thin_out(run);
    }
    expect_rung(run, search->budget_ms, search->seeds);
    for (uint32_t i = 0; good && !run->stopped && i < run->count; i++)
        good = measure_finalist(run, run->candidates[i].configuration, error);
    for (int i = 0; good && !run->stopped && i < DECISIONS && !is_sure(run); i++)
        if (!measure_contenders(run, error, &good))
            break;
    if (!good)
        return false;
    const lsf_measured_point *best = best_within(run);
    if (best)
        answer_with(run, best, true, run->stopped ? NAN : confidence_in(run, best));
    else
        answer_with(run, quickest(run->m), false, NAN);
    return true;
}

/* --- to an error --- */

/* Samples of its next frame, or 0: it has reached the error, or cannot reach it. */
static uint32_t next_samples(const search_run *run, uint32_t configuration, double best_ms)
{
    const lsf_measured_point *last = lsf_measurement_last(run->m, configuration);
    if (!last)
        return 0; /* it fails */
    double samples = GROWTH * last->samples;
    bool there = last->relmse.error.value <= run->search->relmse;
    double least, most;
    foretell(run, configuration, run->search->most_samples, &least, &most);
    if (there || least > HOPELESS * run->search->relmse || samples > run->search->most_samples ||
        lsf_front_milliseconds(run->m, configuration, samples) > best_ms)
        return 0;
    return (uint32_t)samples;
}

/* The candidate whose next frame is the shortest; UINT32_MAX: none has one. */
static uint32_t pick_next(const search_run *run, double best_ms, uint32_t *samples)
{
    uint32_t picked = UINT32_MAX;
    double least = INFINITY;
    for (uint32_t i = 0; i < run->count; i++) {
        uint32_t c = run->candidates[i].configuration;
        uint32_t next = next_samples(run, c, best_ms);
        double milliseconds = next ? lsf_front_milliseconds(run->m, c, next) : INFINITY;
        if (milliseconds < least) {
            picked = c;
            *samples = next;
            least = milliseconds;
        }
    }
    return picked;
}

/* The fastest point that reaches the error and has enough seeds. */
static const lsf_measured_point *soonest(const search_run *run)
{
    const lsf_measured_point *best = NULL;
    for (uint32_t i = 0; i < run->m->point_count; i++) {
        const lsf_measured_point *point = &run->m->points[i];
        if (point->relmse.error.value <= run->search->relmse &&
            point->seed_count >= run->search->seeds &&
            (!best || point->milliseconds.median < best->milliseconds.median))
            best = point;
    }
    return best;
}

static double best_time(const search_run *run)
{
    const lsf_measured_point *best = soonest(run);
    return best ? best->milliseconds.median : INFINITY;
}

/* For a configuration that has reached the error: the fewest samples that do, with all the
 * seeds. */
static bool settle(search_run *run, uint32_t configuration, lsf_error *error)
{
    bool good = true;
    for (int attempt = 0; good && !run->stopped && attempt < 4; attempt++) {
        lsf_time_to_error time = lsf_front_time_to(run->m, configuration, run->search->relmse);
        if (isnan(time.samples) || time.samples > run->search->most_samples)
            break;
        uint32_t samples = (uint32_t)fmax(ceil(time.samples - 1e-6), 1.0);
        const lsf_measured_point *point = lsf_measurement_find(run->m, configuration, samples);
        if (point && point->seed_count >= run->search->seeds)
            break;
        good = measure(run, configuration, samples, run->search->seeds, error);
    }
    return good;
}

static const lsf_measured_point *least_error(const lsf_measurement *m)
{
    const lsf_measured_point *best = NULL;
    for (uint32_t i = 0; i < m->point_count; i++)
        if (!best || m->points[i].relmse.error.value < best->relmse.error.value)
            best = &m->points[i];
    return best;
}

static bool search_error(search_run *run, lsf_error *error)
{
    const lsf_search *search = run->search;
    bool good = true;
    for (uint32_t i = 0; good && !run->stopped && i < run->count; i++)
        good = measure(run, run->candidates[i].configuration, 1, ROUGH_SEEDS, error);
    drop_failures(run);
    for (uint32_t i = 0; good && !run->stopped && i < run->count; i++) {
        uint32_t c = run->candidates[i].configuration;
        if (lsf_measurement_last(run->m, c)->relmse.error.value <= search->relmse)
            good = settle(run, c, error);
    }
    while (good && !run->stopped) {
        uint32_t samples, c = pick_next(run, best_time(run), &samples);
        if (c == UINT32_MAX)
            break;
        good = measure(run, c, samples, ROUGH_SEEDS, error);
        if (good && !run->stopped &&
            lsf_measurement_last(run->m, c)->relmse.error.value <= search->relmse)
            good = settle(run, c, error);
    }
    if (!good)
        return false;
    const lsf_measured_point *best = soonest(run);
    if (!best) {
        answer_with(run, least_error(run->m), false, NAN);
        return true;
    }
    double deviation = deviation_of(best), left = search->relmse - best->relmse.error.value;
    answer_with(run, best, true,
                deviation > 0.0 ? lsf_student_probability(left / deviation, best->seed_count - 1)
                                : 1.0);
    return true;
}

bool lsf_search_run(const lsf_search *search, lsf_error *error)
{
    search_run run = {.search = search, .m = search->measurement};
    bool good = list_candidates(&run, error) &&
                (isnan(search->relmse) ? search_within(&run, error) : search_error(&run, error));
    free(run.candidates);
    return good;
}
