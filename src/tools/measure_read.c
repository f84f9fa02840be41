#include "tools/measure_read.h"

#include "base/base.h"
#include "tools/json_read.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Most of a file: thousands of points. */
#define LARGEST ((uint64_t)256 << 20)

static bool is_count(double number, double most)
{
    return number >= 0.0 && number <= most && number == floor(number);
}

/* A member of "options" as "pass.key=value". */
static char *option_text(const lsf_json_value *option)
{
    lsf_string text = {0};
    lsf_string_add(&text, "%s=", option->name);
    if (option->kind == LSF_JSON_STRING)
        lsf_string_add(&text, "%s", option->text);
    else
        lsf_string_add_json_number(&text, option->number);
    return text.text;
}

static int64_t read_configuration(lsf_measurement *m, const lsf_json_document *d,
                                  const lsf_json_value *value)
{
    const char *technique = lsf_json_find_string(d, value, "technique");
    char *options[LSF_SWEEP_MAX_OPTIONS];
    uint32_t count = 0;
    const lsf_json_value *option = lsf_json_first(d, lsf_json_find(d, value, "options"));
    for (; option && count < LSF_SWEEP_MAX_OPTIONS; option = lsf_json_next(d, option))
        if (!(options[count] = option_text(option)))
            break;
        else
            count++;
    int64_t index =
        technique && !option
            ? lsf_measurement_add_configuration(m, technique, (const char *const *)options, count)
            : -1;
    for (uint32_t i = 0; i < count; i++)
        free(options[i]);
    return index;
}

static bool read_products(lsf_squared_error *error, const lsf_json_document *d,
                          const lsf_json_value *value, uint32_t seeds)
{
    const lsf_json_value *product = lsf_json_first(d, lsf_json_find(d, value, "products"));
    error->reference_deviation = lsf_json_find_number(d, value, "reference_deviation");
    for (uint32_t s = 0; s < seeds; s++)
        for (uint32_t t = s; t < seeds; t++) {
            if (!product)
                return false;
            error->products[s][t] = error->products[t][s] = product->number;
            product = lsf_json_next(d, product);
        }
    return true;
}

static void read_seed(lsf_measured_seed *seed, const lsf_json_document *d,
                      const lsf_json_value *value)
{
    const lsf_json_value *bias = lsf_json_first(d, lsf_json_find(d, value, "bias"));
    double number = lsf_json_find_number(d, value, "seed");
    double non_finite = lsf_json_find_number(d, value, "non_finite");
    seed->seed = is_count(number, 0x1p53) ? (uint64_t)number : 0;
    seed->milliseconds = lsf_json_find_number(d, value, "milliseconds");
    for (int c = 0; c < 3 && bias; c++, bias = lsf_json_next(d, bias))
        seed->bias[c] = bias->number;
    seed->ssim = lsf_json_find_number(d, value, "ssim");
    seed->psnr = lsf_json_find_number(d, value, "psnr");
    seed->flip = lsf_json_find_number(d, value, "flip");
    seed->flip_hdr = lsf_json_find_number(d, value, "flip_hdr");
    seed->non_finite = is_count(non_finite, 0x1p53) ? (uint64_t)non_finite : 0;
}

static lsf_estimate read_estimate(const lsf_json_document *d, const lsf_json_value *object,
                                  const char *name)
{
    const lsf_json_value *value = lsf_json_find(d, object, name);
    return (lsf_estimate){lsf_json_find_number(d, value, "value"),
                          lsf_json_find_number(d, value, "low"),
                          lsf_json_find_number(d, value, "high")};
}

static void read_path(lsf_measured_path *path, const lsf_json_document *d,
                      const lsf_json_value *value)
{
    const lsf_json_value *times = lsf_json_find(d, value, "milliseconds");
    double frames = lsf_json_find_number(d, value, "frames");
    if (!is_count(frames, UINT32_MAX))
        return; /* there are none */
    path->frames = (uint32_t)frames;
    path->temporal = lsf_json_find_number(d, value, "temporal") > 0.0;
    path->milliseconds = (lsf_quartiles){lsf_json_find_number(d, times, "lower_quartile"),
                                         lsf_json_find_number(d, times, "median"),
                                         lsf_json_find_number(d, times, "upper_quartile")};
    path->relmse = read_estimate(d, value, "relmse");
    path->difference = read_estimate(d, value, "difference");
    path->flicker = read_estimate(d, value, "flicker");
    path->motion = lsf_json_find_number(d, value, "motion");
}

