#include "tools/measure_json.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include <lightsheaf/lightsheaf.h>

#include "tools/machine.h"
#include "tools/number.h"
#include "tools/summary.h"

static void add_fields(lsf_json *json, lsf_estimate estimate)
{
    lsf_json_number(json, "value", estimate.value);
    lsf_json_number(json, "low", estimate.low);
    lsf_json_number(json, "high", estimate.high);
}

static void add_estimate(lsf_json *json, const char *name, lsf_estimate estimate)
{
    lsf_json_begin(json, name, '{');
    add_fields(json, estimate);
    lsf_json_end(json, '}');
}

/* "vpl.count=4" as a member: a number where it is one. */
static void add_option(lsf_json *json, const char *option)
{
    const char *value = strchr(option, '=');
    char key[128];
    double number;
    size_t length = value ? (size_t)(value - option) : 0;
    if (!value || length >= sizeof key)
        return;
    memcpy(key, option, length);
    key[length] = '\0';
    if (lsf_parse_number(value + 1, -DBL_MAX, DBL_MAX, &number))
        lsf_json_number(json, key, number);
    else
        lsf_json_string(json, key, value + 1);
}

static void add_options(lsf_json *json, const lsf_configuration *configuration)
{
    lsf_json_begin(json, "options", '{');
    for (uint32_t i = 0; i < configuration->option_count; i++)
        add_option(json, configuration->options[i]);
    lsf_json_end(json, '}');
}

static void add_vector(lsf_json *json, const char *name, const double values[3])
{
    lsf_json_begin(json, name, '[');
    for (int c = 0; c < 3; c++)
        lsf_json_number(json, NULL, values[c]);
    lsf_json_end(json, ']');
}

/* --- its parts --- */

static void add_reference(lsf_json *json, const lsf_measured_reference *reference)
{
    lsf_json_begin(json, "reference", '{');
    lsf_json_string(json, "technique", "path tracing");
    lsf_json_begin(json, "samples", '[');
    lsf_json_integer(json, NULL, reference->samples[0]);
    lsf_json_integer(json, NULL, reference->samples[1]);
    lsf_json_end(json, ']');
    lsf_json_number(json, "seconds", reference->seconds);
    lsf_json_bool(json, "cached", reference->cached);
    lsf_json_string(json, "key", *reference->key ? reference->key : NULL);
    add_vector(json, "mean", reference->mean);
    lsf_json_number(json, "rmse", reference->rmse);
    lsf_json_string(json, "picture", reference->picture);
    lsf_json_string(json, "preview", reference->preview);
    lsf_json_begin(json, "halves", '[');
    for (int i = 0; i < 2 && reference->halves[i]; i++)
        lsf_json_string(json, NULL, reference->halves[i]);
    lsf_json_end(json, ']');
    lsf_json_end(json, '}');
}

static void add_fit(lsf_json *json, const char *name, const lsf_error_fit *fit)
{
    lsf_json_begin(json, name, '{');
    lsf_json_integer(json, "points", fit->points);
    add_estimate(json, "floor", fit->floor);
    add_estimate(json, "noise", fit->noise);
    add_estimate(json, "exponent", fit->exponent);
    lsf_json_end(json, '}');
}

static void add_configuration(lsf_json *json, const lsf_measurement *m, uint32_t index)
{
    const lsf_configuration *configuration = &m->configurations[index];
    lsf_json_begin(json, NULL, '{');
    lsf_json_string(json, "technique", configuration->technique);
    add_options(json, configuration);
    lsf_json_string(json, "command", configuration->command);
    lsf_json_string(json, "failure", configuration->failure);
    lsf_json_begin(json, "fit", '{');
    add_fit(json, "mse", &configuration->mse);
    add_fit(json, "relmse", &configuration->relmse);
    lsf_json_end(json, '}');
    lsf_json_begin(json, "time_to_relmse", '[');
    for (uint32_t i = 0; i < m->time_count; i++) {
        const lsf_time_to_error *time = &m->times[i];
        if (time->configuration != index)
            continue;
        lsf_json_begin(json, NULL, '{');
        lsf_json_number(json, "relmse", time->relmse);
        lsf_json_number(json, "samples", time->samples);
        lsf_json_number(json, "milliseconds", time->milliseconds);
        lsf_json_bool(json, "extrapolated", time->extrapolated);
        lsf_json_end(json, '}');
    }
    lsf_json_end(json, ']');
    lsf_json_end(json, '}');
}

static void add_squared_error(lsf_json *json, const char *name, const lsf_squared_error *error,
                              uint32_t seeds)
{
    lsf_json_begin(json, name, '{');
    add_fields(json, error->error);
    lsf_json_number(json, "variance", error->variance);
    add_estimate(json, "squared_bias", error->squared_bias);
    lsf_json_number(json, "reference_deviation", error->reference_deviation);
    lsf_json_begin(json, "products", '[');
    for (uint32_t s = 0; s < seeds; s++)
        for (uint32_t t = s; t < seeds; t++)
            lsf_json_number(json, NULL, error->products[s][t]);
    lsf_json_end(json, ']');
    lsf_json_end(json, '}');
}

