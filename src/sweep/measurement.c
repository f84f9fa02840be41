#include "sweep/measurement.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "sweep/fit.h"
#include "sweep/front.h"
#include "sweep/statistics.h"

const char *lsf_clock_name(lsf_clock clock)
{
    static const char *const names[] = {"wall", "gpu", "processor"};
    return names[clock];
}

static void finish_configuration(lsf_configuration *configuration)
{
    free(configuration->technique);
    free(configuration->failure);
    free(configuration->command);
    for (uint32_t i = 0; i < configuration->option_count; i++)
        free(configuration->options[i]);
}

void lsf_measurement_finish(lsf_measurement *m)
{
    for (uint32_t i = 0; i < m->configuration_count; i++)
        finish_configuration(&m->configurations[i]);
    for (uint32_t i = 0; i < m->point_count; i++) {
        free(m->points[i].picture);
        free(m->points[i].preview);
    }
    free(m->scene);
    free(m->command);
    free(m->reference.picture);
    free(m->reference.preview);
    free(m->reference.halves[0]);
    free(m->reference.halves[1]);
    free(m->configurations);
    free(m->points);
    free(m->times);
    free(m->answer.command);
    *m = (lsf_measurement){0};
}

lsf_measured_point *lsf_measurement_find(const lsf_measurement *m, uint32_t configuration,
                                         uint32_t samples)
{
    for (uint32_t i = 0; i < m->point_count; i++)
        if (m->points[i].configuration == configuration && m->points[i].samples == samples)
            return &m->points[i];
    return NULL;
}

static const lsf_measured_point *most_samples_below(const lsf_measurement *m,
                                                    uint32_t configuration, uint64_t limit)
{
    const lsf_measured_point *most = NULL;
    for (uint32_t i = 0; i < m->point_count; i++) {
        const lsf_measured_point *point = &m->points[i];
        if (point->configuration == configuration && point->samples < limit &&
            (!most || point->samples > most->samples))
            most = point;
    }
    return most;
}

const lsf_measured_point *lsf_measurement_last(const lsf_measurement *m, uint32_t configuration)
{
    return most_samples_below(m, configuration, UINT64_MAX);
}

const lsf_measured_point *lsf_measurement_before(const lsf_measurement *m,
                                                 const lsf_measured_point *point)
{
    return most_samples_below(m, point->configuration, point->samples);
}

void lsf_measurement_drop_point(lsf_measurement *m, lsf_measured_point *point)
{
    free(point->picture);
    free(point->preview);
    size_t behind = (size_t)(&m->points[m->point_count] - (point + 1));
    memmove(point, point + 1, behind * sizeof *point);
    m->point_count--;
}

lsf_measured_point *lsf_measurement_add_point(lsf_measurement *m)
{
    void *points = m->points;
    if (!lsf_grow(&points, &m->point_capacity, (uint64_t)m->point_count + 1, sizeof *m->points))
        return NULL;
    m->points = points;
    lsf_measured_point *point = &m->points[m->point_count++];
    *point = (lsf_measured_point){0};
    return point;
}

static bool same_options(const lsf_configuration *configuration, const char *const *options,
                         uint32_t option_count)
{
    if (configuration->option_count != option_count)
        return false;
    for (uint32_t i = 0; i < option_count; i++)
        if (strcmp(configuration->options[i], options[i]) != 0)
            return false;
    return true;
}

int64_t lsf_measurement_add_configuration(lsf_measurement *m, const char *technique,
                                          const char *const *options, uint32_t option_count)
{
    for (uint32_t i = 0; i < m->configuration_count; i++)
        if (strcmp(m->configurations[i].technique, technique) == 0 &&
            same_options(&m->configurations[i], options, option_count))
            return i;
    void *configurations = m->configurations;
    if (!lsf_grow(&configurations, &m->configuration_capacity, (uint64_t)m->configuration_count + 1,
                  sizeof *m->configurations))
        return -1;
    m->configurations = configurations;
    lsf_configuration made = {.technique = strdup(technique)};
    bool good = made.technique != NULL;
    for (uint32_t i = 0; i < option_count && i < LSF_SWEEP_MAX_OPTIONS; i++) {
        made.options[made.option_count] = strdup(options[i]);
        good = good && made.options[made.option_count++];
    }
    if (!good) {
        finish_configuration(&made);
        return -1;
    }
    m->configurations[m->configuration_count] = made;
    return m->configuration_count++;
}

