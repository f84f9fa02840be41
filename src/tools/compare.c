#include "base/base.h"
#include "tools/begin.h"
#include "tools/json.h"
#include "tools/number.h"
#include "tools/report.h"
#include "tools/tools.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The metrics that --threshold can limit. */
static const struct metric {
    const char *name;
    bool higher_is_better;
} metrics[] = {{"rmse", false}, {"rmse_relative", false}, {"relmse", false}, {"bias", false},
               {"ssim", true},  {"psnr", true},           {"flip", false},   {"flip_hdr", false}};

typedef struct threshold {
    const struct metric *metric;
    double limit, value;
    bool passed;
} threshold;

typedef struct session {
    lsf_image *test, *reference, *reference_b, *mask;
    uint32_t threshold_count;
    threshold *thresholds;
    lsf_compare_result result;
} session;

static double metric_value(const struct metric *metric, const lsf_compare_result *result)
{
    if (strcmp(metric->name, "rmse") == 0)
        return result->rmse;
    if (strcmp(metric->name, "rmse_relative") == 0)
        return result->rmse_relative;
    if (strcmp(metric->name, "relmse") == 0)
        return result->relmse;
    if (strcmp(metric->name, "ssim") == 0)
        return result->ssim;
    if (strcmp(metric->name, "psnr") == 0)
        return result->psnr;
    if (strcmp(metric->name, "flip") == 0)
        return result->flip;
    if (strcmp(metric->name, "flip_hdr") == 0)
        return result->flip_hdr;
    return fmax(fabs(result->bias[0]), fmax(fabs(result->bias[1]), fabs(result->bias[2])));
}

static bool parse_thresholds(session *s, const lsf_settings *settings, lsf_error *error)
{
    s->thresholds = lsf_alloc(settings->thresholds.count, sizeof *s->thresholds);
    if (!s->thresholds)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    s->threshold_count = settings->thresholds.count;
    for (uint32_t i = 0; i < s->threshold_count; i++) {
        const char *text = settings->thresholds.items[i];
        size_t length = strcspn(text, "=");
        threshold *t = &s->thresholds[i];
        for (size_t m = 0; m < LSF_COUNT(metrics); m++)
            if (strlen(metrics[m].name) == length && memcmp(metrics[m].name, text, length) == 0)
                t->metric = &metrics[m];
        if (!t->metric || !lsf_parse_number(text + length + 1, -1e30, 1e30, &t->limit))
            return lsf_error_set(error, LSF_ERROR_USAGE,
                                 "--threshold %s: give METRIC=X, where METRIC is rmse, "
                                 "rmse_relative, relmse, bias, ssim, psnr, flip or "
                                 "flip_hdr",
                                 text);
    }
    return true;
}

static bool load_images(session *s, const lsf_settings *settings, lsf_error *error)
{
    const lsf_list_setting *operands = &settings->operands;
    s->test = lsf_image_load(operands->items[0], error);
    s->reference = s->test ? lsf_image_load(operands->items[1], error) : NULL;
    if (!s->reference)
        return false;
    if (operands->count > 2 && !(s->reference_b = lsf_image_load(operands->items[2], error)))
        return false;
    return !settings->mask || (s->mask = lsf_image_load(settings->mask, error));
}

static bool measure(session *s, const lsf_settings *settings, lsf_error *error)
{
    lsf_compare_params params = {.reference_b = s->reference_b,
                                 .mask = s->mask,
                                 .relmse_epsilon = (float)settings->epsilon,
                                 .exposure = settings->exposure.ev,
                                 .curve = (lsf_tone_curve)settings->tonemap,
                                 .flip = settings->flip};
    for (uint32_t i = 0; i < s->threshold_count; i++)
        params.flip |= strncmp(s->thresholds[i].metric->name, "flip", 4) == 0;
    lsf_error cause;
    if (!lsf_compare(s->test, s->reference, &params, &s->result, &cause))
        return lsf_error_set(error, cause.code, "%s against %s: %s", settings->operands.items[0],
                             settings->operands.items[1], cause.message);
    for (uint32_t i = 0; i < s->threshold_count; i++) {
        threshold *t = &s->thresholds[i];
        t->value = metric_value(t->metric, &s->result);
        /* Written so that a NaN fails. */
        t->passed = t->metric->higher_is_better ? t->value >= t->limit : t->value <= t->limit;
    }
    return true;
}

