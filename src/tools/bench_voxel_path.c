/* The frames of the talk on voxel path tracing of 2018, procedure for procedure: gather, trace,
 * blur and upsample at 1024x768, and traced at as many places as 640x480 has pixels for 1920x1080.
 */
#include "tools/bench_table.h"
#include "tools/summary.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Frames before the first one that counts: programs settle, and what does not move has voxels. */
#define WARM_UP 1u
#define FRAMES_SOFTWARE 3u
#define FRAMES_GPU 32u

/* As the talk has it: what does not move is voxelised once, and every frame stands alone. */
static const char *const common_options[] = {"voxel.resolution=128", "voxel.jitter=off",
                                             "blur.when=on"};
enum { OPTIONS = LSF_COUNT(common_options) + 1 };

/* The talk gives frames a second, of another atrium. */
static const struct {
    uint32_t width, height;
    const char *scale;
    double paper_ms;
    const char *paper;
} frames[] = {
    {1024, 768, "voxel_path.scale=1", 1e3 / 17.5,
     "17.5 frames/s on a GTX 970M, where a path tracer with a BVH had 7.4"},
    /* Both sides by the root of 640 480 / (1920 1080). */
    {1920, 1080, "voxel_path.scale=0.3849", 1e3 / 30.0,
     "30 frames/s and more on a GTX 970M, traced at 640x480"},
};

static const lsf_bench_row rows[] = {
    {"Voxelise what moves", NAN, {"voxelize"}},
    {"Light voxels", NAN, {"voxel_light"}},
    {"Shadow maps and direct light", NAN, {"shadow_map", "direct_light"}},
    {"Gather", NAN, {"gbuffer", "upsample_search_split"}},
    {"Trace", NAN, {"voxel_path"}},
    {"Blur", NAN, {"blur"}},
    {"Upsample", NAN, {"upsample_search"}},
    {"Output", NAN, {"compose", "accumulate", "tonemap"}},
    {"Others", NAN, {NULL}},
};

typedef struct measured {
    uint32_t count; /* frames */
    const char **options;
    lsf_render_params params;
    lsf_bench_table table;
} measured;

static bool prepare(measured *m, const lsf_bench *bench, size_t frame, lsf_error *error)
{
    const lsf_settings *settings = &bench->settings;
    bool given = lsf_settings_given(settings, "resolution");
    m->table = (lsf_bench_table){.rows = rows, .row_count = LSF_COUNT(rows)};
    m->count = settings->samples        ? settings->samples
               : bench->device.software ? FRAMES_SOFTWARE
                                        : FRAMES_GPU;
    m->params = lsf_settings_render_params(settings);
    m->options = lsf_alloc((uint64_t)OPTIONS + settings->defines.count, sizeof *m->options);
    if (!m->options)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    uint32_t count = 0;
    for (size_t i = 0; i < LSF_COUNT(common_options); i++)
        m->options[count++] = common_options[i];
    m->options[count++] = frames[frame].scale;
    for (uint32_t i = 0; i < settings->defines.count; i++)
        m->options[count++] = settings->defines.items[i];
    m->params.options = m->options;
    m->params.option_count = count;
    m->params.technique = "voxel_path";
    m->params.width = given ? settings->resolution[0] : frames[frame].width;
    m->params.height = given ? settings->resolution[1] : frames[frame].height;
    m->params.samples = 1;
    m->params.bounces = lsf_summary_bounces(settings, bench->scene);
    m->params.time_limit = INFINITY;
    m->params.rgb8 = true;
    return true;
}

static bool measure(measured *m, const lsf_bench *bench, lsf_error *error)
{
    uint8_t *rgb = lsf_alloc((uint64_t)m->params.width * m->params.height, 3);
    if (!rgb)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    lsf_renderer *renderer = lsf_renderer_create(bench->context, bench->scene, &m->params, error);
    bool good =
        renderer && lsf_bench_table_measure(&m->table, renderer, rgb, WARM_UP, m->count, error);
    lsf_renderer_destroy(renderer);
    free(rgb);
    return good;
}

static bool print(const measured *m, const lsf_bench *bench, size_t frame, lsf_error *error)
{
    bool good =
        lsf_bench_print(bench, error, "%s%ux%u, %u bounce%s, mean of %u frame%s\n",
                        frame ? "\n" : "", m->params.width, m->params.height, m->params.bounces,
                        lsf_plural(m->params.bounces), m->count, lsf_plural(m->count));
    for (uint32_t i = 0; good && i < m->params.option_count; i++)
        good = lsf_bench_print(bench, error, "%s%s", i ? " " : "", m->options[i]);
    return good && lsf_bench_print(bench, error, "\n\n") &&
           lsf_bench_table_print(&m->table, bench, frames[frame].paper_ms, error) &&
           lsf_bench_print(bench, error, "The talk's: %s\n", frames[frame].paper);
}

static void add_json(lsf_json *json, const measured *m, size_t frame)
{
    lsf_json_begin(json, NULL, '{');
    lsf_json_vector(json, "screen", (float[]){(float)m->params.width, (float)m->params.height}, 2);
    lsf_json_integer(json, "bounces", m->params.bounces);
    lsf_json_integer(json, "frames", m->count);
    lsf_json_begin(json, "options", '[');
    for (uint32_t i = 0; i < m->params.option_count; i++)
        lsf_json_string(json, NULL, m->options[i]);
    lsf_json_end(json, ']');
    lsf_bench_table_add(&m->table, json, frames[frame].paper_ms);
    lsf_json_end(json, '}');
}

bool lsf_bench_voxel_path(lsf_bench *bench, lsf_error *error)
{
    bool good = lsf_bench_print(
        bench, error, "The frames of voxel path tracing (2018) on %s\n%s, %llu triangles\n\n",
        bench->device.renderer, bench->scene_path,
        (unsigned long long)lsf_scene_get_requirements(bench->scene)->triangles);
    lsf_json_begin(&bench->json, "measured", '[');
    for (size_t i = 0; good && i < LSF_COUNT(frames); i++) {
        measured m = {0};
        good =
            prepare(&m, bench, i, error) && measure(&m, bench, error) && print(&m, bench, i, error);
        if (good)
            add_json(&bench->json, &m, i);
        free((void *)m.options);
    }
    lsf_json_end(&bench->json, ']');
    return good;
}
