#include <lightsheaf/bench.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "bench/screen_rays.h"
#include "math/sampling.h"
#include "passes/gbuffer.h"
#include "passes/ray_bundle.h"
#include "reference/module.h"
#include "scene/checks.h"
#include "shared/scene_data.h"
#include "techniques/setup.h"

#define MAX_DIRECTIONS 64u
#define WARM_UP 1u

/* Positions from the G-buffer are off by some 2^-20 half extents of the scene (32-bit floats, a few
 * roundings). A ray at cosine c to its surface leaves this behind after 1 / c times as much: from
 * 2^-14 on, all but the 2^-6 flattest ones start free. */
#define EMBREE_NEAR 0x1p-14f

struct lsf_ray_bench {
    lsf_context *context;
    const lsf_scene *scene;
    lsf_render_params params;
    lsf_setup setup; /* of the scene that Embree's tree borrows */
    const lsf_reference_ray_functions *embree;
    lsf_reference_tracer *tracer;
    bool traced;
};

/* What one screen and one size of bundle take. */
typedef struct run {
    lsf_setup setup;
    lsf_scene_gpu scene;
    lsf_iteration iteration;
    lsf_gbuffer gbuffer;
    lsf_ray_bundle *bundle;
    lsf_screen_rays rays;
    float *distances;  /* Embree's, of each ray */
    uint32_t *answers; /* the bundle's, of each pixel: distance as bits, node */
    lsf_ray_bundle_direction directions[MAX_DIRECTIONS + WARM_UP];
    double build_ms[MAX_DIRECTIONS], search_ms[MAX_DIRECTIONS], embree_s[MAX_DIRECTIONS];
    uint64_t asked, agreed;
} run;

lsf_ray_bench *lsf_ray_bench_create(lsf_context *context, const lsf_scene *scene,
                                    const lsf_render_params *params, lsf_error *error)
{
    if (!lsf_given(context, "context", error) || !lsf_scene_given(scene, error) ||
        !lsf_given(params, "params", error))
        return NULL;
    lsf_ray_bench *bench = lsf_alloc(1, sizeof *bench);
    if (!bench) {
        lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
        return NULL;
    }
    bench->context = context;
    bench->scene = scene;
    bench->params = *params;
    bench->params.aovs = 0;
    bench->embree = lsf_reference_load_rays(error);
    if (bench->embree && lsf_setup_begin(&bench->setup, scene, &bench->params, true, error))
        bench->tracer = bench->embree->create(bench->setup.scene, &bench->setup.state, error);
    if (!bench->tracer) {
        lsf_ray_bench_destroy(bench);
        return NULL;
    }
    return bench;
}

void lsf_ray_bench_destroy(lsf_ray_bench *bench)
{
    if (!bench)
        return;
    if (bench->tracer)
        bench->embree->destroy(bench->tracer);
    lsf_setup_finish(&bench->setup);
    free(bench);
}

const char *lsf_ray_bench_embree_function(const lsf_ray_bench *bench)
{
    if (!bench)
        return "";
    return bench->traced ? bench->embree->kernel(bench->tracer) : "";
}

/* Uniform over the sphere, whichever number of them is taken. */
static void choose_directions(run *r, uint32_t count, uint64_t seed)
{
    for (uint32_t i = 0; i < count; i++) {
        float u[2];
        lsf_sobol_2d(i, lsf_hash(seed, 0), u);
        float z = 1.0f - 2.0f * u[0], radius = sqrtf(fmaxf(0.0f, 1.0f - z * z));
        float angle = 6.28318531f * u[1];
        r->directions[i] = (lsf_ray_bundle_direction){
            .direction = {radius * cosf(angle), radius * sinf(angle), z}, .pdf = 0.159154943f};
    }
}

static bool plan_run(run *r, lsf_ray_bench *bench, uint32_t bundle, int32_t fewer_slices,
                     const lsf_ray_bundle_use *use, lsf_error *error)
{
    lsf_setup *setup = &r->setup;
    if (!lsf_setup_begin(setup, bench->scene, &bench->params, true, error))
        return false;
    lsf_ray_bundle_params *params = &setup->pass_params.ray_bundle;
    params->resolution = (int32_t)bundle;
    params->count = (int32_t)use->count;
    params->slices -= fewer_slices;
    lsf_gbuffer_plan(setup->plan);
    lsf_ray_bundle_plan(setup->plan, params, use);
    return !setup->plan->failed ||
           lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the frame plan");
}

