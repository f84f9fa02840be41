#include "sweep/statistics.h"

#include <math.h>
#include <stdlib.h>

static int ascending(const void *a, const void *b)
{
    double left = *(const double *)a, right = *(const double *)b;
    return (left > right) - (left < right);
}

static double quantile(const double *sorted, size_t count, double q)
{
    double rank = q * (double)(count - 1);
    size_t below = (size_t)rank;
    if (below + 1 >= count)
        return sorted[count - 1];
    return sorted[below] + (rank - (double)below) * (sorted[below + 1] - sorted[below]);
}

lsf_quartiles lsf_quartiles_of(double *values, size_t count)
{
    if (count == 0)
        return (lsf_quartiles){NAN, NAN, NAN};
    qsort(values, count, sizeof *values, ascending);
    return (lsf_quartiles){quantile(values, count, 0.25), quantile(values, count, 0.5),
                           quantile(values, count, 0.75)};
}

/* Number of values to leave out at either end, for which the probability that all remaining
 * values are on the same side of the median is below 1/40: that of so few heads among that many
 * tosses of a coin. `count` where even one is too many. */
static size_t left_out_of_median(size_t count)
{
    double tosses = pow(0.5, (double)count), chance = tosses;
    size_t left_out = 0;
    if (chance > 0.025)
        return count;
    while (chance <= 0.025) {
        left_out++;
        tosses *= (double)(count - left_out + 1) / (double)left_out;
        chance += tosses;
    }
    return left_out - 1;
}

lsf_estimate lsf_median_of(double *values, size_t count)
{
    double median = lsf_quartiles_of(values, count).median;
    size_t ends = left_out_of_median(count);
    if (ends >= count)
        return (lsf_estimate){median, NAN, NAN};
    return (lsf_estimate){median, values[ends], values[count - 1 - ends]};
}

/* P(-t < T < t), for integer degrees of freedom by the finite sums of Abramowitz and Stegun
 * 1964, 26.7.3 and 26.7.4. */
static double central_probability(double t, uint32_t degrees)
{
    double angle = atan(t / sqrt(degrees)), cosine = cos(angle), squared = cosine * cosine;
    bool odd = degrees % 2 == 1;
    double term = odd ? cosine : 1.0, sum = 0.0;
    for (uint32_t i = odd ? 1 : 0; i + 2 <= degrees; i += 2) {
        sum += term;
        term *= squared * (i + 1) / (i + 2);
    }
    return odd ? 2.0 / M_PI * (angle + sin(angle) * sum) : sin(angle) * sum;
}

double lsf_student_probability(double t, uint32_t degrees)
{
    double central = central_probability(fabs(t), degrees);
    return t < 0.0 ? 0.5 * (1.0 - central) : 0.5 * (1.0 + central);
}

double lsf_student_quantile(uint32_t degrees)
{
    double low = 1.0, high = 16.0; /* 12.71 for one degree, 1.96 for many */
    if (degrees == 0)
        return NAN;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        if (lsf_student_probability(middle, degrees) < 0.975)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

/* The two deviations are independent; the shared one is taken as normal. */
static lsf_estimate with_interval(double value, double deviation, uint32_t degrees, double shared)
{
    if (degrees == 0)
        return (lsf_estimate){value, NAN, NAN};
    double width = hypot(lsf_student_quantile(degrees) * deviation, 1.959964 * shared);
    return (lsf_estimate){value, value - width, value + width};
}

lsf_estimate lsf_mean_of(const double *values, uint32_t count, double shared)
{
    double mean = 0.0, squares = 0.0;
    if (count == 0)
        return (lsf_estimate){NAN, NAN, NAN};
    for (uint32_t i = 0; i < count; i++)
        mean += values[i] / count;
    for (uint32_t i = 0; i < count; i++)
        squares += (values[i] - mean) * (values[i] - mean);
    double deviation = count > 1 ? sqrt(squares / (count - 1) / count) : 0.0;
    return with_interval(mean, deviation, count - 1, shared);
}

lsf_estimate lsf_jackknife(double value, const double *left_out, uint32_t count, double shared)
{
    double mean = 0.0, squares = 0.0;
    if (count < 2)
        return (lsf_estimate){value, NAN, NAN};
    for (uint32_t i = 0; i < count; i++)
        mean += left_out[i] / count;
    for (uint32_t i = 0; i < count; i++)
        squares += (left_out[i] - mean) * (left_out[i] - mean);
    return with_interval(value, sqrt(squares * (count - 1) / count), count - 1, shared);
}