static bool copy_path(char **path, const lsf_json_document *d, const lsf_json_value *value,
                      const char *name)
{
    const char *text = lsf_json_find_string(d, value, name);
    *path = text ? strdup(text) : NULL;
    return !text || *path;
}

static void read_passes(lsf_measured_point *point, const lsf_json_document *d,
                        const lsf_json_value *passes)
{
    const lsf_json_value *value = lsf_json_first(d, passes);
    for (; value && point->pass_count < LSF_SWEEP_MAX_PASSES; value = lsf_json_next(d, value)) {
        const char *name = lsf_json_find_string(d, value, "name");
        double runs = lsf_json_find_number(d, value, "runs");
        lsf_measured_pass *pass = &point->passes[point->pass_count];
        if (!name || !is_count(runs, 0x1p53))
            continue;
        snprintf(pass->name, sizeof pass->name, "%s", name);
        pass->runs = (uint64_t)runs;
        pass->milliseconds = lsf_json_find_number(d, value, "milliseconds");
        point->pass_count++;
    }
}

static bool read_point(lsf_measurement *m, const lsf_json_document *d, const lsf_json_value *value)
{
    double samples = lsf_json_find_number(d, value, "samples");
    int64_t configuration = read_configuration(m, d, value);
    const lsf_json_value *bytes = lsf_json_find(d, value, "gl_bytes");
    double plan = lsf_json_find_number(d, bytes, "plan");
    double peak = lsf_json_find_number(d, bytes, "peak");
    if (configuration < 0 || !is_count(samples, UINT32_MAX) || samples < 1.0 ||
        !is_count(plan, 0x1p53) || !is_count(peak, 0x1p53))
        return false;
    lsf_measured_point *point = lsf_measurement_add_point(m);
    if (!point)
        return false;
    point->configuration = (uint32_t)configuration;
    point->samples = (uint32_t)samples;
    point->gl_bytes = (uint64_t)plan;
    point->gl_bytes_peak = (uint64_t)peak;
    const lsf_json_value *seed = lsf_json_first(d, lsf_json_find(d, value, "seeds"));
    for (; seed && point->seed_count < LSF_SWEEP_MAX_SEEDS; seed = lsf_json_next(d, seed))
        read_seed(&point->seeds[point->seed_count++], d, seed);
    read_passes(point, d, lsf_json_find(d, value, "passes"));
    read_path(&point->path, d, lsf_json_find(d, value, "path"));
    return point->seed_count > 0 &&
           read_products(&point->mse, d, lsf_json_find(d, value, "mse"), point->seed_count) &&
           read_products(&point->relmse, d, lsf_json_find(d, value, "relmse"), point->seed_count) &&
           copy_path(&point->picture, d, value, "picture") &&
           copy_path(&point->preview, d, value, "preview");
}

static bool read_points(lsf_measurement *m, const lsf_json_document *d, const char *path,
                        lsf_error *error)
{
    const lsf_json_value *root = d->values;
    const char *key = lsf_json_find_string(d, root, "key");
    const char *command = lsf_json_find_string(d, root, "command");
    if (!key || !command || strcmp(command, "measure") != 0)
        return lsf_error_set(
            error, LSF_ERROR_FILE,
            "%s: was not written by measure --json; name another file, or leave out --resume",
            path);
    if (strcmp(key, m->key) != 0)
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: something else was measured: the scene, the reference, the "
                             "options, the device or the "
                             "version differ; name another file, or leave out --resume",
                             path);
    const lsf_json_value *point = lsf_json_first(d, lsf_json_find(d, root, "points"));
    for (uint32_t i = 0; point; point = lsf_json_next(d, point), i++)
        if (!read_point(m, d, point))
            return lsf_error_set(
                error, LSF_ERROR_FILE,
                "%s: point %u is not in the format of measure --json; leave out --resume", path, i);
    return true;
}

bool lsf_measure_read(lsf_measurement *m, const char *path, lsf_error *error)
{
    size_t length;
    lsf_json_document document = {0};
    char *text = lsf_file_read(path, LARGEST, &length, error);
    bool good = text && lsf_json_parse(&document, text, length, path, error) &&
                read_points(m, &document, path, error);
    lsf_json_document_finish(&document);
    free(text);
    return good;
}