/* --- derived values --- */

static lsf_estimate root_of(lsf_estimate squared)
{
    return (lsf_estimate){sqrt(fmax(squared.value, 0.0)), sqrt(fmax(squared.low, 0.0)),
                          sqrt(fmax(squared.high, 0.0))};
}

static lsf_estimate mean_over_seeds(const lsf_measured_point *point, size_t offset)
{
    double values[LSF_SWEEP_MAX_SEEDS];
    for (uint32_t s = 0; s < point->seed_count; s++)
        memcpy(&values[s], (const char *)&point->seeds[s] + offset, sizeof values[s]);
    return lsf_mean_of(values, point->seed_count, 0.0);
}

void lsf_measured_point_derive(lsf_measured_point *point)
{
    double milliseconds[LSF_SWEEP_MAX_SEEDS];
    for (uint32_t s = 0; s < point->seed_count; s++)
        milliseconds[s] = point->seeds[s].milliseconds;
    point->milliseconds = lsf_quartiles_of(milliseconds, point->seed_count);
    lsf_squared_error_derive(&point->mse, point->seed_count);
    lsf_squared_error_derive(&point->relmse, point->seed_count);
    point->rmse = root_of(point->mse.error);
    for (size_t c = 0; c < 3; c++)
        point->bias[c] =
            mean_over_seeds(point, offsetof(lsf_measured_seed, bias) + c * sizeof(double));
    point->ssim = mean_over_seeds(point, offsetof(lsf_measured_seed, ssim));
    point->psnr = mean_over_seeds(point, offsetof(lsf_measured_seed, psnr));
    point->flip = mean_over_seeds(point, offsetof(lsf_measured_seed, flip));
    point->flip_hdr = mean_over_seeds(point, offsetof(lsf_measured_seed, flip_hdr));
}

/* Number of points of one configuration that have as many seeds as the first of them. */
static bool fit_configuration(lsf_measurement *m, uint32_t configuration)
{
    const lsf_squared_error **errors = lsf_alloc(2 * (uint64_t)m->point_count, sizeof *errors);
    uint32_t *samples = lsf_alloc(m->point_count, sizeof *samples), count = 0, seeds = 0;
    bool good = errors && samples;
    for (uint32_t i = 0; good && i < m->point_count; i++) {
        const lsf_measured_point *point = &m->points[i];
        seeds = point->configuration == configuration && !seeds ? point->seed_count : seeds;
        if (point->configuration != configuration || point->seed_count != seeds)
            continue;
        errors[count] = &point->mse;
        errors[m->point_count + count] = &point->relmse;
        samples[count++] = point->samples;
    }
    if (good) {
        lsf_configuration *c = &m->configurations[configuration];
        c->mse = lsf_error_fit_make(errors, samples, count, seeds);
        c->relmse = lsf_error_fit_make(errors + m->point_count, samples, count, seeds);
    }
    free((void *)errors);
    free(samples);
    return good;
}

bool lsf_measurement_derive(lsf_measurement *m)
{
    bool good = true;
    for (uint32_t i = 0; i < m->point_count; i++)
        lsf_measured_point_derive(&m->points[i]);
    for (uint32_t i = 0; good && i < m->configuration_count; i++)
        good = fit_configuration(m, i);
    lsf_front_mark(m->points, m->point_count);
    lsf_front_gain(m->points, m->point_count);
    return good && lsf_front_times(m);
}
