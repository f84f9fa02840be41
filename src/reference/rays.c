/* Closest hits of many rays on all cores, by the fastest of Embree's traversal functions: single
 * rays, packets of 4, 8 and 16, and streams. */
#include <embree3/rtcore.h>

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>
#if defined(__SSE__)
#include <immintrin.h>
#endif

#include "base/base.h"
#include "reference/geometry.h"
#include "reference/module.h"

#define MAX_THREADS 256u

/* Rays that a thread fetches at a time: enough to hide the cost of fetching, few enough for all
 * threads to end together. */
#define CHUNK 1024u

/* Number of times each function is tried. */
#define TRIALS 3

typedef struct trace_job {
    RTCScene tree;
    const lsf_reference_ray *rays;
    uint64_t count;
    float near;
    float *distances;
} trace_job;

typedef void (*trace_function)(const trace_job *job, uint64_t first, uint64_t end);

static struct RTCIntersectContext coherent_context(void)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

static void fill_single(const trace_job *job, uint64_t index, struct RTCRayHit *query)
{
    const lsf_reference_ray *ray = &job->rays[index];
    *query = (struct RTCRayHit){
        .ray = {.org_x = ray->origin[0],
                .org_y = ray->origin[1],
                .org_z = ray->origin[2],
                .tnear = job->near,
                .dir_x = ray->direction[0],
                .dir_y = ray->direction[1],
                .dir_z = ray->direction[2],
                .tfar = INFINITY,
                .mask = ~0u},
        .hit = {.geomID = RTC_INVALID_GEOMETRY_ID, .instID = {RTC_INVALID_GEOMETRY_ID}},
    };
}

static float distance_of(unsigned geometry, float far)
{
    return geometry == RTC_INVALID_GEOMETRY_ID ? INFINITY : far;
}

static void trace_single(const trace_job *job, uint64_t first, uint64_t end)
{
    struct RTCIntersectContext context = coherent_context();
    for (uint64_t i = first; i < end; i++) {
        struct RTCRayHit query;
        fill_single(job, i, &query);
        rtcIntersect1(job->tree, &context, &query);
        job->distances[i] = distance_of(query.hit.geomID, query.ray.tfar);
    }
}

static void trace_stream(const trace_job *job, uint64_t first, uint64_t end)
{
    struct RTCIntersectContext context = coherent_context();
    struct RTCRayHit queries[CHUNK];
    for (uint64_t i = first; i < end; i++)
        fill_single(job, i, &queries[i - first]);
    rtcIntersect1M(job->tree, &context, queries, (unsigned)(end - first), sizeof *queries);
    for (uint64_t i = first; i < end; i++)
        job->distances[i] = distance_of(queries[i - first].hit.geomID, queries[i - first].ray.tfar);
}

/* Lanes of a packet past the end repeat the last ray and are inactive. */
#define DEFINE_PACKET(N)                                                                           \
    static void trace_packet_##N(const trace_job *job, uint64_t first, uint64_t end)               \
    {                                                                                              \
        struct RTCIntersectContext context = coherent_context();                                   \
        for (; first < end; first += N) {                                                          \
            _Alignas(64) int valid[N];                                                             \
            struct RTCRayHit##N query;                                                             \
            for (uint64_t i = 0; i < N; i++) {                                                     \
                const lsf_reference_ray *ray = &job->rays[first + i < end ? first + i : end - 1];  \
                valid[i] = first + i < end ? -1 : 0;                                               \
                query.ray.org_x[i] = ray->origin[0];                                               \
                query.ray.org_y[i] = ray->origin[1];                                               \
                query.ray.org_z[i] = ray->origin[2];                                               \
                query.ray.dir_x[i] = ray->direction[0];                                            \
                query.ray.dir_y[i] = ray->direction[1];                                            \
                query.ray.dir_z[i] = ray->direction[2];                                            \
                query.ray.tnear[i] = job->near;                                                    \
                query.ray.tfar[i] = INFINITY;                                                      \
                query.ray.time[i] = 0.0f;                                                          \
                query.ray.mask[i] = ~0u;                                                           \
                query.ray.flags[i] = 0;                                                            \
                query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;                                     \
                query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;                                  \
            }                                                                                      \
            rtcIntersect##N(valid, job->tree, &context, &query);                                   \
            for (uint64_t i = 0; i < N && first + i < end; i++)                                    \
                job->distances[first + i] = distance_of(query.hit.geomID[i], query.ray.tfar[i]);   \
        }                                                                                          \
    }
DEFINE_PACKET(4)
DEFINE_PACKET(8)
DEFINE_PACKET(16)

static const struct {
    const char *name;
    trace_function trace;
} kernels[] = {
    {"rtcIntersect1", trace_single},   {"rtcIntersect4", trace_packet_4},
    {"rtcIntersect8", trace_packet_8}, {"rtcIntersect16", trace_packet_16},
    {"rtcIntersect1M", trace_stream},
};

