#include "tools/measure.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <xxhash.h>

#include "base/base.h"
#include "sweep/grid.h"
#include "tools/begin.h"
#include "tools/imprint.h"
#include "tools/interrupt.h"
#include "tools/measure_answer.h"
#include "tools/measure_html.h"
#include "tools/measure_json.h"
#include "tools/measure_presets.h"
#include "tools/measure_read.h"
#include "tools/measure_reference.h"
#include "tools/measure_table.h"
#include "tools/scenes.h"
#include "tools/summary.h"
#include "tools/tools.h"

/* Where all that is found goes. */
typedef struct outputs {
    const char *names[4], *paths[4];
} outputs;

static outputs outputs_of(const lsf_settings *settings)
{
    return (outputs){
        {"--json", "--csv", "--html", "--save-preset"},
        {settings->json_path, settings->csv_path, settings->html_path, settings->saved_preset}};
}

static bool is_standard_output(const char *path)
{
    return path && strcmp(path, "-") == 0;
}

/* Before anything is traced. */
static bool check_outputs(const lsf_settings *settings, lsf_error *error)
{
    const outputs all = outputs_of(settings);
    const char *taken = NULL;
    for (size_t i = 0; i < LSF_COUNT(all.paths); i++) {
        if (is_standard_output(all.paths[i]) && taken)
            return lsf_error_set(
                error, LSF_ERROR_USAGE,
                "%s - and %s -: only one of them can be written to standard output", taken,
                all.names[i]);
        if (all.paths[i] && !lsf_file_can_write(all.paths[i], error))
            return false;
        taken = is_standard_output(all.paths[i]) ? all.names[i] : taken;
    }
    return true;
}

static bool check_settings(const lsf_settings *settings, lsf_error *error)
{
    bool budget = !isnan(settings->budget_ms), wanted = !isnan(settings->error);
    const char *path = settings->json_path;
    if (budget && wanted)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "--budget-ms and --error exclude each other; leave one out");
    if (settings->saved_preset && !budget && !wanted)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "--save-preset %s: needs a search; add --budget-ms or --error",
                             settings->saved_preset);
    if (settings->temporal && !settings->frames.given && settings->turntable == 0)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "--temporal: there are no frames; add --frames or --turntable");
    if ((settings->frames.given && settings->frames.first == settings->frames.last) ||
        settings->turntable == 1)
        return lsf_error_set(
            error, LSF_ERROR_USAGE,
            "--frames: at least two frames are needed to measure changes between them");
    if (settings->resume && (!path || is_standard_output(path)))
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "--resume: needs the file of the points; add --json FILE");
    return check_outputs(settings, error);
}

static bool open_scene(lsf_measure_job *job, lsf_error *error)
{
    double seconds;
    lsf_settings *settings = &job->settings;
    lsf_context_params params = lsf_settings_context_params(settings);
    job->scene_path = lsf_tool_scene_path(settings, 0, error);
    if (job->scene_path)
        job->scene = lsf_tool_load_scene(settings, job->scene_path, &seconds, error);
    if (job->scene)
        job->context = lsf_context_create(&params, error);
    if (!job->context)
        return false;
    job->device = lsf_context_get_info(job->context);
    if (!lsf_settings_given(settings, "resolution")) {
        settings->resolution[0] = job->device.software ? 256 : 1024;
        settings->resolution[1] = job->device.software ? 192 : 768;
    }
    return true;
}

/* --- what is measured --- */

static bool describe_run(lsf_measure_job *job, lsf_error *error)
{
    lsf_measurement *m = &job->measurement;
    const lsf_settings *settings = &job->settings;
    lsf_imprint imprint;
    bool good = lsf_imprint_make(&imprint, settings, job->scene_path, "", 0, 0, NULL, error);
    m->scene = good ? strdup(job->scene_path) : NULL;
    m->command = good ? strdup(imprint.command) : NULL;
    lsf_imprint_finish(&imprint);
    lsf_scene_content_hash(job->scene, m->scene_hash);
    m->width = settings->resolution[0];
    m->height = settings->resolution[1];
    m->bounces = lsf_summary_bounces(settings, job->scene);
    m->raw = settings->raw;
    m->exposure = settings->exposure.ev;
    m->clock = settings->clock == 1   ? LSF_CLOCK_PROCESSOR
               : job->device.software ? LSF_CLOCK_WALL
                                      : LSF_CLOCK_GPU;
    return good &&
           ((m->scene && m->command) || lsf_error_set(error, LSF_ERROR_RENDER, "no memory left"));
}

