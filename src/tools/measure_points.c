#include "tools/measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "sweep/grid.h"
#include "sweep/run.h"
#include "sweep/search.h"
#include "tools/interrupt.h"

/* --- one point --- */

static void advance(void *user)
{
    lsf_measure_job *job = user;
    lsf_progress_bar_draw(&job->bar, ++job->done, job->total);
}

static bool go_on(void *user)
{
    (void)user;
    return !lsf_interrupted();
}

static lsf_sweep_stage stage_of(lsf_measure_job *job)
{
    const lsf_settings *settings = &job->settings;
    lsf_render_params params = lsf_settings_render_params(settings);
    params.temporal = false; /* of frames that follow each other alone */
    return (lsf_sweep_stage){.context = job->context,
                             .scene = job->scene,
                             .params = params,
                             .halves = {job->reference.halves[0], job->reference.halves[1]},
                             .exposure = settings->exposure.ev,
                             .clock = job->measurement.clock,
                             .folder = settings->picture_folder,
                             .advance = advance,
                             .go_on = go_on,
                             .user = job};
}

/* Such as for want of memory on the device: the other configurations go on. */
static bool note_failure(lsf_measure_job *job, uint32_t configuration, const lsf_error *cause,
                         lsf_error *error)
{
    lsf_configuration *failed = &job->measurement.configurations[configuration];
    char *command = lsf_measure_command(job, configuration, 0);
    lsf_log(LSF_LOG_WARNING, "%s: left out: %s", command ? command : failed->technique,
            cause->message);
    free(command);
    failed->failure = strdup(cause->message);
    return failed->failure || lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
}

/* The frames of the path, where they are not with the point yet. */
static bool measure_path(lsf_measure_job *job, const lsf_sweep_stage *stage,
                         lsf_measured_point *point, bool *stopped, lsf_error *error)
{
    if (*stopped || !point || point->path.frames == job->frame_count)
        return true;
    return lsf_sweep_run_path(stage, &job->measurement, point, job->frames, job->frame_count,
                              job->settings.temporal, stopped, error);
}

/* As lsf_search_measure. */
static bool measure_point(void *user, uint32_t configuration, uint32_t samples, uint32_t seeds,
                          bool *stopped, lsf_error *error)
{
    lsf_measure_job *job = user;
    lsf_measurement *m = &job->measurement;
    const lsf_sweep_stage stage = stage_of(job);
    const char *path = job->settings.json_path;
    lsf_error cause;
    lsf_measured_point *point = lsf_measurement_find(m, configuration, samples);
    bool there = point && point->seed_count >= seeds && point->path.frames == job->frame_count;
    if (m->configurations[configuration].failure || there) {
        job->total -= job->total > samples * seeds ? samples * seeds : 0;
        return true;
    }
    if (point && point->seed_count < seeds) {
        lsf_measurement_drop_point(m, point);
        point = NULL;
    }
    if ((!point &&
         !lsf_sweep_run_point(&stage, m, configuration, samples, seeds, stopped, &cause)) ||
        !measure_path(job, &stage, lsf_measurement_find(m, configuration, samples), stopped,
                      &cause))
        return cause.code == LSF_ERROR_RENDER
                   ? note_failure(job, configuration, &cause, error)
                   : lsf_error_set(error, cause.code, "%s", cause.message);
    m->interrupted = *stopped;
    return !path || strcmp(path, "-") == 0 || lsf_measure_write_json(job, error);
}

/* --- all of them --- */

/* Powers of 2 below the most, and the most itself; 0 ends them. */
static uint32_t samples_after(uint32_t samples, uint32_t most)
{
    if (samples == most)
        return 0;
    return samples > most / 2 ? most : 2 * samples;
}

static bool sweep(lsf_measure_job *job, lsf_error *error)
{
    const lsf_settings *settings = &job->settings;
    lsf_measurement *m = &job->measurement;
    uint32_t most = settings->samples;
    bool good = true, stopped = false;
    for (uint32_t samples = 1; samples > 0; samples = samples_after(samples, most))
        job->total +=
            samples * settings->seeds * m->configuration_count * (1 + 2 * job->frame_count);
    lsf_progress_bar_start(&job->bar, "measure", job->total, INFINITY);
    for (uint32_t samples = 1; good && !stopped && samples > 0;
         samples = samples_after(samples, most))
        for (uint32_t c = 0; good && !stopped && c < m->configuration_count; c++)
            good = measure_point(job, c, samples, settings->seeds, &stopped, error);
    return good;
}

static void expect(void *user, uint32_t iterations)
{
    lsf_measure_job *job = user;
    job->total = job->done + iterations;
}

static bool search(lsf_measure_job *job, lsf_error *error)
{
    const lsf_settings *settings = &job->settings;
    lsf_search search = {.measurement = &job->measurement,
                         .budget_ms = settings->budget_ms,
                         .relmse = settings->error,
                         .seeds = settings->seeds,
                         .most_samples = settings->samples,
                         .measure = measure_point,
                         .expect = expect,
                         .user = job};
    lsf_progress_bar_start(&job->bar, "search", UINT32_MAX, INFINITY);
    if (!lsf_search_run(&search, error))
        return false;
    lsf_answer *answer = &job->measurement.answer;
    if (!answer->given)
        return lsf_error_set(error, LSF_ERROR_RENDER,
                             "there is no result: nothing could be measured");
    answer->command = lsf_measure_command(job, answer->configuration, answer->samples);
    return answer->command || lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
}

bool lsf_measure_points(lsf_measure_job *job, lsf_error *error)
{
    const lsf_settings *settings = &job->settings;
    bool answers = !isnan(settings->budget_ms) || !isnan(settings->error);
    bool good = answers ? search(job, error) : sweep(job, error);
    lsf_progress_bar_clear();
    return good;
}
