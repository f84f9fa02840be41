#include "base/base.h"
#include "tools/begin.h"
#include "tools/interrupt.h"
#include "tools/output.h"
#include "tools/report.h"
#include "tools/scenes.h"
#include "tools/summary.h"
#include "tools/tools.h"

#include <stdlib.h>

/* What JSON and header call it. */
#define TECHNIQUE "path tracing"

typedef struct reference_job {
    const lsf_settings *settings;
    lsf_destination *destination;
    const char *scene_path;
    lsf_scene *scene;
    uint32_t half, half_count;
    lsf_image *halves[2];
    lsf_reference_result results[2];
    lsf_image *mean; /* NULL without halves */
    lsf_progress_bar bar;
    double start, load_seconds, save_seconds;
} reference_job;

static void warn_of_options_without_effect(const lsf_settings *settings)
{
    static const char *const names[] = {"technique", "define", "backend", "shader-dir", "gl-debug"};
    for (size_t i = 0; i < LSF_COUNT(names); i++)
        if (lsf_settings_given(settings, names[i]))
            lsf_log(LSF_LOG_WARNING, "--%s: has no effect on the reference", names[i]);
}

static bool load(reference_job *job, lsf_error *error)
{
    job->scene = lsf_tool_load_scene(job->settings, job->scene_path, &job->load_seconds, error);
    return job->scene != NULL;
}

static bool trace(reference_job *job, lsf_error *error)
{
    job->half_count = job->settings->halves ? 2 : 1;
    lsf_render_params params = lsf_settings_render_params(job->settings);
    params.time_limit /= job->half_count;
    params.progress = lsf_interrupt_progress;
    params.progress_user = &job->bar;
    lsf_interrupt_begin_iterations();
    bool good = true;
    for (uint32_t half = 0; good && half < job->half_count && !lsf_interrupted(); half++) {
        const char *label = job->half_count == 1 ? "reference" : half ? "half b" : "half a";
        lsf_progress_bar_start(&job->bar, label, params.samples, params.time_limit);
        job->halves[half] =
            lsf_reference_render(job->scene, &params, half, &job->results[half], error);
        good = job->halves[half] != NULL;
    }
    lsf_interrupt_end_iterations();
    lsf_progress_bar_clear();
    return good;
}

/* The mean, each half weighed by its samples; depth belongs to one surface and is taken from the
 * first half, as it is from the first iteration in a rendering. */
static bool take_mean(reference_job *job, lsf_error *error)
{
    const lsf_image *a = job->halves[0], *b = job->halves[1];
    const char **names = lsf_alloc(a->channel_count, sizeof *names);
    if (!names)
        return lsf_error_set(error, LSF_ERROR_RENDER, "%s: no memory left", job->destination->path);
    for (uint32_t c = 0; c < a->channel_count; c++)
        names[c] = a->channel_names[c];
    job->mean = lsf_image_create(a->width, a->height, a->channel_count, names, error);
    free((void *)names);
    if (!job->mean)
        return false;
    double samples = (double)job->results[0].samples + job->results[1].samples;
    double weight = job->results[1].samples / samples;
    int depth = lsf_image_channel(a, "depth.Z");
    size_t count = (size_t)a->width * a->height * a->channel_count;
    for (size_t i = 0; i < count; i++) {
        bool keep = depth >= 0 && i % a->channel_count == (size_t)depth;
        job->mean->pixels[i] =
            keep ? a->pixels[i]
                 : (float)((1 - weight) * (double)a->pixels[i] + weight * (double)b->pixels[i]);
    }
    return true;
}

/* `half` as in lsf_destination_save. */
static bool save_one(reference_job *job, int half, const lsf_image *image, uint32_t samples,
                     lsf_error *error)
{
    lsf_imprint imprint;
    bool good =
        lsf_imprint_make(&imprint, job->settings, job->scene_path, TECHNIQUE,
                         lsf_summary_bounces(job->settings, job->scene), samples, NULL, error) &&
        lsf_destination_save(job->destination, half, image, &imprint, error);
    lsf_imprint_finish(&imprint);
    return good;
}