/* An option that a pass refuses is found here, before anything is traced. */
static bool check_plan(const lsf_measure_job *job, uint32_t configuration, lsf_error *error)
{
    const lsf_configuration *c = &job->measurement.configurations[configuration];
    lsf_render_params params = lsf_settings_render_params(&job->settings);
    const char **options =
        lsf_alloc((uint64_t)params.option_count + c->option_count + 1, sizeof *options);
    if (!options)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    for (uint32_t i = 0; i < params.option_count; i++)
        options[i] = params.options[i];
    for (uint32_t i = 0; i < c->option_count; i++)
        options[params.option_count + i] = c->options[i];
    params.options = options;
    params.option_count += c->option_count;
    params.technique = c->technique;
    lsf_plan *plan = lsf_plan_create(job->scene, &params, error);
    bool good = plan != NULL;
    lsf_plan_destroy(plan);
    free((void *)options);
    return good;
}

static bool list_configurations(lsf_measure_job *job, lsf_error *error)
{
    const lsf_settings *settings = &job->settings;
    bool good = lsf_sweep_grid_add(&job->measurement, settings->techniques.items,
                                   settings->techniques.count, settings->sweeps.items,
                                   settings->sweeps.count, error);
    for (uint32_t c = 0; good && c < job->measurement.configuration_count; c++)
        good = check_plan(job, c, error);
    return good;
}

/* What figures depend on, beside configuration, samples and seeds of a point. */
static bool make_key(lsf_measure_job *job, lsf_error *error)
{
    lsf_measurement *m = &job->measurement;
    const lsf_settings *settings = &job->settings;
    lsf_string text = {0};
    lsf_string_add(&text, "%s %s %" PRIu64 " %" PRIu64 " raw %d seed %" PRIu64 " exposure %a",
                   lsf_version(), m->reference.key, m->reference.samples[0],
                   m->reference.samples[1], settings->raw, settings->seed,
                   (double)settings->exposure.ev);
    for (uint32_t i = 0; i < settings->defines.count; i++)
        lsf_string_add(&text, " %s", settings->defines.items[i]);
    lsf_string_add(&text, "%s", job->path_key.text ? job->path_key.text : "");
    lsf_string_add(&text, "\n%s %s %s %s", lsf_clock_name(m->clock), job->device.backend,
                   job->device.renderer, job->device.version);
    XXH128_hash_t hash = XXH3_128bits(text.text, text.length);
    snprintf(m->key, sizeof m->key, "%016" PRIx64 "%016" PRIx64, hash.high64, hash.low64);
    free(text.text);
    return (!text.failed && !job->path_key.failed) ||
           lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
}

static bool read_points(lsf_measure_job *job, lsf_error *error)
{
    const char *path = job->settings.json_path;
    if (!job->settings.resume || access(path, F_OK) != 0)
        return true;
    if (!lsf_measure_read(&job->measurement, path, error))
        return false;
    for (uint32_t i = 0; i < job->measurement.point_count; i++)
        lsf_measured_point_derive(&job->measurement.points[i]);
    lsf_report_line("%s: %u point%s from before", path, job->measurement.point_count,
                    lsf_plural(job->measurement.point_count));
    return true;
}

/* --- what is written --- */

char *lsf_measure_command(const lsf_measure_job *job, uint32_t configuration, uint32_t samples)
{
    const lsf_configuration *c = &job->measurement.configurations[configuration];
    const lsf_settings *settings = &job->settings;
    lsf_string text = {0};
    lsf_string_add(&text, "lightsheaf render");
    lsf_imprint_add_word(&text, job->scene_path);
    lsf_string_add(&text, " --resolution %u,%u", settings->resolution[0], settings->resolution[1]);
    if (settings->shared.text)
        lsf_string_add(&text, "%s", settings->shared.text);
    lsf_string_add(&text, " --technique %s", c->technique);
    for (uint32_t i = 0; i < c->option_count; i++) {
        lsf_string_add(&text, " -D");
        lsf_imprint_add_word(&text, c->options[i]);
    }
    if (samples > 0)
        lsf_string_add(&text, " --samples %u", samples);
    if (text.failed || settings->shared.failed) {
        free(text.text);
        return NULL;
    }
    return text.text;
}

static bool add_commands(lsf_measure_job *job)
{
    for (uint32_t c = 0; c < job->measurement.configuration_count; c++) {
        lsf_configuration *configuration = &job->measurement.configurations[c];
        if (!configuration->command)
            configuration->command = lsf_measure_command(job, c, 0);
        if (!configuration->command)
            return false;
    }
    return true;
}

