#include "sweep/run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "sweep/errors.h"
#include "sweep/stopwatch.h"

/* One point in progress. */
typedef struct point_run {
    const lsf_sweep_stage *stage;
    const lsf_configuration *configuration;
    lsf_measured_point *point;
    lsf_image *pictures[LSF_SWEEP_MAX_SEEDS];
    const char **options;
    uint32_t done; /* iterations of the frame */
    bool stopped;
} point_run;

static bool follow_progress(uint32_t done, uint32_t total, void *user)
{
    (void)total;
    point_run *run = user;
    const lsf_sweep_stage *stage = run->stage;
    for (; run->done < done; run->done++)
        if (stage->advance)
            stage->advance(stage->user);
    run->stopped = run->stopped || (stage->go_on && !stage->go_on(stage->user));
    return !run->stopped;
}

static bool list_options(point_run *run, lsf_error *error)
{
    const lsf_render_params *base = &run->stage->params;
    uint32_t count = base->option_count + run->configuration->option_count;
    run->options = lsf_alloc((uint64_t)count + 1, sizeof *run->options);
    if (!run->options)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    for (uint32_t i = 0; i < base->option_count; i++)
        run->options[i] = base->options[i];
    for (uint32_t i = 0; i < run->configuration->option_count; i++)
        run->options[base->option_count + i] = run->configuration->options[i];
    return true;
}

/* Renders a frame that is not timed, then the timed one: lsf_renderer_run waits until it is
 * done. */
static bool time_frame(point_run *run, lsf_renderer *renderer, double *milliseconds,
                       lsf_error *error)
{
    const lsf_frame frame = {LSF_FRAME_DEFAULTS, .time = run->stage->params.time, .cut = true};
    if (!lsf_renderer_iterate(renderer, error) || !lsf_renderer_texture(renderer, 0, error))
        return false;
    lsf_renderer_get_stats(renderer); /* which waits */
    run->done = 0;
    lsf_stopwatch watch = lsf_stopwatch_start(run->stage->clock, renderer);
    bool good =
        lsf_renderer_begin_frame(renderer, &frame, error) && lsf_renderer_run(renderer, error);
    lsf_measured_point *first = run->point->pass_count == 0 ? run->point : NULL;
    *milliseconds = lsf_stopwatch_stop(&watch, renderer, first);
    return good;
}

static bool render(point_run *run, uint32_t seed, uint32_t samples, lsf_error *error)
{
    const lsf_sweep_stage *stage = run->stage;
    lsf_render_params params = stage->params;
    lsf_measured_seed *measured = &run->point->seeds[seed];
    params.technique = run->configuration->technique;
    params.options = run->options;
    params.option_count = stage->params.option_count + run->configuration->option_count;
    params.samples = samples;
    params.seed = measured->seed = stage->params.seed + seed;
    params.progress = follow_progress;
    params.progress_user = run;
    lsf_context_restart_peak(stage->context);
    lsf_renderer *renderer = lsf_renderer_create(stage->context, stage->scene, &params, error);
    bool good = renderer && time_frame(run, renderer, &measured->milliseconds, error);
    if (good && !run->stopped)
        good = (run->pictures[seed] = lsf_renderer_read(renderer, error)) != NULL;
    lsf_context_info device = lsf_context_get_info(stage->context);
    if (device.gl_bytes_peak > run->point->gl_bytes_peak)
        run->point->gl_bytes_peak = device.gl_bytes_peak;
    run->point->gl_bytes = renderer ? lsf_plan_bytes(lsf_renderer_plan(renderer)) : 0;
    lsf_renderer_destroy(renderer);
    return good && lsf_context_check(stage->context, error);
}

static bool compare(point_run *run, uint32_t seed, lsf_error *error)
{
    const lsf_sweep_stage *stage = run->stage;
    lsf_measured_seed *measured = &run->point->seeds[seed];
    lsf_compare_params params = {LSF_COMPARE_PARAMS_DEFAULTS};
    lsf_compare_result result;
    params.reference_b = stage->halves[1];
    params.exposure = stage->exposure;
    params.flip = true;
    if (!lsf_compare(run->pictures[seed], stage->halves[0], &params, &result, error))
        return false;
    memcpy(measured->bias, result.bias, sizeof measured->bias);
    measured->ssim = result.ssim;
    measured->psnr = result.psnr;
    measured->flip = result.flip;
    measured->flip_hdr = result.flip_hdr;
    measured->non_finite = result.non_finite_test;
    return true;
}

/* The name is made of folder, technique, options and samples; characters that a shell or a URL
 * would interpret become dashes. */
static char *picture_path(const point_run *run, const char *ending)
{
    lsf_string text = {0};
    lsf_string_add(&text, "%s/", run->stage->folder);
    size_t folder = text.length;
    lsf_string_add(&text, "%s", run->configuration->technique);
    for (uint32_t i = 0; i < run->configuration->option_count; i++)
        lsf_string_add(&text, "_%s", run->configuration->options[i]);
    lsf_string_add(&text, "_%u", run->point->samples);
    for (char *c = text.text ? text.text + folder : NULL; c && *c; c++)
        if (!strchr("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.", *c))
            *c = '-';
    lsf_string_add(&text, "%s", ending);
    return text.text;
}

static bool save(point_run *run, lsf_error *error)
{
    lsf_image_save_params params = {LSF_IMAGE_SAVE_PARAMS_DEFAULTS};
    params.exposure = run->stage->exposure;
    if (!run->stage->folder)
        return true;
    run->point->picture = picture_path(run, ".exr");
    run->point->preview = picture_path(run, ".png");
    if (!run->point->picture || !run->point->preview)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    return lsf_image_save(run->pictures[0], run->point->picture, &params, error) &&
           lsf_image_save(run->pictures[0], run->point->preview, &params, error);
}

static bool measure(point_run *run, lsf_error *error)
{
    const lsf_image *a = run->stage->halves[0], *b = run->stage->halves[1];
    lsf_reference_halves halves = {a->width, a->height, {a->pixels, b->pixels}, 0, {0}, 0};
    bool good = true;
    lsf_reference_halves_derive(&halves);
    lsf_errors_measure(&halves, (const lsf_image *const *)run->pictures, run->point->seed_count,
                       &run->point->mse, &run->point->relmse);
    for (uint32_t s = 0; good && s < run->point->seed_count; s++)
        good = compare(run, s, error);
    return good && save(run, error);
}

bool lsf_sweep_run_point(const lsf_sweep_stage *stage, lsf_measurement *measurement,
                         uint32_t configuration, uint32_t samples, uint32_t seeds, bool *stopped,
                         lsf_error *error)
{
    point_run run = {.stage = stage,
                     .configuration = &measurement->configurations[configuration],
                     .point = lsf_measurement_add_point(measurement)};
    if (!run.point)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    run.point->configuration = configuration;
    run.point->samples = samples;
    run.point->seed_count = seeds;
    bool good = list_options(&run, error);
    for (uint32_t s = 0; good && !run.stopped && s < seeds; s++)
        good = render(&run, s, samples, error);
    good = good && (run.stopped || measure(&run, error));
    for (uint32_t s = 0; s < seeds; s++)
        lsf_image_destroy(run.pictures[s]);
    free((void *)run.options);
    if (!good || run.stopped)
        lsf_measurement_drop_point(measurement, run.point);
    else
        lsf_measured_point_derive(run.point);
    *stopped = run.stopped;
    return good;
}
