#include "tools/measure_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Technique and options, as one would type them. */
static void add_name(lsf_string *text, const lsf_configuration *configuration)
{
    lsf_string_add(text, "%s", configuration->technique);
    for (uint32_t i = 0; i < configuration->option_count; i++)
        lsf_string_add(text, " %s", configuration->options[i]);
}

static bool is_shown(const lsf_measurement *m, const lsf_measured_point *point)
{
    return !m->answer.given || point->front ||
           (point->configuration == m->answer.configuration && point->samples == m->answer.samples);
}

static size_t widest_name(const lsf_measurement *m)
{
    size_t widest = sizeof "technique" - 1;
    for (uint32_t i = 0; i < m->point_count; i++) {
        lsf_string name = {0};
        if (is_shown(m, &m->points[i]))
            add_name(&name, &m->configurations[m->points[i].configuration]);
        widest = name.length > widest ? name.length : widest;
        free(name.text);
    }
    return widest;
}

static double largest_bias(const lsf_measured_point *point)
{
    double largest = 0.0;
    for (int c = 0; c < 3; c++)
        if (fabs(point->bias[c].value) > fabs(largest))
            largest = point->bias[c].value;
    return largest;
}

/* "0.0123 ±12%": half the interval's width, in per cent. */
static void add_error(lsf_string *text, lsf_estimate error)
{
    char width[16] = "";
    double half = 0.5 * (error.high - error.low) / error.value;
    if (isfinite(half) && half >= 0.0)
        snprintf(width, sizeof width, "±%.2g%%", fmin(100.0 * half, 999.0));
    lsf_string_add(text, " %9.3g %-8s", error.value, width);
}

static void add_point(lsf_string *text, const lsf_measurement *m, const lsf_measured_point *point,
                      size_t width)
{
    lsf_string name = {0};
    add_name(&name, &m->configurations[point->configuration]);
    lsf_string_add(text, "%c %-*s %7u %9.4g", point->front ? '*' : ' ', (int)width,
                   name.text ? name.text : "", point->samples, point->milliseconds.median);
    free(name.text);
    lsf_string_add(text, " %7.1f %9.3g", (double)point->gl_bytes_peak / 0x1p20, point->rmse.value);
    add_error(text, point->relmse.error);
    double noise = 100.0 * point->relmse.variance / point->relmse.error.value;
    lsf_string_add(text, " %5.0f%% %+7.2f%% %7.4f %7.4f", fmin(fmax(noise, 0.0), 100.0),
                   100.0 * largest_bias(point), point->ssim.value, point->flip.value);
    if (isfinite(point->ssim_gain))
        lsf_string_add(text, " %7.2g", point->ssim_gain);
    else if (point->path.frames > 0)
        lsf_string_add(text, " %7s", "");
    if (point->path.frames > 0)
        lsf_string_add(text, " %9.3g %9.3g %9.3g", point->path.relmse.value,
                       point->path.difference.value, point->path.flicker.value);
    lsf_string_add(text, "\n");
}

void lsf_measure_add_table(lsf_string *text, const lsf_measurement *m)
{
    size_t width = widest_name(m);
    lsf_string_add(text, "  %-*s %7s %9s %7s %9s %9s %-8s %6s %8s %7s %7s %7s", (int)width,
                   "technique", "samples", "ms", "MiB", "RMSE", "relMSE", "95 %", "noise", "bias",
                   "SSIM", "FLIP", "gain/ms");
    if (m->point_count > 0 && m->points[0].path.frames > 0)
        lsf_string_add(text, " %9s %9s %9s", "frames", "change", "flicker");
    lsf_string_add(text, "\n");
    for (uint32_t c = 0; c < m->configuration_count; c++)
        for (uint32_t i = 0; i < m->point_count; i++)
            if (m->points[i].configuration == c && is_shown(m, &m->points[i]))
                add_point(text, m, &m->points[i], width);
    lsf_string_add(
        text,
        "* on the Pareto front: no point is better in the same time or less. noise: its share of "
        "relMSE; the rest is bias.\n");
}