static void add_quartiles(lsf_json *json, lsf_quartiles milliseconds)
{
    lsf_json_begin(json, "milliseconds", '{');
    lsf_json_number(json, "median", milliseconds.median);
    lsf_json_number(json, "lower_quartile", milliseconds.lower);
    lsf_json_number(json, "upper_quartile", milliseconds.upper);
    lsf_json_end(json, '}');
}

static void add_path(lsf_json *json, const lsf_measured_path *path)
{
    if (path->frames == 0) {
        lsf_json_string(json, "path", NULL);
        return;
    }
    lsf_json_begin(json, "path", '{');
    lsf_json_integer(json, "frames", path->frames);
    lsf_json_bool(json, "temporal", path->temporal);
    add_quartiles(json, path->milliseconds);
    add_estimate(json, "relmse", path->relmse);
    add_estimate(json, "difference", path->difference);
    add_estimate(json, "flicker", path->flicker);
    lsf_json_number(json, "motion", path->motion);
    lsf_json_end(json, '}');
}

static void add_seed(lsf_json *json, const lsf_measured_seed *seed)
{
    lsf_json_begin(json, NULL, '{');
    lsf_json_integer(json, "seed", seed->seed);
    lsf_json_number(json, "milliseconds", seed->milliseconds);
    add_vector(json, "bias", seed->bias);
    lsf_json_number(json, "ssim", seed->ssim);
    lsf_json_number(json, "psnr", seed->psnr);
    lsf_json_number(json, "flip", seed->flip);
    lsf_json_number(json, "flip_hdr", seed->flip_hdr);
    lsf_json_integer(json, "non_finite", seed->non_finite);
    lsf_json_end(json, '}');
}

static void add_point(lsf_json *json, const lsf_measurement *m, const lsf_measured_point *point)
{
    const lsf_configuration *configuration = &m->configurations[point->configuration];
    lsf_json_begin(json, NULL, '{');
    lsf_json_integer(json, "configuration", point->configuration);
    lsf_json_string(json, "technique", configuration->technique);
    add_options(json, configuration);
    lsf_json_integer(json, "samples", point->samples);
    add_quartiles(json, point->milliseconds);
    lsf_json_begin(json, "gl_bytes", '{');
    lsf_json_integer(json, "plan", point->gl_bytes);
    lsf_json_integer(json, "peak", point->gl_bytes_peak);
    lsf_json_end(json, '}');
    lsf_json_begin(json, "passes", '[');
    for (uint32_t i = 0; i < point->pass_count; i++) {
        lsf_json_begin(json, NULL, '{');
        lsf_json_string(json, "name", point->passes[i].name);
        lsf_json_integer(json, "runs", point->passes[i].runs);
        lsf_json_number(json, "milliseconds", point->passes[i].milliseconds);
        lsf_json_end(json, '}');
    }
    lsf_json_end(json, ']');
    add_estimate(json, "rmse", point->rmse);
    add_squared_error(json, "mse", &point->mse, point->seed_count);
    add_squared_error(json, "relmse", &point->relmse, point->seed_count);
    lsf_json_begin(json, "bias", '[');
    for (int c = 0; c < 3; c++)
        add_estimate(json, NULL, point->bias[c]);
    lsf_json_end(json, ']');
    add_estimate(json, "ssim", point->ssim);
    add_estimate(json, "psnr", point->psnr);
    add_estimate(json, "flip", point->flip);
    add_estimate(json, "flip_hdr", point->flip_hdr);
    add_path(json, &point->path);
    lsf_json_bool(json, "front", point->front);
    lsf_json_number(json, "ssim_gain", point->ssim_gain);
    lsf_json_string(json, "picture", point->picture);
    lsf_json_string(json, "preview", point->preview);
    lsf_json_begin(json, "seeds", '[');
    for (uint32_t s = 0; s < point->seed_count; s++)
        add_seed(json, &point->seeds[s]);
    lsf_json_end(json, ']');
    lsf_json_end(json, '}');
}

static void add_answer(lsf_json *json, const lsf_measurement *m)
{
    const lsf_answer *answer = &m->answer;
    if (!answer->given) {
        lsf_json_string(json, "answer", NULL);
        return;
    }
    lsf_json_begin(json, "answer", '{');
    lsf_json_number(json, "budget_ms", answer->budget_ms);
    lsf_json_number(json, "budget_relmse", answer->relmse);
    lsf_json_bool(json, "met", answer->met);
    lsf_json_integer(json, "configuration", answer->configuration);
    lsf_json_integer(json, "samples", answer->samples);
    add_estimate(json, "relmse", answer->error);
    lsf_json_number(json, "milliseconds", answer->milliseconds);
    lsf_json_number(json, "confidence", answer->confidence);
    lsf_json_integer(json, "candidates", answer->candidates);
    lsf_json_integer(json, "finalists", answer->finalists);
    lsf_json_string(json, "command", answer->command);
    lsf_json_end(json, '}');
}