static bool write_difference(const session *s, const lsf_settings *settings, lsf_error *error)
{
    if (!settings->difference)
        return true;
    lsf_image *difference =
        lsf_compare_difference(s->test, s->reference, settings->difference_gain, error);
    lsf_image_save_params params = {LSF_IMAGE_SAVE_PARAMS_DEFAULTS};
    params.exposure = settings->exposure.ev;
    params.curve = (lsf_tone_curve)settings->tonemap;
    bool good = difference && lsf_image_save(difference, settings->difference, &params, error);
    lsf_image_destroy(difference);
    if (good)
        lsf_report_line("%s: |test - reference| times %g", settings->difference,
                        (double)settings->difference_gain);
    return good;
}

static void add_row(lsf_string *text, const char *title, const double rgb[3], const char *unit)
{
    double scale = *unit ? 100.0 : 1.0;
    lsf_string_add(text, "%-16s %#.6g%s  %#.6g%s  %#.6g%s\n", title, rgb[0] * scale, unit,
                   rgb[1] * scale, unit, rgb[2] * scale, unit);
}

static void add_text(lsf_string *text, const session *s, const lsf_settings *settings)
{
    const lsf_compare_result *r = &s->result;
    uint64_t all = (uint64_t)s->test->width * s->test->height;
    lsf_string_add(text, "%-16s %" PRIu64 " of %" PRIu64 "\n", "pixels compared", r->pixels, all);
    if (r->non_finite_test + r->non_finite_reference)
        lsf_string_add(text, "%-16s %" PRIu64 " in test, %" PRIu64 " in reference\n", "not finite",
                       r->non_finite_test, r->non_finite_reference);
    add_row(text, "mean test", r->mean_test, "");
    add_row(text, "mean reference", r->mean_reference, "");
    add_row(text, "bias", r->bias, "%");
    lsf_string_add(text, "%-16s %.6g (%.4g%% of the mean)%s\n", "RMSE", r->rmse,
                   100.0 * r->rmse_relative, r->noise_corrected ? ", reference noise removed" : "");
    lsf_string_add(text, "%-16s %.6g (epsilon %.4g)%s\n", "relMSE", r->relmse, r->relmse_epsilon,
                   r->noise_corrected ? ", reference noise removed" : "");
    lsf_string_add(text, "%-16s %.6f (tone-mapped luminance, exposure %+g EV)\n", "SSIM", r->ssim,
                   (double)settings->exposure.ev);
    lsf_string_add(text, "%-16s %.2f dB (tone-mapped R, G, B)\n", "PSNR", r->psnr);
    if (!isnan(r->flip))
        lsf_string_add(text, "%-16s %.6f (tone-mapped R, G, B)\n", "FLIP", r->flip);
    if (!isnan(r->flip_hdr))
        lsf_string_add(text, "%-16s %.6f (%u exposures, %+.4f to %+.4f EV)\n", "HDR-FLIP",
                       r->flip_hdr, r->flip_exposures, (double)r->flip_start, (double)r->flip_stop);
    for (uint32_t i = 0; i < s->threshold_count; i++) {
        const threshold *t = &s->thresholds[i];
        lsf_string_add(text, "%-16s %s %.6g: %s (%.6g)\n", "threshold", t->metric->name, t->limit,
                       t->passed ? "held" : "VIOLATED", t->value);
    }
}

static void add_json_vector(lsf_json *json, const char *name, const double values[3])
{
    lsf_json_begin(json, name, '[');
    for (int c = 0; c < 3; c++)
        lsf_json_number(json, NULL, values[c]);
    lsf_json_end(json, ']');
}

