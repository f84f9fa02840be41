#include "sweep/front.h"

#include <math.h>
#include <stdlib.h>

#include "base/base.h"
#include "sweep/fit.h"

/* Points with equal time and error do not dominate each other. */
static bool beats(const lsf_measured_point *a, const lsf_measured_point *b)
{
    double ta = a->milliseconds.median, tb = b->milliseconds.median;
    double ea = a->relmse.error.value, eb = b->relmse.error.value;
    return ta <= tb && ea <= eb && (ta < tb || ea < eb);
}

void lsf_front_mark(lsf_measured_point *points, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        points[i].front = isfinite(points[i].relmse.error.value);
        for (uint32_t j = 0; j < count; j++)
            if (beats(&points[j], &points[i]))
                points[i].front = false;
    }
}

void lsf_front_gain(lsf_measured_point *points, uint32_t count)
{
    const lsf_measured_point *worst = NULL;
    for (uint32_t i = 0; i < count; i++)
        if (!worst || points[i].ssim.value < worst->ssim.value)
            worst = &points[i];
    for (uint32_t i = 0; i < count; i++) {
        double more = points[i].milliseconds.median - worst->milliseconds.median;
        double better = points[i].ssim.value - worst->ssim.value;
        points[i].ssim_gain = more > 0.0 ? 100.0 * better / more : NAN;
    }
}

/* --- a configuration's curve --- */

static int by_samples(const void *a, const void *b)
{
    const lsf_measured_point *left = *(const lsf_measured_point *const *)a;
    const lsf_measured_point *right = *(const lsf_measured_point *const *)b;
    return (left->samples > right->samples) - (left->samples < right->samples);
}

enum { MOST_TARGETS = 24 };
enum { MOST_POINTS = 32 }; /* of a configuration: sample counts are powers of two, or nearly so */

/* The configuration's points by rising samples. */
static uint32_t curve_of(const lsf_measurement *m, uint32_t configuration,
                         const lsf_measured_point *curve[MOST_POINTS])
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < m->point_count && count < MOST_POINTS; i++)
        if (m->points[i].configuration == configuration)
            curve[count++] = &m->points[i];
    qsort(curve, count, sizeof *curve, by_samples);
    return count;
}

/* Least time of a sample beyond the last point, relative to the mean time of one. */
#define LEAST_SLOPE 0.25

double lsf_front_milliseconds(const lsf_measurement *m, uint32_t configuration, double samples)
{
    const lsf_measured_point *curve[MOST_POINTS];
    uint32_t count = curve_of(m, configuration, curve), i = 1;
    if (count == 0)
        return NAN;
    if (count == 1)
        return curve[0]->milliseconds.median * samples / curve[0]->samples;
    while (i + 1 < count && curve[i]->samples < samples)
        i++;
    double n0 = curve[i - 1]->samples, n1 = curve[i]->samples;
    double t0 = curve[i - 1]->milliseconds.median, t1 = curve[i]->milliseconds.median;
    double slope = (t1 - t0) / (n1 - n0);
    if (samples > n1) /* noise in the times must not make samples free */
        return t1 + (samples - n1) * fmax(slope, LEAST_SLOPE * t1 / n1);
    return t0 + (samples - n0) * slope;
}

/* Number of samples between two points at which the line in logarithms reaches the error. */
static double samples_between(const lsf_measured_point *a, const lsf_measured_point *b,
                              double relmse)
{
    double ea = log(a->relmse.error.value), eb = log(b->relmse.error.value);
    double part = (log(relmse) - ea) / (eb - ea);
    return exp(log(a->samples) + part * (log(b->samples) - log(a->samples)));
}

/* Number of samples beyond the measured ones; NAN: never reached. */
static double samples_by_fit(const lsf_error_fit *fit, double relmse)
{
    double left = relmse - fit->floor.value;
    if (!(left > 0.0) || !(fit->noise.value > 0.0) || !(fit->exponent.value > 0.0))
        return NAN;
    return pow(fit->noise.value / left, 1.0 / fit->exponent.value);
}

lsf_time_to_error lsf_front_time_to(const lsf_measurement *m, uint32_t configuration, double relmse)
{
    const lsf_measured_point *curve[MOST_POINTS];
    uint32_t count = curve_of(m, configuration, curve);
    lsf_time_to_error time = {configuration, relmse, NAN, NAN, false};
    uint32_t first = 0; /* the first good enough point */
    while (first < count && !(curve[first]->relmse.error.value <= relmse))
        first++;
    if (count == 0)
        return time;
    if (first == count) {
        double samples = samples_by_fit(&m->configurations[configuration].relmse, relmse);
        time.extrapolated = true;
        if (samples > curve[count - 1]->samples) /* otherwise the fit contradicts the measurement */
            time.samples = samples;
    } else if (first == 0 || !(curve[first]->relmse.error.value > 0.0)) {
        time.samples = curve[first]->samples;
    } else {
        time.samples = samples_between(curve[first - 1], curve[first], relmse);
    }
    if (!isnan(time.samples))
        time.milliseconds = lsf_front_milliseconds(m, configuration, time.samples);
    return time;
}

bool lsf_front_times(lsf_measurement *m)
{
    double least = INFINITY, most = 0.0;
    for (uint32_t i = 0; i < m->point_count; i++) {
        double error = m->points[i].relmse.error.value;
        if (!(error > 0.0) || !isfinite(error))
            continue;
        least = fmin(least, error);
        most = fmax(most, error);
    }
    free(m->times);
    m->times = NULL;
    m->time_count = 0;
    if (!(most > 0.0))
        return true;
    int first = (int)floor(2.0 * log10(most)), last = (int)floor(2.0 * log10(least));
    last = last < first - MOST_TARGETS + 1 ? first - MOST_TARGETS + 1 : last;
    uint32_t targets = (uint32_t)(first - last + 1);
    m->times = lsf_alloc((uint64_t)targets * m->configuration_count, sizeof *m->times);
    if (!m->times)
        return false;
    for (uint32_t c = 0; c < m->configuration_count; c++)
        for (int half = first; half >= last; half--)
            m->times[m->time_count++] = lsf_front_time_to(m, c, pow(10.0, 0.5 * half));
    return true;
}