/* --- all of it --- */

void lsf_measure_add_json(lsf_json *json, const lsf_measurement *m, const lsf_context_info *device,
                          const lsf_prices *prices)
{
    lsf_json_begin(json, NULL, '{');
    lsf_json_string(json, "lightsheaf", lsf_version());
    lsf_json_string(json, "command", "measure");
    lsf_json_string(json, "command_line", m->command);
    lsf_json_string(json, "scene", m->scene);
    lsf_json_string(json, "key", *m->key ? m->key : NULL);
    lsf_json_string(json, "scene_hash", *m->scene_hash ? m->scene_hash : NULL);
    lsf_json_vector(json, "resolution", (float[]){(float)m->width, (float)m->height}, 2);
    lsf_json_integer(json, "bounces", m->bounces);
    lsf_json_bool(json, "raw", m->raw);
    lsf_json_bool(json, "interrupted", m->interrupted);
    lsf_json_string(json, "clock", lsf_clock_name(m->clock));
    lsf_json_number(json, "relmse_epsilon", m->relmse_epsilon);
    lsf_json_number(json, "exposure", m->exposure);
    lsf_json_number(json, "seconds", m->seconds);
    lsf_summary_add_device(json, device);
    lsf_machine_add(json);
    add_reference(json, &m->reference);
    lsf_json_begin(json, "configurations", '[');
    for (uint32_t i = 0; i < m->configuration_count; i++)
        add_configuration(json, m, i);
    lsf_json_end(json, ']');
    lsf_json_begin(json, "points", '[');
    for (uint32_t i = 0; i < m->point_count; i++)
        add_point(json, m, &m->points[i]);
    lsf_json_end(json, ']');
    lsf_prices_add_json(json, "prices", prices);
    add_answer(json, m);
    lsf_json_end(json, '}');
}

static void add_csv_number(lsf_string *text, double value)
{
    lsf_string_add(text, ",");
    if (isfinite(value)) /* else the field is empty */
        lsf_string_add_json_number(text, value);
}

static void add_csv_estimate(lsf_string *text, lsf_estimate estimate)
{
    add_csv_number(text, estimate.value);
    add_csv_number(text, estimate.low);
    add_csv_number(text, estimate.high);
}

static const lsf_measured_path no_path = {
    .relmse = {.value = NAN}, .difference = {.value = NAN}, .flicker = {.value = NAN}};

void lsf_measure_add_csv(lsf_string *text, const lsf_measurement *m)
{
    lsf_string_add(text, "technique,options,samples,milliseconds,milliseconds_lower_quartile,"
                         "milliseconds_upper_quartile,gl_bytes_peak,rmse,rmse_low,rmse_high,relmse,"
                         "relmse_low,relmse_high,relmse_variance,relmse_squared_bias,bias_r,bias_g,"
                         "bias_b,ssim,ssim_low,ssim_high,flip,flip_hdr,front,ssim_gain,path_relmse,"
                         "path_difference,path_flicker\r\n");
    for (uint32_t i = 0; i < m->point_count; i++) {
        const lsf_measured_point *point = &m->points[i];
        const lsf_configuration *configuration = &m->configurations[point->configuration];
        lsf_string_add(text, "%s,", configuration->technique);
        for (uint32_t k = 0; k < configuration->option_count; k++)
            lsf_string_add(text, "%s%s", k ? " " : "", configuration->options[k]);
        lsf_string_add(text, ",%u", point->samples);
        add_csv_number(text, point->milliseconds.median);
        add_csv_number(text, point->milliseconds.lower);
        add_csv_number(text, point->milliseconds.upper);
        lsf_string_add(text, ",%" PRIu64, point->gl_bytes_peak);
        add_csv_estimate(text, point->rmse);
        add_csv_estimate(text, point->relmse.error);
        add_csv_number(text, point->relmse.variance);
        add_csv_number(text, point->relmse.squared_bias.value);
        for (int c = 0; c < 3; c++)
            add_csv_number(text, point->bias[c].value);
        add_csv_estimate(text, point->ssim);
        add_csv_number(text, point->flip.value);
        add_csv_number(text, point->flip_hdr.value);
        lsf_string_add(text, ",%s", point->front ? "true" : "false");
        add_csv_number(text, point->ssim_gain);
        const lsf_measured_path *path = point->path.frames > 0 ? &point->path : &no_path;
        add_csv_number(text, path->relmse.value);
        add_csv_number(text, path->difference.value);
        add_csv_number(text, path->flicker.value);
        lsf_string_add(text, "\r\n");
    }
}