struct lsf_reference_tracer {
    lsf_reference_geometry geometry;
    size_t kernel;
    uint64_t chosen_by; /* number of rays by which it was chosen; 0: not yet */
};

/* --- threads */

typedef struct work {
    trace_job job;
    trace_function trace;
    atomic_ullong next;
    pthread_mutex_t gate;
    pthread_barrier_t barrier;
} work;

static void trace_chunks(work *w)
{
    for (;;) {
        uint64_t first = atomic_fetch_add(&w->next, CHUNK);
        if (first >= w->job.count)
            return;
        uint64_t end = first + CHUNK < w->job.count ? first + CHUNK : w->job.count;
        w->trace(&w->job, first, end);
    }
}

/* Denormal numbers are slow and do not affect hits; Embree's manual recommends to flush them. */
static unsigned flush_denormals(void)
{
#if defined(__SSE__)
    unsigned before = _mm_getcsr();
    _mm_setcsr(before | 0x8040u);
    return before;
#else
    return 0;
#endif
}

static void restore_denormals(unsigned before)
{
#if defined(__SSE__)
    _mm_setcsr(before);
#else
    (void)before;
#endif
}

static void *worker(void *argument)
{
    work *w = argument;
    flush_denormals();
    pthread_mutex_lock(&w->gate);
    pthread_mutex_unlock(&w->gate);
    pthread_barrier_wait(&w->barrier);
    trace_chunks(w);
    pthread_barrier_wait(&w->barrier);
    return NULL;
}

/* Seconds from the moment when all threads run to the end of the last ray. */
static double run(const trace_job *job, trace_function trace)
{
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    uint32_t wanted = cores < 1 ? 1u : cores > (long)MAX_THREADS ? MAX_THREADS : (uint32_t)cores;
    pthread_t threads[MAX_THREADS];
    uint32_t started = 0;
    work w = {.job = *job, .trace = trace};
    /* The gate holds the threads until it is known how many the barrier must count. */
    pthread_mutex_init(&w.gate, NULL);
    pthread_mutex_lock(&w.gate);
    while (started + 1 < wanted && pthread_create(&threads[started], NULL, worker, &w) == 0)
        started++;
    pthread_barrier_init(&w.barrier, NULL, started + 1);
    pthread_mutex_unlock(&w.gate);
    unsigned state = flush_denormals();
    pthread_barrier_wait(&w.barrier);
    double start = lsf_now();
    trace_chunks(&w);
    pthread_barrier_wait(&w.barrier);
    double seconds = lsf_now() - start;
    restore_denormals(state);
    for (uint32_t i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
    pthread_barrier_destroy(&w.barrier);
    pthread_mutex_destroy(&w.gate);
    return seconds;
}

/* --- functions of the module */

static lsf_reference_tracer *create(const lsf_scene *scene, const lsf_state *state,
                                    lsf_error *error)
{
    lsf_reference_tracer *tracer = lsf_alloc(1, sizeof *tracer);
    if (tracer == NULL) {
        lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
        return NULL;
    }
    if (!lsf_reference_geometry_init(&tracer->geometry, scene, state, LSF_REFERENCE_USE_SPEED,
                                     error)) {
        free(tracer);
        return NULL;
    }
    return tracer;
}

static void destroy(lsf_reference_tracer *tracer)
{
    if (tracer != NULL)
        lsf_reference_geometry_finish(&tracer->geometry);
    free(tracer);
}

static void choose_kernel(lsf_reference_tracer *tracer, const trace_job *job)
{
    double best = INFINITY;
    for (size_t k = 0; k < LSF_COUNT(kernels); k++)
        for (int trial = 0; trial < TRIALS; trial++) {
            double seconds = run(job, kernels[k].trace);
            if (seconds < best) {
                best = seconds;
                tracer->kernel = k;
            }
        }
    tracer->chosen_by = job->count;
}

static bool trace(lsf_reference_tracer *tracer, const lsf_reference_ray *rays, uint64_t count,
                  float near, float *distances, double *seconds, lsf_error *error)
{
    trace_job job = {tracer->geometry.tree, rays, count, near, distances};
    if (count > tracer->chosen_by)
        choose_kernel(tracer, &job);
    *seconds = run(&job, kernels[tracer->kernel].trace);
    if (rtcGetDeviceError(tracer->geometry.device) == RTC_ERROR_NONE)
        return true;
    return lsf_error_set(error, LSF_ERROR_RENDER, "Embree cannot trace these rays");
}

static const char *kernel(const lsf_reference_tracer *tracer)
{
    return kernels[tracer->kernel].name;
}

const lsf_reference_ray_functions lsf_reference_module_rays = {create, destroy, trace, kernel};