/* Whether shaders can reach all of each buffer: software GL has a limit of 128 MiB. */
static bool buffers_fit(const lsf_plan *plan)
{
    GLint64 limit = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
    for (uint64_t i = 0; i < plan->resource_count; i++)
        if (plan->resources[i].is_buffer && plan->resources[i].bytes > (uint64_t)limit)
            return false;
    return true;
}

static bool create_run(run *r, lsf_ray_bench *bench, uint32_t bundle, uint32_t directions,
                       lsf_error *error)
{
    lsf_context *context = bench->context;
    lsf_ray_bundle_use use = {.count = directions + WARM_UP,
                              .slots = 1,
                              .interleave = 1,
                              .distances_only = true}; /* as Embree is asked */
    lsf_setup *setup = &r->setup;
    if (!plan_run(r, bench, bundle, 0, &use, error))
        return false;
    /* A large bundle gives up slices rather than its size: more of its fragments are chained. */
    for (int32_t fewer = 1; !buffers_fit(setup->plan) && setup->pass_params.ray_bundle.slices > 0;
         fewer++) {
        lsf_setup_finish(setup);
        if (!plan_run(r, bench, bundle, fewer, &use, error))
            return false;
    }
    const lsf_ray_bundle_params *params = &setup->pass_params.ray_bundle;
    return lsf_plan_check(setup->plan, context, error) &&
           lsf_scene_gpu_create(&r->scene, context, setup->plan, setup->scene, &setup->state, NULL,
                                error) &&
           lsf_iteration_create(&r->iteration, context, setup->plan, &r->scene, &setup->state, NULL,
                                bench->params.seed, error) &&
           lsf_gbuffer_create(&r->gbuffer, context, setup->plan, &setup->pass_params.gbuffer,
                              &r->scene, error) &&
           lsf_ray_bundle_create(&r->bundle, context, setup->plan, params, &use, error);
}

static void destroy_run(run *r)
{
    lsf_ray_bundle_destroy(r->bundle);
    lsf_gbuffer_destroy(&r->gbuffer);
    lsf_iteration_destroy(&r->iteration);
    lsf_scene_gpu_destroy(&r->scene);
    lsf_setup_finish(&r->setup);
    lsf_screen_rays_finish(&r->rays);
    free(r->distances);
    free(r->answers);
    free(r);
}

static bool draw_screen(run *r, lsf_error *error)
{
    const lsf_plan *plan = r->setup.plan;
    uint64_t pixels = (uint64_t)plan->width * plan->height;
    lsf_iteration_begin(&r->iteration, 0);
    lsf_gbuffer_run(&r->gbuffer, &r->iteration);
    if (!lsf_screen_rays_init(&r->rays, &r->iteration, r->gbuffer.outputs.seen.depth,
                              r->gbuffer.outputs.seen.surface, error))
        return false;
    r->distances = lsf_alloc(pixels, sizeof *r->distances);
    r->answers = lsf_alloc(pixels, 2 * sizeof *r->answers);
    if (!r->distances || !r->answers)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the rays of %ux%u pixels",
                             plan->width, plan->height);
    if (r->rays.count == 0)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "the camera sees nothing of the scene: there are no rays to trace");
    return true;
}

/* Width of a texel of a bundle, in normalised space; the wider of its sides. */
static double texel_width(const run *r, uint32_t index)
{
    const lsf_bundle_nodes nodes = lsf_ray_bundle_nodes(r->bundle, index);
    struct lsf_bundle_data data;
    glGetNamedBufferSubData(nodes.projections, nodes.offset, sizeof data, &data);
    return 2.0 * (double)(fmaxf(data.window.z, data.window.w) * data.range.w);
}

static void count_agreement(run *r, double texel)
{
    for (uint64_t i = 0; i < r->rays.count; i++) {
        const uint32_t *answer = r->answers + 2 * (size_t)r->rays.pixels[i];
        bool met = isfinite(r->distances[i]), found = answer[1] != LSF_NO_NODE;
        float distance;
        memcpy(&distance, answer, sizeof distance);
        double traced = (double)r->distances[i];
        bool near = met && found && fabs((double)distance - traced) <= 0.01 * traced + texel;
        r->agreed += near || (!met && !found);
    }
    r->asked += r->rays.count;
}

