/* Pearson's test: do counts follow their expectations? */
#ifndef LSF_TESTS_REFERENCE_CHI_SQUARE_H
#define LSF_TESTS_REFERENCE_CHI_SQUARE_H

#include <math.h>
#include <stddef.h>

/* How many standard deviations the statistic lies above what chance gives (Wilson and Hilferty's
 * normal approximation, 1931). Bins that expect fewer than `least` are pooled; a count where
 * nothing is expected at all gives infinity. */
static inline double chi_square_z(const double *counts, const double *expected, size_t bins,
                                  double least)
{
    double statistic = 0.0, pooled_count = 0.0, pooled_expected = 0.0;
    double freedom = -1.0;
    for (size_t i = 0; i < bins; i++) {
        if (expected[i] < least) {
            pooled_count += counts[i];
            pooled_expected += expected[i];
            continue;
        }
        double difference = counts[i] - expected[i];
        statistic += difference * difference / expected[i];
        freedom += 1.0;
    }
    if (pooled_expected >= least) {
        double difference = pooled_count - pooled_expected;
        statistic += difference * difference / pooled_expected;
        freedom += 1.0;
    } else if (pooled_count > 6.0 * sqrt(pooled_expected + 1.0) + pooled_expected) {
        return INFINITY;
    }
    if (freedom < 1.0)
        return 0.0;
    double v = 2.0 / (9.0 * freedom);
    return (cbrt(statistic / freedom) - (1.0 - v)) / sqrt(v);
}

/* Which of `bins` equal sectors from -pi to pi the direction lies in. */
static inline int angle_bin(float x, float y, int bins)
{
    int bin = (int)((atan2((double)y, (double)x) + M_PI) / (2.0 * M_PI) * bins);
    return bin < bins ? bin : bins - 1;
}

#endif