static bool work_out(lsf_measure_job *job, lsf_error *error)
{
    return (lsf_measurement_derive(&job->measurement) && add_commands(job)) ||
           lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
}

bool lsf_measure_write_json(lsf_measure_job *job, lsf_error *error)
{
    lsf_json json = {0};
    job->measurement.seconds = lsf_now() - job->start;
    if (!work_out(job, error))
        return false;
    lsf_measure_add_json(&json, &job->measurement, &job->device, &job->prices);
    bool good = lsf_json_write(&json, job->settings.json_path, error);
    free(json.text.text);
    return good;
}

/* Its pictures end with it, and the JSON speaks of them no more. */
static bool write_html(lsf_measure_job *job, lsf_error *error)
{
    job->measurement.seconds = lsf_now() - job->start;
    bool good = work_out(job, error) &&
                lsf_measure_write_html(&job->measurement, &job->device, &job->prices,
                                       job->settings.html_path, error);
    lsf_measure_end_pictures(&job->measurement, &job->picture_folder);
    return good;
}

static bool write_csv(const lsf_measure_job *job, lsf_error *error)
{
    lsf_string text = {0};
    if (!job->settings.csv_path)
        return true;
    lsf_measure_add_csv(&text, &job->measurement);
    bool good = !text.failed || lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    good = good && lsf_file_write(job->settings.csv_path, text.text, text.length, error);
    free(text.text);
    return good;
}

/* Where something else takes its place there is no table. */
static bool print_table(lsf_measure_job *job, lsf_error *error)
{
    const lsf_settings *settings = &job->settings;
    const outputs all = outputs_of(settings);
    lsf_string text = {0};
    for (size_t i = 0; i < LSF_COUNT(all.paths); i++)
        if (is_standard_output(all.paths[i]))
            return true;
    lsf_measure_add_table(&text, &job->measurement);
    if (settings->prices) {
        lsf_string_add(&text, "\n");
        lsf_prices_add_text(&text, &job->prices);
    }
    if (job->measurement.answer.given) {
        lsf_string_add(&text, "\n");
        lsf_measure_add_answer(&text, &job->measurement);
    }
    return lsf_tool_print(settings, 0, text.text, error);
}

static bool save_preset(const lsf_measure_job *job, lsf_error *error)
{
    const lsf_answer *answer = &job->measurement.answer;
    return !job->settings.saved_preset || !answer->given ||
           lsf_measure_save_preset(job->settings.saved_preset, &job->settings, &job->measurement,
                                   error);
}

/* What took long to measure is not lost because one of the files cannot be written: the first
 * error counts, and the rest is written all the same. */
static bool write_all(lsf_measure_job *job, lsf_error *error)
{
    lsf_error later;
    bool good = write_html(job, error);
    good = lsf_measure_write_json(job, good ? error : &later) && good;
    good = write_csv(job, good ? error : &later) && good;
    good = save_preset(job, good ? error : &later) && good;
    return print_table(job, good ? error : &later) && good;
}

static bool run(lsf_measure_job *job, lsf_error *error)
{
    if (!check_settings(&job->settings, error) || !lsf_measure_fill_in(&job->settings, error) ||
        !lsf_measure_begin_pictures(&job->settings, &job->picture_folder, error) ||
        !open_scene(job, error) || !describe_run(job, error) || !list_configurations(job, error))
        return false;
    lsf_interrupt_begin_iterations();
    bool good = lsf_measure_reference(&job->settings, job->scene, &job->measurement,
                                      &job->reference, error) &&
                lsf_measure_begin_path(job, error) && make_key(job, error) &&
                read_points(job, error) && lsf_measure_points(job, error) &&
                lsf_measure_prices(job, error);
    lsf_interrupt_end_iterations();
    return good && write_all(job, error);
}

int lsf_tool_measure(int argc, char **argv)
{
    lsf_measure_job job = {.start = lsf_now()};
    lsf_error error;
    int status = lsf_tool_begin(&job.settings, LSF_COMMAND_MEASURE, argc, argv);
    if (status == LSF_GO_ON) {
        lsf_report_once();
        status = run(&job, &error) ? 0 : lsf_report_error(&error);
        lsf_kept_reference_finish(&job.reference);
        lsf_measure_end_path(&job);
        lsf_measure_end_pictures(&job.measurement, &job.picture_folder);
        lsf_context_destroy(job.context);
        lsf_scene_destroy(job.scene);
        free(job.scene_path);
        lsf_prices_finish(&job.prices);
        lsf_measurement_finish(&job.measurement);
    }
    lsf_settings_finish(&job.settings);
    return status;
}