/* Builds and searches bundle `index`; milliseconds of either. */
static void run_bundle(run *r, uint32_t index, double *build_ms, double *search_ms)
{
    const lsf_plan *plan = r->setup.plan;
    const lsf_region region = {0, 0, (int32_t)plan->width, (int32_t)plan->height, 0, 0};
    const lsf_ray_bundle_origins origins = {.depth = r->gbuffer.outputs.seen.depth,
                                            .surface = r->gbuffer.outputs.seen.surface};
    lsf_timer *timers[3];
    lsf_ray_bundle_timers(r->bundle, timers);
    double built, searched;
    uint32_t done;
    GLuint found;
    do {
        built = lsf_timer_milliseconds(timers[1]);
        searched = lsf_timer_milliseconds(timers[2]);
        lsf_ray_bundle_build(r->bundle, &r->iteration, index);
        found = lsf_ray_bundle_search(r->bundle, &r->iteration, index, &origins, &region);
        lsf_ray_bundle_end(r->bundle, &r->iteration);
    } while (!lsf_ray_bundle_settle(r->bundle, &r->iteration, true, &done));
    *build_ms = lsf_timer_milliseconds(timers[1]) - built;
    *search_ms = lsf_timer_milliseconds(timers[2]) - searched;
    glGetTextureImage(found, 0, GL_RG_INTEGER, GL_UNSIGNED_INT,
                      (GLsizei)(plan->width * plan->height * 8), r->answers);
}

static bool run_directions(run *r, lsf_ray_bench *bench, uint32_t count, lsf_error *error)
{
    lsf_timer *timers[3];
    lsf_ray_bundle_aim(r->bundle, &r->iteration, r->directions, r->gbuffer.outputs.seen.depth);
    lsf_ray_bundle_timers(r->bundle, timers);
    /* All windows are fitted at once: each bundle bears its share. */
    double bounds_ms =
        timers[0] ? lsf_timer_milliseconds(timers[0]) / (double)(count + WARM_UP) : 0.0;
    for (uint32_t i = 0; i < count + WARM_UP; i++) {
        double build_ms, search_ms, seconds;
        run_bundle(r, i, &build_ms, &search_ms);
        lsf_screen_rays_aim(&r->rays, r->directions[i].direction);
        if (!lsf_context_check(bench->context, error) ||
            !bench->embree->trace(bench->tracer, r->rays.rays, r->rays.count, EMBREE_NEAR,
                                  r->distances, &seconds, error))
            return false;
        bench->traced = true;
        if (i < WARM_UP)
            continue;
        r->build_ms[i - WARM_UP] = bounds_ms + build_ms;
        r->search_ms[i - WARM_UP] = search_ms;
        r->embree_s[i - WARM_UP] = seconds;
        count_agreement(r, texel_width(r, i));
    }
    return true;
}

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, uint32_t count)
{
    qsort(values, count, sizeof *values, compare_doubles);
    return 0.5 * (values[(count - 1) / 2] + values[count / 2]);
}

static void fill_row(run *r, uint32_t directions, uint32_t bundle, lsf_ray_bench_row *row)
{
    double rays = (double)r->rays.count;
    *row = (lsf_ray_bench_row){
        .width = r->setup.plan->width,
        .height = r->setup.plan->height,
        .bundle = bundle,
        .slices = (uint32_t)r->setup.pass_params.ray_bundle.slices,
        .rays = r->rays.count,
        .build_ms = median(r->build_ms, directions),
        .search_ms = median(r->search_ms, directions),
        .embree_mrays_per_s = 1e-6 * rays / median(r->embree_s, directions),
        .agreement = (double)r->agreed / (double)r->asked,
    };
    row->mrays_per_s = 1e-3 * rays / (row->build_ms + row->search_ms);
}

bool lsf_ray_bench_run(lsf_ray_bench *bench, uint32_t width, uint32_t height, uint32_t bundle,
                       uint32_t directions, lsf_ray_bench_row *row, lsf_error *error)
{
    if (!lsf_given(bench, "bench", error) || !lsf_given(row, "row", error))
        return false;
    if (directions < 1 || directions > MAX_DIRECTIONS)
        return lsf_error_set(error, LSF_ERROR_USAGE, "%u directions: 1 to %u are possible",
                             directions, MAX_DIRECTIONS);
    run *r = lsf_alloc(1, sizeof *r);
    if (!r)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    bench->params.width = width;
    bench->params.height = height;
    choose_directions(r, directions + WARM_UP, bench->params.seed);
    LSF_LEAVE lsf_context *entered = lsf_context_enter(bench->context, error);
    bool good = entered && create_run(r, bench, bundle, directions, error) &&
                draw_screen(r, error) && run_directions(r, bench, directions, error);
    if (good)
        fill_row(r, directions, bundle, row);
    destroy_run(r);
    return good;
}
