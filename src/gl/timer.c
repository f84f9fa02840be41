#include "gl/context.h"

#include <stdlib.h>
#include <string.h>

/* The most runs whose timestamps may be pending. A GPU lags a few frames behind; only a caller
 * that queues this many runs of one timer without a pause waits for the oldest. */
#define PENDING_MAX 64

struct lsf_timer {
    lsf_context *context;
    char *name;
    bool running;
    uint64_t runs;
    double seconds;
    uint64_t polled_runs; /* runs that lsf_timer_poll has reported */
    double polled_seconds;
    double start;                   /* software: lsf_now() */
    GLuint queries[PENDING_MAX][2]; /* GPU: timestamps at begin and end, a ring */
    uint32_t first_pending, pending_count;
};

lsf_timer *lsf_timer_create(lsf_context *context, const char *name, lsf_error *error)
{
    if (!lsf_memory_begin(context, name, error))
        return NULL;
    lsf_timer *timer = lsf_alloc(1, sizeof *timer);
    if (timer)
        timer->name = strdup(name);
    if (timer && !context->software)
        glCreateQueries(GL_TIMESTAMP, 2 * PENDING_MAX, &timer->queries[0][0]);
    bool made = lsf_memory_end(context, GL_QUERY, 0, 0, name, error);
    if (!timer || !timer->name)
        made = lsf_error_set(error, LSF_ERROR_RENDER, "timer %s: out of memory", name);
    if (timer)
        timer->context = context;
    if (!made) {
        lsf_timer_destroy(timer);
        return NULL;
    }
    return timer;
}

void lsf_timer_destroy(lsf_timer *timer)
{
    if (!timer)
        return;
    if (!timer->context->software)
        glDeleteQueries(2 * PENDING_MAX, &timer->queries[0][0]);
    free(timer->name);
    free(timer);
}

/* Adds the oldest pending run; false when its result has not arrived and `wait` is not set. */
static bool collect_oldest(lsf_timer *timer, bool wait)
{
    const GLuint *pair = timer->queries[timer->first_pending];
    GLuint64 begin = 0, end = 0;
    GLint available = GL_FALSE;
    if (!wait)
        glGetQueryObjectiv(pair[1], GL_QUERY_RESULT_AVAILABLE, &available);
    if (!wait && !available)
        return false;
    glGetQueryObjectui64v(pair[0], GL_QUERY_RESULT, &begin);
    glGetQueryObjectui64v(pair[1], GL_QUERY_RESULT, &end);
    timer->seconds += end > begin ? (double)(end - begin) * 1e-9 : 0.0;
    timer->runs++;
    timer->first_pending = (timer->first_pending + 1) % PENDING_MAX;
    timer->pending_count--;
    return true;
}

void lsf_timer_begin(lsf_timer *timer)
{
    if (timer->running)
        return;
    timer->running = true;
    lsf_debug_push_group(timer->context, timer->name);
    if (timer->context->software) {
        /* llvmpipe draws on worker threads long after the call: only glFinish bounds its work. */
        glFinish();
        timer->start = lsf_now();
        return;
    }
    while (timer->pending_count && collect_oldest(timer, timer->pending_count == PENDING_MAX))
        ;
    uint32_t slot = (timer->first_pending + timer->pending_count) % PENDING_MAX;
    glQueryCounter(timer->queries[slot][0], GL_TIMESTAMP);
}

void lsf_timer_end(lsf_timer *timer)
{
    if (!timer->running)
        return;
    timer->running = false;
    if (timer->context->software) {
        glFinish();
        timer->seconds += lsf_now() - timer->start;
        timer->runs++;
    } else {
        uint32_t slot = (timer->first_pending + timer->pending_count) % PENDING_MAX;
        glQueryCounter(timer->queries[slot][1], GL_TIMESTAMP);
        timer->pending_count++;
    }
    lsf_debug_pop_group(timer->context);
}

static void collect_all(lsf_timer *timer)
{
    while (timer->pending_count)
        collect_oldest(timer, true);
}

uint64_t lsf_timer_runs(lsf_timer *timer)
{
    collect_all(timer);
    return timer->runs;
}

double lsf_timer_milliseconds(lsf_timer *timer)
{
    collect_all(timer);
    return timer->seconds * 1e3;
}

uint64_t lsf_timer_poll(lsf_timer *timer, double *milliseconds)
{
    while (timer->pending_count && collect_oldest(timer, false))
        ;
    uint64_t runs = timer->runs - timer->polled_runs;
    *milliseconds = (timer->seconds - timer->polled_seconds) * 1e3;
    timer->polled_runs = timer->runs;
    timer->polled_seconds = timer->seconds;
    return runs;
}

const char *lsf_timer_name(const lsf_timer *timer)
{
    return timer->name;
}
