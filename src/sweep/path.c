#include "sweep/path.h"

#include <math.h>
#include <stdlib.h>

#include "base/base.h"
#include "sweep/errors.h"
#include "sweep/statistics.h"
#include "sweep/stopwatch.h"

/* --- pictures --- */

static double value_at(const lsf_image *image, uint64_t pixel, uint64_t channel)
{
    return image->pixels[pixel * image->channel_count + channel];
}

static double epsilon_of(const lsf_image *const halves[2])
{
    lsf_reference_halves reference = {.width = halves[0]->width,
                                      .height = halves[0]->height,
                                      .halves = {halves[0]->pixels, halves[1]->pixels}};
    lsf_reference_halves_derive(&reference);
    return reference.epsilon;
}

static double weight_at(const lsf_image *const halves[2], uint64_t pixel, uint64_t channel,
                        double epsilon)
{
    double r = 0.5 * (value_at(halves[0], pixel, channel) + value_at(halves[1], pixel, channel));
    return 1.0 / (r * r + epsilon);
}

lsf_path_change lsf_path_change_of(const lsf_image *now, const lsf_image *before,
                                   const lsf_image *const halves_now[2],
                                   const lsf_image *const halves_before[2])
{
    double epsilon = epsilon_of(halves_now), difference = 0.0, motion = 0.0, values = 0.0;
    for (uint64_t i = 0; i < (uint64_t)now->width * now->height; i++)
        for (uint64_t c = 0; c < 3; c++) {
            double w = weight_at(halves_now, i, c, epsilon);
            double x = value_at(now, i, c) - value_at(before, i, c);
            double a = value_at(halves_now[0], i, c) - value_at(halves_before[0], i, c);
            double b = value_at(halves_now[1], i, c) - value_at(halves_before[1], i, c);
            if (!isfinite(w * x * a * b))
                continue;
            difference += w * (x - a) * (x - b);
            motion += w * a * b;
            values += 1.0;
        }
    return (lsf_path_change){difference / values, motion / values};
}

double lsf_path_flicker_of(const lsf_image *x, const lsf_image *y, const lsf_image *const halves[2])
{
    double epsilon = epsilon_of(halves), sum = 0.0, values = 0.0;
    for (uint64_t i = 0; i < (uint64_t)x->width * x->height; i++)
        for (uint64_t c = 0; c < 3; c++) {
            double change = value_at(x, i, c) - value_at(y, i, c);
            double term = weight_at(halves, i, c, epsilon) * change * change;
            if (!isfinite(term))
                continue;
            sum += term;
            values += 1.0;
        }
    return sum / values;
}

/* --- rendering --- */

typedef struct path_run {
    const lsf_sweep_stage *stage;
    lsf_measured_point *point;
    const lsf_path_frame *frames;
    uint32_t count, done;
    lsf_renderer *renderer;
    double *milliseconds; /* of all frames of the path, all seeds */
    bool stopped;
} path_run;

static bool follow_progress(uint32_t done, uint32_t total, void *user)
{
    (void)total;
    path_run *run = user;
    for (; run->done < done; run->done++)
        if (run->stage->advance)
            run->stage->advance(run->stage->user);
    run->stopped = run->stopped || (run->stage->go_on && !run->stage->go_on(run->stage->user));
    return !run->stopped;
}

static bool start(path_run *run, const lsf_configuration *configuration, uint32_t seed,
                  bool temporal, lsf_error *error)
{
    const char *options[2 * LSF_SWEEP_MAX_OPTIONS + 64];
    lsf_render_params params = run->stage->params;
    uint32_t count = 0;
    if (params.option_count + configuration->option_count > LSF_COUNT(options))
        return lsf_error_set(error, LSF_ERROR_USAGE, "--define: too many for a path of frames");
    for (uint32_t i = 0; i < params.option_count; i++)
        options[count++] = params.options[i];
    for (uint32_t i = 0; i < configuration->option_count; i++)
        options[count++] = configuration->options[i];
    params.technique = configuration->technique;
    params.options = options;
    params.option_count = count;
    params.samples = run->point->samples;
    params.seed += seed;
    params.temporal = temporal;
    params.progress = follow_progress;
    params.progress_user = run;
    run->renderer = lsf_renderer_create(run->stage->context, run->stage->scene, &params, error);
    return run->renderer && lsf_renderer_iterate(run->renderer, error) &&
           lsf_renderer_texture(run->renderer, 0, error) != 0;
}

