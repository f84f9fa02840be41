#include "sweep/stopwatch.h"

#include <stdio.h>
#include <time.h>

#include "base/base.h"

static double now(lsf_clock clock)
{
    struct timespec time;
    if (clock != LSF_CLOCK_PROCESSOR)
        return lsf_now();
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time); /* of all threads */
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* The milliseconds of all passes that have finished since the last call. */
static double poll(lsf_renderer *renderer, lsf_measured_point *point)
{
    const lsf_pass_time *times;
    double sum = 0.0;
    uint32_t count = lsf_renderer_poll_times(renderer, &times);
    for (uint32_t i = 0; i < count; i++) {
        sum += times[i].milliseconds;
        if (!point || times[i].runs == 0 || point->pass_count == LSF_SWEEP_MAX_PASSES)
            continue;
        lsf_measured_pass *pass = &point->passes[point->pass_count++];
        *pass = (lsf_measured_pass){.runs = times[i].runs,
                                    .milliseconds = times[i].milliseconds / point->samples};
        snprintf(pass->name, sizeof pass->name, "%s", times[i].name);
    }
    return sum;
}

lsf_stopwatch lsf_stopwatch_start(lsf_clock clock, lsf_renderer *renderer)
{
    poll(renderer, NULL);
    return (lsf_stopwatch){clock, now(clock)};
}

double lsf_stopwatch_stop(const lsf_stopwatch *watch, lsf_renderer *renderer,
                          lsf_measured_point *point)
{
    double taken = 1e3 * (now(watch->clock) - watch->start), of_passes = poll(renderer, point);
    return watch->clock == LSF_CLOCK_GPU ? of_passes : taken;
}
