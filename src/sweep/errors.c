#include "sweep/errors.h"

#include <math.h>

/* The halves' squared difference is twice the variance of one; their mean has half of that
 * variance. */
void lsf_reference_halves_derive(lsf_reference_halves *reference)
{
    const float *a = reference->halves[0], *b = reference->halves[1];
    uint64_t pixels = (uint64_t)reference->width * reference->height, finite = 0;
    double squares = 0.0, mean[3] = {0.0, 0.0, 0.0};
    for (uint64_t i = 0; i < pixels; i++) {
        double sums[3], square = 0.0;
        for (uint64_t c = 0; c < 3; c++) {
            double x = a[3 * i + c], y = b[3 * i + c];
            sums[c] = 0.5 * (x + y);
            square += 0.25 * (x - y) * (x - y);
        }
        if (!isfinite(square))
            continue;
        finite++;
        squares += square;
        for (int c = 0; c < 3; c++)
            mean[c] += sums[c];
    }
    double all = 0.0;
    for (int c = 0; c < 3; c++) {
        reference->mean[c] = finite ? mean[c] / (double)finite : NAN;
        all += reference->mean[c] / 3.0;
    }
    reference->epsilon = 0.01 * all * all;
    reference->rmse = finite ? sqrt(squares / (3.0 * (double)finite)) : NAN;
}

/* One channel of one pixel: its errors against both halves, for all seeds. */
typedef struct value_errors {
    double against_a[LSF_SWEEP_MAX_SEEDS], against_b[LSF_SWEEP_MAX_SEEDS];
    double mean;       /* error of the seeds' mean against the halves' mean */
    double difference; /* between the halves */
} value_errors;

/* This value's share of the variance of the weighted mean error that is due to the reference's
 * noise: against halves r + e and r + f the squared error of r + d is d^2 - d (e + f) + e f. The
 * halves' difference e - f has twice the variance v of one, its fourth power has the mean 12 v^2
 * if it is normal, and e f has the variance v^2. */
static double reference_variance(const value_errors *v, double weight)
{
    double square = v->difference * v->difference;
    return weight * weight * (v->mean * v->mean * square + square * square / 12.0);
}

static bool take_value(const lsf_reference_halves *reference, const lsf_image *const *pictures,
                       uint32_t count, uint64_t pixel, uint64_t channel, value_errors *v)
{
    double a = reference->halves[0][3 * pixel + channel];
    double b = reference->halves[1][3 * pixel + channel];
    v->difference = a - b;
    v->mean = 0.0;
    for (uint32_t s = 0; s < count; s++) {
        double x = pictures[s]->pixels[pixel * pictures[s]->channel_count + channel];
        v->against_a[s] = x - a;
        v->against_b[s] = x - b;
        v->mean += (x - 0.5 * (a + b)) / count;
    }
    return isfinite(v->mean) && isfinite(v->difference);
}

static void add_products(const value_errors *v, uint32_t count, double weight,
                         double products[LSF_SWEEP_MAX_SEEDS][LSF_SWEEP_MAX_SEEDS])
{
    for (uint32_t s = 0; s < count; s++)
        for (uint32_t t = s; t < count; t++)
            products[s][t] +=
                0.5 * weight *
                (v->against_a[s] * v->against_b[t] + v->against_a[t] * v->against_b[s]);
}

static void finish_error(lsf_squared_error *error, uint32_t count, double values, double variance)
{
    for (uint32_t s = 0; s < count; s++)
        for (uint32_t t = s; t < count; t++) {
            error->products[s][t] /= values;
            error->products[t][s] = error->products[s][t];
        }
    error->reference_deviation = sqrt(variance) / values;
}

void lsf_errors_measure(const lsf_reference_halves *reference, const lsf_image *const *pictures,
                        uint32_t count, lsf_squared_error *mse, lsf_squared_error *relmse)
{
    uint64_t pixels = (uint64_t)reference->width * reference->height;
    double values = 0.0, variance = 0.0, relative_variance = 0.0;
    *mse = *relmse = (lsf_squared_error){0};
    for (uint64_t i = 0; i < pixels; i++) {
        value_errors v[3];
        bool finite = true;
        for (uint64_t c = 0; c < 3; c++)
            finite = take_value(reference, pictures, count, i, c, &v[c]) && finite;
        for (uint64_t c = 0; finite && c < 3; c++) {
            double r = 0.5 * ((double)reference->halves[0][3 * i + c] +
                              (double)reference->halves[1][3 * i + c]);
            double weight = 1.0 / (r * r + reference->epsilon);
            if (!isfinite(weight)) /* a black picture has no relMSE */
                weight = NAN;
            add_products(&v[c], count, 1.0, mse->products);
            add_products(&v[c], count, weight, relmse->products);
            variance += reference_variance(&v[c], 1.0);
            relative_variance += reference_variance(&v[c], weight);
            values += 1.0;
        }
    }
    finish_error(mse, count, values, variance);
    finish_error(relmse, count, values, relative_variance);
}
