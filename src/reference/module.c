/* The module's entry: passes of samples over the picture, on several threads. */
#include "reference/module.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/base.h"
#include "math/sampling.h"
#include "reference/path.h"

#define TILE 16u
#define MAX_THREADS 256u

/* Least number of paths in a pass, because threads synchronise after each, which would slow down
 * small pictures. */
#define PATHS_PER_PASS 16384u

/* Seconds between two calls that ask whether a long pass should continue. */
#define QUESTION_EVERY 0.1

/* Sums of a pixel, in double precision, because float sums stall beyond 2^24 samples. */
typedef struct pixel_sum {
    double emission[3], direct[3], indirect_diffuse[3], indirect_specular[3];
    uint32_t taken;   /* samples; in a pass that is broken off, pixels differ */
    uint32_t covered; /* samples that hit a surface */
} pixel_sum;

typedef struct guide_sum {
    double albedo[3], normal[3];
    float depth;
} guide_sum;

typedef struct render {
    const lsf_reference_job *job;
    lsf_reference_world world;
    pixel_sum *sums;
    guide_sum *guides; /* NULL unless albedo, normal or depth are asked for */
    uint32_t first_sample, pass_samples;
    uint32_t tiles_x, tile_count;
    bool done;
    double deadline, next_question; /* in seconds as lsf_now counts them */
    atomic_bool stopped;            /* the pass is broken off */
    atomic_uint next_tile;
    atomic_ullong rays;
    pthread_mutex_t gate;
    pthread_barrier_t barrier;
} render;

static void add(double sum[3], lsf_float3 value)
{
    sum[0] += value.x;
    sum[1] += value.y;
    sum[2] += value.z;
}

static uint64_t pixel_seed(const lsf_reference_job *job, uint64_t pixel)
{
    uint64_t picture = lsf_hash64(job->params->seed ^ lsf_hash64(1u + job->half));
    return lsf_hash64(picture ^ lsf_hash64(pixel + 0x9e3779b97f4a7c15u));
}

static uint64_t render_pixel(render *r, uint32_t x, uint32_t y)
{
    const lsf_render_params *params = r->job->params;
    uint64_t pixel = (uint64_t)y * params->width + x;
    lsf_reference_sampler sampler = {.pixel_seed = pixel_seed(r->job, pixel)};
    uint64_t rays = 0;
    for (uint32_t s = 0; s < r->pass_samples; s++) {
        sampler.index = r->first_sample + s;
        float u[2];
        lsf_reference_pixel_sample(&sampler, u);
        float ndc[2] = {2.0f * ((float)x + u[0]) / (float)params->width - 1.0f,
                        1.0f - 2.0f * ((float)y + u[1]) / (float)params->height};
        lsf_reference_path path;
        lsf_reference_trace_path(&r->world, ndc, &sampler, &path);
        rays += path.rays;
        add(r->sums[pixel].emission, path.emission);
        add(r->sums[pixel].direct, path.direct);
        add(r->sums[pixel].indirect_diffuse, path.indirect_diffuse);
        add(r->sums[pixel].indirect_specular, path.indirect_specular);
        r->sums[pixel].taken++;
        r->sums[pixel].covered += isfinite(path.depth);
        if (r->guides != NULL) {
            add(r->guides[pixel].albedo, path.albedo);
            add(r->guides[pixel].normal, path.normal);
            if (sampler.index == 0)
                r->guides[pixel].depth = path.depth;
        }
    }
    return rays;
}

/* The time limit does not end the first pass: a late picture is better than none. */
static void ask(render *r)
{
    const lsf_render_params *params = r->job->params;
    double now = lsf_now();
    if (now < r->next_question)
        return;
    r->next_question = now + QUESTION_EVERY;
    if ((r->first_sample > 0 && now >= r->deadline) ||
        (params->progress != NULL &&
         !params->progress(r->first_sample, params->samples, params->progress_user)))
        atomic_store(&r->stopped, true);
}

/* Only the caller's own thread calls back. */
static void render_tiles(render *r, bool asks)
{
    const lsf_render_params *params = r->job->params;
    uint64_t rays = 0;
    for (;;) {
        uint32_t tile = atomic_fetch_add(&r->next_tile, 1u);
        if (tile >= r->tile_count)
            break;
        uint32_t x0 = tile % r->tiles_x * TILE, y0 = tile / r->tiles_x * TILE;
        for (uint32_t y = y0; y < y0 + TILE && y < params->height; y++)
            for (uint32_t x = x0; x < x0 + TILE && x < params->width; x++) {
                if (asks)
                    ask(r);
                if (!atomic_load(&r->stopped))
                    rays += render_pixel(r, x, y);
            }
    }
    atomic_fetch_add(&r->rays, rays);
}

/* The barrier begins and ends every pass. In between, tiles are handed out in any order, on
 * which no pixel depends. */
static void *worker(void *argument)
{
    render *r = argument;
    pthread_mutex_lock(&r->gate);
    pthread_mutex_unlock(&r->gate);
    for (;;) {
        pthread_barrier_wait(&r->barrier);
        if (r->done)
            return NULL;
        render_tiles(r, false);
        pthread_barrier_wait(&r->barrier);
    }
}

static void run_pass(render *r)
{
    atomic_store(&r->next_tile, 0u);
    pthread_barrier_wait(&r->barrier);
    render_tiles(r, true);
    pthread_barrier_wait(&r->barrier);
}

