#include "sweep/fit.h"

#include <math.h>

#include "sweep/statistics.h"

enum { NO_SEED = -1 };

/* Means of the products on the diagonal and off it, over all seeds but one. */
static void mean_products(const lsf_squared_error *error, uint32_t seeds, int left_out, double *on,
                          double *off)
{
    double sums[2] = {0.0, 0.0};
    uint32_t counts[2] = {0, 0};
    for (uint32_t s = 0; s < seeds; s++)
        for (uint32_t t = 0; t < seeds; t++)
            if ((int)s != left_out && (int)t != left_out) {
                sums[s != t] += error->products[s][t];
                counts[s != t]++;
            }
    *on = counts[0] ? sums[0] / counts[0] : NAN;
    *off = counts[1] ? sums[1] / counts[1] : NAN;
}

void lsf_squared_error_derive(lsf_squared_error *error, uint32_t seeds)
{
    double on, off, left_out[LSF_SWEEP_MAX_SEEDS] = {0}, of_seeds[LSF_SWEEP_MAX_SEEDS] = {0};
    for (uint32_t s = 0; s < seeds; s++) {
        of_seeds[s] = error->products[s][s];
        mean_products(error, seeds, (int)s, &on, &left_out[s]);
    }
    mean_products(error, seeds, NO_SEED, &on, &off);
    error->error = lsf_mean_of(of_seeds, seeds, error->reference_deviation);
    error->squared_bias =
        lsf_jackknife(off, left_out, seeds > 2 ? seeds : 0, error->reference_deviation);
    error->variance = on - off;
}

typedef struct fit_data {
    const lsf_squared_error *const *errors;
    const uint32_t *samples;
    uint32_t points, seeds;
} fit_data;

typedef struct power_law {
    double floor, noise, exponent;
} power_law;

/* A straight line through the logarithm of the variance over that of the samples. Without noise,
 * as in equal pictures, or where it does not fall, noise and floor cannot be separated. */
static void fit_variance(const fit_data *data, int left_out, double *noise, double *exponent)
{
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (uint32_t k = 0; k < data->points; k++) {
        double on, off;
        mean_products(data->errors[k], data->seeds, left_out, &on, &off);
        if (!(on - off > 0.0))
            continue;
        double u = log(data->samples[k]), v = log(on - off);
        n += 1.0;
        x += u;
        y += v;
        xx += u * u;
        xy += u * v;
    }
    double spread = n * xx - x * x;
    *exponent = n >= 2.0 && spread > 0.0 ? -(n * xy - x * y) / spread : NAN;
    *noise = exp((y + *exponent * x) / n);
}

/* The squared bias is floor + b N^-p, with b fitted by least squares of the differences relative
 * to the error at N, to which the deviation is proportional. */
static power_law fit(const fit_data *data, int left_out)
{
    double variance, p;
    fit_variance(data, left_out, &variance, &p);
    double aa = 0.0, ab = 0.0, bb = 0.0, a = 0.0, b = 0.0;
    for (uint32_t k = 0; k < data->points; k++) {
        double on, off;
        mean_products(data->errors[k], data->seeds, left_out, &on, &off);
        double weight = 1.0 / on, decay = pow(data->samples[k], -p) * weight;
        aa += weight * weight;
        ab += weight * decay;
        bb += decay * decay;
        a += weight * weight * off;
        b += weight * decay * off;
    }
    double determinant = aa * bb - ab * ab;
    return (power_law){.floor = (a * bb - b * ab) / determinant,
                       .noise = variance + (b * aa - a * ab) / determinant,
                       .exponent = p};
}

lsf_error_fit lsf_error_fit_make(const lsf_squared_error *const *errors, const uint32_t *samples,
                                 uint32_t points, uint32_t seeds)
{
    const fit_data data = {errors, samples, points, seeds};
    const lsf_estimate unknown = {NAN, NAN, NAN};
    if (points < 3 || seeds < 2)
        return (lsf_error_fit){points, unknown, unknown, unknown};
    power_law all = fit(&data, NO_SEED);
    double floors[LSF_SWEEP_MAX_SEEDS], noises[LSF_SWEEP_MAX_SEEDS], powers[LSF_SWEEP_MAX_SEEDS];
    uint32_t jackknives = seeds > 2 ? seeds : 0; /* one seed gives no variance */
    for (uint32_t s = 0; s < jackknives; s++) {
        power_law law = fit(&data, (int)s);
        floors[s] = law.floor;
        noises[s] = law.noise;
        powers[s] = law.exponent;
    }
    double shared = errors[points - 1]->reference_deviation;
    return (lsf_error_fit){.points = points,
                           .floor = lsf_jackknife(all.floor, floors, jackknives, shared),
                           .noise = lsf_jackknife(all.noise, noises, jackknives, 0.0),
                           .exponent = lsf_jackknife(all.exponent, powers, jackknives, 0.0)};
}

double lsf_error_fit_at(const lsf_error_fit *fit, double samples)
{
    return fit->floor.value + fit->noise.value * pow(samples, -fit->exponent.value);
}