static bool save(reference_job *job, lsf_error *error)
{
    const lsf_reference_result *a = &job->results[0], *b = &job->results[1];
    if (!lsf_interrupt_may_save(a->samples + b->samples, error))
        return false;
    double start = lsf_now();
    bool good;
    if (job->half_count == 2 && b->samples > 0) {
        good = take_mean(job, error);
        if (good)
            lsf_destination_expose(job->destination, job->mean);
        good = good && save_one(job, 0, job->halves[0], a->samples, error) &&
               save_one(job, 1, job->halves[1], b->samples, error) &&
               save_one(job, -1, job->mean, a->samples + b->samples, error);
    } else {
        lsf_destination_expose(job->destination, job->halves[0]);
        good = save_one(job, -1, job->halves[0], a->samples, error);
        if (good && job->half_count == 2)
            good = lsf_error_set(error, LSF_ERROR_RENDER,
                                 "interrupted before the second half: %s holds the first, and no "
                                 "halves were written",
                                 job->destination->path);
    }
    job->save_seconds = lsf_now() - start;
    return good;
}

static void report(const reference_job *job, lsf_json *json)
{
    const lsf_reference_result *a = &job->results[0], *b = &job->results[1];
    double total = lsf_now() - job->start;
    const lsf_summary_seconds seconds[] = {
        {"load", job->load_seconds},
        {"build", a->build_seconds + b->build_seconds},
        {"render", a->render_seconds + b->render_seconds},
        {"save", job->save_seconds},
        {"total", total},
    };
    uint32_t samples = a->samples + b->samples;
    uint32_t bounces = lsf_summary_bounces(job->settings, job->scene);
    lsf_report_line("%s: %ux%u, %u sample%s%s, %u bounce%s, traced in %.2f s of %.2f s, %.1f "
                    "million rays",
                    job->destination->path, job->halves[0]->width, job->halves[0]->height, samples,
                    lsf_plural(samples), lsf_interrupted() ? " (interrupted)" : "", bounces,
                    lsf_plural(bounces), a->render_seconds + b->render_seconds, total,
                    1e-6 * (double)(a->rays + b->rays));
    lsf_summary summary = {
        .settings = job->settings,
        .scene = job->scene,
        .scene_path = job->scene_path,
        .output = job->destination->path,
        .half_paths = job->mean ? (const char *const *)job->destination->half_paths : NULL,
        .technique = TECHNIQUE,
        .bounces = bounces,
        .samples = samples,
        .interrupted = lsf_interrupted(),
        .exposure = job->destination->exposure,
        .seconds = seconds,
        .seconds_count = LSF_COUNT(seconds),
        .rays = a->rays + b->rays,
    };
    lsf_summary_add(json, &summary);
}

/* What the scenes of a run share. */
typedef struct reference_run {
    lsf_settings settings;
    lsf_destination *destinations;
    double start; /* of what has not been counted for a scene before */
} reference_run;

static bool trace_scene(void *user, uint32_t index, const char *path, lsf_json *json,
                        lsf_error *error)
{
    reference_run *run = user;
    reference_job job = {.settings = &run->settings,
                         .destination = &run->destinations[index],
                         .scene_path = path,
                         .start = run->start};
    bool good = load(&job, error) && trace(&job, error) && save(&job, error);
    if (good)
        report(&job, json);
    lsf_image_destroy(job.halves[0]);
    lsf_image_destroy(job.halves[1]);
    lsf_image_destroy(job.mean);
    lsf_scene_destroy(job.scene);
    run->start = lsf_now();
    return good;
}

int lsf_tool_reference(int argc, char **argv)
{
    reference_run run = {.start = lsf_now()};
    lsf_error error;
    int status = lsf_tool_begin(&run.settings, LSF_COMMAND_REFERENCE, argc, argv);
    if (status == LSF_GO_ON) {
        uint32_t count = lsf_tool_scene_count(&run.settings);
        warn_of_options_without_effect(&run.settings);
        run.destinations = lsf_destinations_create(&run.settings, count, &error);
        status = run.destinations ? lsf_tool_for_each_scene(&run.settings, trace_scene, &run)
                                  : lsf_report_error(&error);
        lsf_destinations_destroy(run.destinations, count);
    }
    lsf_settings_finish(&run.settings);
    return status;
}
