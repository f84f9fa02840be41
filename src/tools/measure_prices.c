/* What a frame takes with and without each feature of the scene. */
#include "tools/measure.h"

#include <math.h>

#include "sweep/statistics.h"
#include "sweep/stopwatch.h"
#include "tools/interrupt.h"

enum { FRAMES = 9 }; /* of each, in turn with the other's, so that both see the same machine */

static bool time_frame(const lsf_measure_job *job, lsf_renderer *renderer, double *milliseconds,
                       lsf_error *error)
{
    const lsf_frame frame = {LSF_FRAME_DEFAULTS, .time = job->settings.time, .cut = true};
    lsf_stopwatch watch = lsf_stopwatch_start(job->measurement.clock, renderer);
    bool good =
        lsf_renderer_begin_frame(renderer, &frame, error) && lsf_renderer_run(renderer, error);
    *milliseconds = lsf_stopwatch_stop(&watch, renderer, NULL);
    return good;
}

/* The first frame of each does not count. */
static bool time_both(lsf_measure_job *job, lsf_renderer *const renderers[2],
                      lsf_estimate *difference, lsf_error *error)
{
    double differences[FRAMES + 1];
    for (int frame = 0; frame <= FRAMES; frame++) {
        double milliseconds[2];
        for (int half = 0; half < 2; half++) {
            int which = (half + frame) % 2; /* each comes first as often as second */
            if (!time_frame(job, renderers[which], &milliseconds[which], error))
                return false;
            lsf_progress_bar_draw(&job->bar, ++job->done, job->total);
        }
        differences[frame] = milliseconds[0] - milliseconds[1];
        if (lsf_interrupted())
            return true;
    }
    *difference = lsf_median_of(differences + 1, FRAMES);
    return true;
}

static bool time_feature(lsf_measure_job *job, const lsf_render_params *params,
                         lsf_feature_price *price, lsf_error *error)
{
    lsf_scene *without = lsf_scene_without(job->scene, price->feature, error);
    lsf_renderer *renderers[2] = {0};
    bool good = without != NULL;
    for (int i = 0; good && i < 2; i++)
        good = (renderers[i] = lsf_renderer_create(job->context, i ? without : job->scene, params,
                                                   error)) != NULL;
    good = good && time_both(job, renderers, &price->milliseconds, error);
    for (int i = 0; i < 2; i++)
        lsf_renderer_destroy(renderers[i]);
    lsf_scene_destroy(without);
    return good;
}

bool lsf_measure_prices(lsf_measure_job *job, lsf_error *error)
{
    lsf_render_params params = lsf_settings_render_params(&job->settings);
    const lsf_measurement *m = &job->measurement;
    if (!job->settings.prices || m->configuration_count == 0)
        return true;
    params.technique = m->configurations[0].technique;
    params.samples = 1;
    params.temporal = false;
    bool good = lsf_prices_make(&job->prices, job->scene, &params, error);
    job->done = 0;
    job->total = job->prices.count * 2 * (FRAMES + 1);
    lsf_progress_bar_start(&job->bar, "prices", job->total, INFINITY);
    for (uint32_t i = 0; good && i < job->prices.count && !lsf_interrupted(); i++)
        good = time_feature(job, &params, &job->prices.features[i], error);
    lsf_progress_bar_clear();
    return good;
}
