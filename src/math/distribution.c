#include "math/distribution.h"

#include <stdlib.h>
#include <string.h>

#include "base/base.h"

/* Sums up `weights` and scales them to a sum of 1; returns the sum. If all are zero, the
 * cumulative stays zero. */
static double accumulate(double *cumulative, const float *weights, uint64_t count)
{
    cumulative[0] = 0.0;
    for (uint64_t i = 0; i < count; i++)
        cumulative[i + 1] = cumulative[i] + (double)weights[i];
    double sum = cumulative[count];
    if (sum > 0.0) {
        for (uint64_t i = 1; i <= count; i++)
            cumulative[i] /= sum;
    }
    return sum;
}

/* The largest i with cumulative[i] <= u: its interval has a width, for equal neighbours are
 * skipped, and the end (1) is never reached by u < 1. */
static uint64_t find_interval(const double *cumulative, uint64_t count, double u)
{
    uint64_t low = 0, high = count;
    while (high - low > 1) {
        uint64_t middle = low + (high - low) / 2;
        if (cumulative[middle] <= u)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static double fraction(const double *cumulative, uint64_t i, double u)
{
    double width = cumulative[i + 1] - cumulative[i];
    double f = width > 0.0 ? (u - cumulative[i]) / width : 0.0;
    return f < 0x1.fffffep-1 ? f : 0x1.fffffep-1; /* stays below 1 as a float too */
}

bool lsf_distribution_init(lsf_distribution *distribution, const float *weights, uint64_t count)
{
    memset(distribution, 0, sizeof *distribution);
    distribution->cumulative = lsf_alloc(count + 1, sizeof(double));
    if (distribution->cumulative == NULL)
        return false;
    distribution->count = count;
    lsf_distribution_set(distribution, weights);
    return true;
}

void lsf_distribution_set(lsf_distribution *distribution, const float *weights)
{
    distribution->sum = accumulate(distribution->cumulative, weights, distribution->count);
}

void lsf_distribution_finish(lsf_distribution *distribution)
{
    free(distribution->cumulative);
    memset(distribution, 0, sizeof *distribution);
}

uint64_t lsf_distribution_sample(const lsf_distribution *distribution, double u, double *rest)
{
    uint64_t i = find_interval(distribution->cumulative, distribution->count, u);
    if (rest != NULL)
        *rest = fraction(distribution->cumulative, i, u);
    return i;
}

bool lsf_distribution_2d_init(lsf_distribution_2d *distribution, const float *weights,
                              uint32_t width, uint32_t height)
{
    memset(distribution, 0, sizeof *distribution);
    distribution->width = width;
    distribution->height = height;
    float *row_sums = lsf_alloc(height, sizeof(float));
    distribution->cumulative = lsf_alloc((uint64_t)height * (width + 1u), sizeof(double));
    bool ok = row_sums != NULL && distribution->cumulative != NULL;
    for (uint32_t y = 0; ok && y < height; y++) {
        double sum = accumulate(distribution->cumulative + (uint64_t)y * (width + 1u),
                                weights + (uint64_t)y * width, width);
        /* the mean, which cannot leave the range of floats as the sum could */
        row_sums[y] = (float)(sum / width);
    }
    ok = ok && lsf_distribution_init(&distribution->rows, row_sums, height);
    free(row_sums);
    if (!ok)
        lsf_distribution_2d_finish(distribution);
    return ok;
}

void lsf_distribution_2d_finish(lsf_distribution_2d *distribution)
{
    lsf_distribution_finish(&distribution->rows);
    free(distribution->cumulative);
    memset(distribution, 0, sizeof *distribution);
}

static double density(const lsf_distribution_2d *d, uint64_t column, uint64_t row)
{
    const double *cumulative = d->cumulative + row * (d->width + 1u);
    return lsf_distribution_probability(&d->rows, row) * d->height *
           (cumulative[column + 1] - cumulative[column]) * d->width;
}

double lsf_distribution_2d_sample(const lsf_distribution_2d *distribution, double u, double v,
                                  double *x, double *y)
{
    double rest;
    uint64_t row = lsf_distribution_sample(&distribution->rows, v, &rest);
    const double *cumulative = distribution->cumulative + row * (distribution->width + 1u);
    uint64_t column = find_interval(cumulative, distribution->width, u);
    *x = ((double)column + fraction(cumulative, column, u)) / distribution->width;
    *y = ((double)row + rest) / distribution->height;
    return density(distribution, column, row);
}

static uint64_t cell(double x, uint32_t count)
{
    double i = x * count;
    return i <= 0.0 ? 0 : i >= count ? count - 1 : (uint64_t)i;
}

double lsf_distribution_2d_pdf(const lsf_distribution_2d *distribution, double x, double y)
{
    return density(distribution, cell(x, distribution->width), cell(y, distribution->height));
}
