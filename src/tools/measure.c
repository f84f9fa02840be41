#include "base/base.h"
#include "sweep/grid.h"
#include "sweep/run.h"
#include "tools/begin.h"
#include "tools/imprint.h"
#include "tools/interrupt.h"
#include "tools/measure_html.h"
#include "tools/measure_json.h"
#include "tools/measure_reference.h"
#include "tools/measure_table.h"
#include "tools/report.h"
#include "tools/scenes.h"
#include "tools/summary.h"
#include "tools/tools.h"

#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 16, SEEDS = 4 };

typedef struct measure_job {
    lsf_settings settings;
    char *scene_path;
    lsf_scene *scene;
    lsf_context *context;
    lsf_context_info device;
    lsf_kept_reference reference;
    lsf_measurement measurement;
    lsf_progress_bar bar;
    uint32_t done, total; /* iterations */
    double start;
    char *picture_folder; /* that lasts as long as the command; NULL: none */
} measure_job;

static uint32_t or_else(uint32_t given, uint32_t otherwise)
{
    return given ? given : otherwise;
}

static bool open_scene(measure_job *job, lsf_error *error)
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

/* --- points --- */

static void advance(void *user)
{
    measure_job *job = user;
    lsf_progress_bar_draw(&job->bar, ++job->done, job->total);
}

static bool go_on(void *user)
{
    (void)user;
    return !lsf_interrupted();
}

static bool list_configurations(measure_job *job, lsf_error *error)
{
    const lsf_settings *settings = &job->settings;
    const char *all[16];
    const char *const *techniques = settings->techniques.items;
    uint32_t count = settings->techniques.count;
    if (count == 0) {
        for (; count < LSF_COUNT(all) && lsf_technique_name(count); count++)
            all[count] = lsf_technique_name(count);
        techniques = all;
    }
    return lsf_sweep_grid_add(&job->measurement, techniques, count, settings->sweeps.items,
                              settings->sweeps.count, error);
}

/* Iterations of one seed: 1, 2, 4 ... */
static uint32_t iterations_up_to(uint32_t most)
{
    uint32_t sum = 0;
    for (uint32_t samples = 1; samples <= most; samples *= 2)
        sum += samples;
    return sum;
}

static bool measure_points(measure_job *job, lsf_error *error)
{
    const lsf_settings *settings = &job->settings;
    lsf_measurement *m = &job->measurement;
    uint32_t most = or_else(settings->samples, SAMPLES), seeds = or_else(settings->seeds, SEEDS);
    lsf_sweep_stage stage = {.context = job->context,
                             .scene = job->scene,
                             .params = lsf_settings_render_params(settings),
                             .halves = {job->reference.halves[0], job->reference.halves[1]},
                             .exposure = settings->exposure.ev,
                             .gpu_clock = m->gpu_clock,
                             .folder = settings->picture_folder,
                             .advance = advance,
                             .go_on = go_on,
                             .user = job};
    job->total = m->configuration_count * seeds * iterations_up_to(most);
    lsf_progress_bar_start(&job->bar, "measure", job->total, 1.0 / 0.0);
    bool good = true;
    for (uint32_t samples = 1; good && !m->interrupted && samples <= most; samples *= 2)
        for (uint32_t c = 0; good && !m->interrupted && c < m->configuration_count; c++)
            good = lsf_sweep_run_point(&stage, m, c, samples, seeds, &m->interrupted, error);
    lsf_progress_bar_clear();
    return good;
}

/* --- what is written --- */

static bool describe_run(measure_job *job, lsf_error *error)
{
    lsf_measurement *m = &job->measurement;
    const lsf_settings *settings = &job->settings;
    lsf_imprint imprint;
    bool good = lsf_imprint_make(&imprint, settings, job->scene_path, "", 0, 0, error);
    m->scene = good ? strdup(job->scene_path) : NULL;
    m->command = good ? strdup(imprint.command) : NULL;
    lsf_imprint_finish(&imprint);
    lsf_scene_content_hash(job->scene, m->scene_hash);
    m->width = settings->resolution[0];
    m->height = settings->resolution[1];
    m->bounces = lsf_summary_bounces(settings, job->scene);
    m->raw = settings->raw;
    m->exposure = settings->exposure.ev;
    m->gpu_clock = !job->device.software;
    m->seed_count = or_else(settings->seeds, SEEDS);
    return good &&
           ((m->scene && m->command) || lsf_error_set(error, LSF_ERROR_RENDER, "no memory left"));
}

static bool write_csv(const measure_job *job, lsf_error *error)
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

static bool write_results(measure_job *job, lsf_error *error)
{
    lsf_json json = {0};
    lsf_string table = {0};
    job->measurement.seconds = lsf_now() - job->start;
    if (!lsf_measurement_derive(&job->measurement))
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    bool good =
        lsf_measure_write_html(&job->measurement, &job->device, job->settings.html_path, error);
    lsf_measure_end_pictures(&job->measurement, &job->picture_folder);
    lsf_measure_add_json(&json, &job->measurement, &job->device);
    good = good && lsf_json_write(&json, job->settings.json_path, error) && write_csv(job, error);
    free(json.text.text);
    lsf_measure_add_table(&table, &job->measurement);
    if (!good || job->settings.quiet) {
        free(table.text);
        return good;
    }
    return lsf_tool_print(&job->settings, 0, table.text, error);
}

static bool run(measure_job *job, lsf_error *error)
{
    if (!lsf_measure_begin_pictures(&job->settings, &job->picture_folder, error) ||
        !open_scene(job, error) || !describe_run(job, error) || !list_configurations(job, error))
        return false;
    lsf_interrupt_begin_iterations();
    bool good = lsf_measure_reference(&job->settings, job->scene, &job->measurement,
                                      &job->reference, error) &&
                measure_points(job, error);
    lsf_interrupt_end_iterations();
    return good && write_results(job, error);
}

int lsf_tool_measure(int argc, char **argv)
{
    measure_job job = {.start = lsf_now()};
    lsf_error error;
    int status = lsf_tool_begin(&job.settings, LSF_COMMAND_MEASURE, argc, argv);
    if (status == LSF_GO_ON) {
        status = run(&job, &error) ? 0 : lsf_report_error(&error);
        lsf_kept_reference_finish(&job.reference);
        lsf_measure_end_pictures(&job.measurement, &job.picture_folder);
        lsf_context_destroy(job.context);
        lsf_scene_destroy(job.scene);
        free(job.scene_path);
        lsf_measurement_finish(&job.measurement);
    }
    lsf_settings_finish(&job.settings);
    return status;
}