/* Runs passes until all samples are taken, the time is up or the caller stops it. */
static void run_passes(render *r, lsf_reference_result *result)
{
    const lsf_render_params *params = r->job->params;
    uint64_t pixels = (uint64_t)params->width * params->height;
    uint32_t samples_per_pass = (uint32_t)(PATHS_PER_PASS / pixels);
    if (samples_per_pass == 0)
        samples_per_pass = 1;
    double start = lsf_now();
    uint32_t taken = 0;
    r->deadline = start + params->time_limit;
    r->next_question = start + QUESTION_EVERY;
    while (taken < params->samples) {
        uint32_t left = params->samples - taken;
        r->first_sample = taken;
        r->pass_samples = left < samples_per_pass ? left : samples_per_pass;
        run_pass(r);
        if (atomic_load(&r->stopped))
            break;
        taken += r->pass_samples;
        if (params->progress != NULL &&
            !params->progress(taken, params->samples, params->progress_user))
            break;
        if (lsf_now() >= r->deadline)
            break;
    }
    result->samples = taken;
    result->render_seconds = lsf_now() - start;
    result->rays = atomic_load(&r->rays);
}

/* Starts as many threads as it can: the picture does not depend on their number. */
static void run_threads(render *r, lsf_reference_result *result)
{
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    uint32_t wanted = r->job->threads != 0 ? r->job->threads : cores > 0 ? (uint32_t)cores : 1u;
    if (wanted > MAX_THREADS)
        wanted = MAX_THREADS;
    pthread_t threads[MAX_THREADS];
    uint32_t started = 0;
    /* The gate holds the threads until it is known how many the barrier must count. */
    pthread_mutex_init(&r->gate, NULL);
    pthread_mutex_lock(&r->gate);
    while (started + 1 < wanted && pthread_create(&threads[started], NULL, worker, r) == 0)
        started++;
    pthread_barrier_init(&r->barrier, NULL, started + 1);
    pthread_mutex_unlock(&r->gate);
    run_passes(r, result);
    r->done = true;
    pthread_barrier_wait(&r->barrier);
    for (uint32_t i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
    pthread_barrier_destroy(&r->barrier);
    pthread_mutex_destroy(&r->gate);
}

static void store_mean(float *out, const double sum[3], double scale)
{
    for (int c = 0; c < 3; c++)
        out[c] = (float)(sum[c] * scale);
}

/* The layers are rounded to floats first and the picture is their sum, so that a sum of the
 * layers has the bits of the picture. */
static void write_light(const lsf_reference_job *job, const pixel_sum *sum, double scale,
                        float *pixel)
{
    const int *channels = job->channels;
    float layers[4][3];
    store_mean(layers[0], sum->emission, scale);
    store_mean(layers[1], sum->direct, scale);
    store_mean(layers[2], sum->indirect_diffuse, scale);
    store_mean(layers[3], sum->indirect_specular, scale);
    for (int c = 0; c < 3; c++)
        pixel[channels[LSF_REFERENCE_BEAUTY] + c] =
            layers[0][c] + layers[1][c] + layers[2][c] + layers[3][c];
    for (int i = 0; i < 4; i++)
        if (channels[LSF_REFERENCE_EMISSION + i] >= 0)
            memcpy(pixel + channels[LSF_REFERENCE_EMISSION + i], layers[i], sizeof layers[i]);
}

static void write_image(const render *r)
{
    const lsf_reference_job *job = r->job;
    const int *channels = job->channels;
    uint64_t pixels = (uint64_t)job->image->width * job->image->height;
    for (uint64_t i = 0; i < pixels; i++) {
        float *pixel = job->image->pixels + i * job->image->channel_count;
        double scale = r->sums[i].taken != 0 ? 1.0 / r->sums[i].taken : 0.0;
        write_light(job, &r->sums[i], scale, pixel);
        if (channels[LSF_REFERENCE_COVERAGE] >= 0)
            pixel[channels[LSF_REFERENCE_COVERAGE]] = (float)((double)r->sums[i].covered * scale);
        if (channels[LSF_REFERENCE_ALBEDO] >= 0)
            store_mean(pixel + channels[LSF_REFERENCE_ALBEDO], r->guides[i].albedo, scale);
        if (channels[LSF_REFERENCE_NORMAL] >= 0)
            store_mean(pixel + channels[LSF_REFERENCE_NORMAL], r->guides[i].normal, scale);
        if (channels[LSF_REFERENCE_DEPTH] >= 0)
            pixel[channels[LSF_REFERENCE_DEPTH]] = (float)(r->guides[i].depth / job->state->scale);
    }
}

bool lsf_reference_module_render(lsf_reference_job *job, lsf_error *error)
{
    const lsf_render_params *params = job->params;
    uint64_t pixels = (uint64_t)params->width * params->height;
    render *r = lsf_alloc(1, sizeof *r);
    if (r == NULL)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    double start = lsf_now();
    bool ok = lsf_reference_world_init(&r->world, job->scene, job->state, params->bounces, error);
    r->world.background = job->background;
    job->result.build_seconds = lsf_now() - start;
    if (ok) {
        bool guides = job->channels[LSF_REFERENCE_ALBEDO] >= 0 ||
                      job->channels[LSF_REFERENCE_NORMAL] >= 0 ||
                      job->channels[LSF_REFERENCE_DEPTH] >= 0;
        r->sums = lsf_alloc(pixels, sizeof *r->sums);
        r->guides = guides ? lsf_alloc(pixels, sizeof *r->guides) : NULL;
        ok = r->sums != NULL && (!guides || r->guides != NULL);
        if (!ok)
            lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u x %u pixels",
                          params->width, params->height);
    }
    if (ok) {
        r->job = job;
        r->tiles_x = (params->width + TILE - 1) / TILE;
        r->tile_count = r->tiles_x * ((params->height + TILE - 1) / TILE);
        run_threads(r, &job->result);
        write_image(r);
    }
    lsf_reference_world_finish(&r->world);
    free(r->sums);
    free(r->guides);
    free(r);
    return ok;
}
