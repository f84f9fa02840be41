/* Piecewise-constant distributions, drawn from by inversion. */
#ifndef LSF_MATH_DISTRIBUTION_H
#define LSF_MATH_DISTRIBUTION_H

#include <stdbool.h>
#include <stdint.h>

/* `count` outcomes with probabilities proportional to their weights. */
typedef struct lsf_distribution {
    uint64_t count;
    double *cumulative; /* count + 1 entries from 0 to 1 */
    double sum;         /* of the weights */
} lsf_distribution;

/* Weights must be finite and not negative. False without memory. When all weights are zero, `sum`
 * is 0 and nothing may be drawn. */
bool lsf_distribution_init(lsf_distribution *distribution, const float *weights, uint64_t count);
/* Replaces the weights by as many others. Allocates nothing. */
void lsf_distribution_set(lsf_distribution *distribution, const float *weights);
void lsf_distribution_finish(lsf_distribution *distribution);

static inline double lsf_distribution_probability(const lsf_distribution *d, uint64_t index)
{
    return d->cumulative[index + 1] - d->cumulative[index];
}

/* The outcome that holds `u` in [0, 1), never one of weight 0. `rest` (NULL allowed) receives
 * where in it u lies, uniform in [0, 1) again. */
uint64_t lsf_distribution_sample(const lsf_distribution *distribution, double u, double *rest);

/* A density on the unit square, constant on each cell of a width x height grid; x runs along a
 * row, y over the rows. */
typedef struct lsf_distribution_2d {
    uint32_t width, height;
    lsf_distribution rows; /* which row */
    double *cumulative;    /* height rows of width + 1 entries from 0 to 1 */
} lsf_distribution_2d;

bool lsf_distribution_2d_init(lsf_distribution_2d *distribution, const float *weights,
                              uint32_t width, uint32_t height);
void lsf_distribution_2d_finish(lsf_distribution_2d *distribution);

/* Draws (x, y) in [0, 1)^2; returns the density there. */
double lsf_distribution_2d_sample(const lsf_distribution_2d *distribution, double u, double v,
                                  double *x, double *y);
/* The density at (x, y) in [0, 1]^2; integrates to 1. */
double lsf_distribution_2d_pdf(const lsf_distribution_2d *distribution, double x, double y);

#endif