/* The picture of a frame; `number` selects its random numbers. NULL when stopped, too. */
static lsf_image *render(path_run *run, const lsf_path_frame *at, uint32_t number, bool cut,
                         double *milliseconds, lsf_error *error)
{
    const lsf_frame frame = {.time = at->time,
                             .view = &at->view,
                             .first_sample = number * run->point->samples,
                             .cut = cut};
    run->done = 0;
    lsf_stopwatch watch = lsf_stopwatch_start(run->stage->clock, run->renderer);
    bool good = lsf_renderer_begin_frame(run->renderer, &frame, error) &&
                lsf_renderer_run(run->renderer, error);
    *milliseconds = lsf_stopwatch_stop(&watch, run->renderer, NULL);
    return good && !run->stopped ? lsf_renderer_read(run->renderer, error) : NULL;
}

/* Along the path: mean error, and mean error of the changes. */
static bool follow(path_run *run, uint32_t seed, double *relmse, lsf_path_change *change,
                   lsf_error *error)
{
    lsf_image *before = NULL, *now = NULL;
    bool good = true;
    *relmse = 0.0;
    *change = (lsf_path_change){0.0, 0.0};
    for (uint32_t f = 0; good && f < run->count; f++) {
        const lsf_path_frame *frame = &run->frames[f];
        now = render(run, frame, f, f == 0, &run->milliseconds[seed * run->count + f], error);
        if (!(good = now != NULL))
            break;
        lsf_reference_halves halves = {
            .width = now->width,
            .height = now->height,
            .halves = {frame->halves[0]->pixels, frame->halves[1]->pixels}};
        lsf_squared_error mse, relative;
        const lsf_image *const pictures[] = {now};
        lsf_reference_halves_derive(&halves);
        lsf_errors_measure(&halves, pictures, 1, &mse, &relative);
        *relmse += relative.products[0][0] / run->count;
        if (before) {
            lsf_path_change step =
                lsf_path_change_of(now, before, frame->halves, run->frames[f - 1].halves);
            change->difference += step.difference / (run->count - 1);
            change->motion += step.motion / (run->count - 1);
        }
        lsf_image_destroy(before);
        before = now;
    }
    lsf_image_destroy(before);
    return good;
}

/* With a still camera: mean change. */
static bool stay(path_run *run, double *flicker, lsf_error *error)
{
    lsf_image *before = NULL, *now = NULL;
    bool good = true;
    double milliseconds;
    *flicker = 0.0;
    for (uint32_t f = 0; good && f < run->count; f++) {
        now = render(run, &run->frames[0], run->count + f, f == 0, &milliseconds, error);
        if (!(good = now != NULL))
            break;
        if (before)
            *flicker += lsf_path_flicker_of(now, before, run->frames[0].halves) / (run->count - 1);
        lsf_image_destroy(before);
        before = now;
    }
    lsf_image_destroy(before);
    return good;
}

bool lsf_sweep_run_path(const lsf_sweep_stage *stage, lsf_measurement *measurement,
                        lsf_measured_point *point, const lsf_path_frame *frames, uint32_t count,
                        bool temporal, bool *stopped, lsf_error *error)
{
    double relmse[LSF_SWEEP_MAX_SEEDS] = {0}, difference[LSF_SWEEP_MAX_SEEDS] = {0},
           flicker[LSF_SWEEP_MAX_SEEDS] = {0};
    lsf_path_change change = {NAN, NAN};
    path_run run = {.stage = stage, .point = point, .frames = frames, .count = count};
    run.milliseconds = lsf_alloc((uint64_t)count * point->seed_count, sizeof *run.milliseconds);
    bool good = run.milliseconds || lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    for (uint32_t s = 0; good && !run.stopped && s < point->seed_count; s++) {
        good =
            start(&run, &measurement->configurations[point->configuration], s, temporal, error) &&
            follow(&run, s, &relmse[s], &change, error) && stay(&run, &flicker[s], error);
        difference[s] = change.difference;
        lsf_renderer_destroy(run.renderer);
        run.renderer = NULL;
    }
    if (good)
        point->path = (lsf_measured_path){
            .frames = count,
            .temporal = temporal,
            .milliseconds = lsf_quartiles_of(run.milliseconds, (size_t)count * point->seed_count),
            .relmse = lsf_mean_of(relmse, point->seed_count, 0.0),
            .difference = lsf_mean_of(difference, point->seed_count, 0.0),
            .flicker = lsf_mean_of(flicker, point->seed_count, 0.0),
            .motion = change.motion};
    free(run.milliseconds);
    *stopped = run.stopped;
    return good || run.stopped;
}