static void add_json(lsf_json *json, const session *s, const lsf_settings *settings, bool passed)
{
    const lsf_compare_result *r = &s->result;
    const lsf_list_setting *operands = &settings->operands;
    lsf_tool_begin_json(json, settings);
    lsf_json_string(json, "test", operands->items[0]);
    lsf_json_string(json, "reference", operands->items[1]);
    lsf_json_string(json, "reference_b", operands->count > 2 ? operands->items[2] : NULL);
    lsf_json_string(json, "mask", settings->mask);
    lsf_json_vector(json, "resolution", (float[]){(float)s->test->width, (float)s->test->height},
                    2);
    lsf_json_integer(json, "pixels", r->pixels);
    lsf_json_integer(json, "non_finite_test", r->non_finite_test);
    lsf_json_integer(json, "non_finite_reference", r->non_finite_reference);
    add_json_vector(json, "mean_test", r->mean_test);
    add_json_vector(json, "mean_reference", r->mean_reference);
    add_json_vector(json, "bias", r->bias);
    lsf_json_number(json, "rmse", r->rmse);
    lsf_json_number(json, "rmse_relative", r->rmse_relative);
    lsf_json_number(json, "relmse", r->relmse);
    lsf_json_number(json, "relmse_epsilon", r->relmse_epsilon);
    lsf_json_number(json, "ssim", r->ssim);
    lsf_json_number(json, "psnr", r->psnr);
    lsf_json_number(json, "flip", r->flip);
    lsf_json_number(json, "flip_hdr", r->flip_hdr);
    lsf_json_number(json, "exposure", (double)settings->exposure.ev);
    lsf_json_bool(json, "noise_corrected", r->noise_corrected);
    lsf_json_begin(json, "thresholds", '[');
    for (uint32_t i = 0; i < s->threshold_count; i++) {
        const threshold *t = &s->thresholds[i];
        lsf_json_begin(json, NULL, '{');
        lsf_json_string(json, "metric", t->metric->name);
        lsf_json_number(json, "limit", t->limit);
        lsf_json_number(json, "value", t->value);
        lsf_json_bool(json, "passed", t->passed);
        lsf_json_end(json, '}');
    }
    lsf_json_end(json, ']');
    lsf_json_bool(json, "passed", passed);
    lsf_json_end(json, '}');
}

/* The first cause for which the pictures count as different. */
static bool judge(const session *s, const lsf_settings *settings, lsf_error *error)
{
    const lsf_compare_result *r = &s->result;
    if (r->non_finite_test + r->non_finite_reference)
        return lsf_error_set(
            error, LSF_ERROR_DIFFERS,
            "%s: %" PRIu64 " pixels are NaN or infinite, and %" PRIu64 " of the reference",
            settings->operands.items[0], r->non_finite_test, r->non_finite_reference);
    for (uint32_t i = 0; i < s->threshold_count; i++) {
        const threshold *t = &s->thresholds[i];
        if (!t->passed)
            return lsf_error_set(
                error, LSF_ERROR_DIFFERS, "%s differs from %s: %s is %.6g, %s the threshold %.6g",
                settings->operands.items[0], settings->operands.items[1], t->metric->name, t->value,
                t->metric->higher_is_better ? "below" : "above", t->limit);
    }
    return true;
}

static bool print_result(const session *s, const lsf_settings *settings, bool passed,
                         lsf_error *error)
{
    lsf_json json = {0};
    add_json(&json, s, settings, passed);
    bool good = lsf_json_write(&json, settings->json_path, error);
    free(json.text.text);
    if (!good || settings->quiet || lsf_settings_print_json(settings))
        return good;
    lsf_string text = {0};
    add_text(&text, s, settings);
    good = !text.failed || lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    good = good && lsf_file_write("-", text.text, text.length, error);
    free(text.text);
    return good;
}

static bool run(session *s, const lsf_settings *settings, lsf_error *error)
{
    if (!parse_thresholds(s, settings, error) || !load_images(s, settings, error) ||
        !measure(s, settings, error) || !write_difference(s, settings, error))
        return false;
    lsf_error verdict;
    bool passed = judge(s, settings, &verdict);
    if (!print_result(s, settings, passed, error))
        return false;
    return passed || lsf_error_set(error, verdict.code, "%s", verdict.message);
}

int lsf_tool_compare(int argc, char **argv)
{
    lsf_settings settings;
    int status = lsf_tool_begin(&settings, LSF_COMMAND_COMPARE, argc, argv);
    if (status == LSF_GO_ON) {
        session s = {0};
        lsf_error error;
        status = run(&s, &settings, &error) ? 0 : lsf_report_error(&error);
        lsf_image_destroy(s.test);
        lsf_image_destroy(s.reference);
        lsf_image_destroy(s.reference_b);
        lsf_image_destroy(s.mask);
        free(s.thresholds);
    }
    lsf_settings_finish(&settings);
    return status;
}
