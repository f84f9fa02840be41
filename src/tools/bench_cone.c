/* A frame of cone tracing in which everything may have moved: voxels and their light are made anew,
 * one bounce of light. */
#include "tools/bench_table.h"
#include "tools/summary.h"

#include <math.h>
#include <stdlib.h>

/* Frames before the first one that counts: programs settle, those that clear in the second. */
#define WARM_UP 2u
#define FRAMES_SOFTWARE 10u
#define FRAMES_GPU 32u
#define SIDE 512u /* of the screen [pixels] */

/* What the fastest of the OpenGL voxel cone tracers that run in software GL took for such a frame
 * (Cornell box, llvmpipe on two cores). */
#define PEER_MS 810.0

/* A grid that shifts is never the one before. The rest is for one frame alone: few cones on a
 * coarse grid, whose pattern the blur takes away, and maps no finer than a filter needs.
 * docs/voxels.md tells their error. */
static const char *const frame_options[] = {
    "voxel.resolution=128", "voxel.jitter=on", "cone.count=3",      "cone.step=1.5",
    "cone.scale=0.1875",    "blur.when=on",    "shadow.filter=pcf", "shadow.texels_per_pixel=4"};

static const lsf_bench_row rows[] = {
    {"G-buffer", NAN, {"gbuffer"}},
    {"Shadow maps and direct light", NAN, {"shadow_map", "direct_light"}},
    {"Voxelise", NAN, {"voxelize"}},
    {"Light voxels", NAN, {"voxel_light", "voxel_bounce"}},
    {"Build pyramid", NAN, {"voxel_mip"}},
    {"Trace cones", NAN, {"upsample_search_split", "cone_trace"}},
    {"Blur", NAN, {"blur"}},
    {"Upsample", NAN, {"upsample_search"}},
    {"Output", NAN, {"compose", "accumulate", "tonemap"}},
    {"Others", NAN, {NULL}},
};

static const char **join_options(const lsf_settings *settings, uint32_t *count)
{
    const char **options =
        lsf_alloc((uint64_t)LSF_COUNT(frame_options) + settings->defines.count, sizeof *options);
    *count = 0;
    for (size_t i = 0; options && i < LSF_COUNT(frame_options); i++)
        options[(*count)++] = frame_options[i];
    for (uint32_t i = 0; options && i < settings->defines.count; i++)
        options[(*count)++] = settings->defines.items[i];
    return options;
}

static bool measure(lsf_bench_table *table, const lsf_bench *bench, const lsf_render_params *params,
                    uint32_t frames, lsf_error *error)
{
    uint8_t *rgb = lsf_alloc((uint64_t)params->width * params->height, 3);
    if (!rgb)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    lsf_renderer *renderer = lsf_renderer_create(bench->context, bench->scene, params, error);
    bool good = renderer && lsf_bench_table_measure(table, renderer, rgb, WARM_UP, frames, error);
    lsf_renderer_destroy(renderer);
    free(rgb);
    return good;
}

static bool print(const lsf_bench_table *table, const lsf_bench *bench,
                  const lsf_render_params *params, uint32_t frames, lsf_error *error)
{
    bool good = lsf_bench_print(
        bench, error,
        "A frame of cone tracing, all made anew, on %s\n%s, %llu triangles\n"
        "%ux%u, %u bounce%s, mean of %u frame%s\n",
        bench->device.renderer, bench->scene_path,
        (unsigned long long)lsf_scene_get_requirements(bench->scene)->triangles, params->width,
        params->height, params->bounces, lsf_plural(params->bounces), frames, lsf_plural(frames));
    for (uint32_t i = 0; good && i < params->option_count; i++)
        good = lsf_bench_print(bench, error, "%s%s", i ? " " : "", params->options[i]);
    return good && lsf_bench_print(bench, error, "\n\n") &&
           lsf_bench_table_print(table, bench, PEER_MS, error) &&
           lsf_bench_print(bench, error,
                           "Beside the total: the fastest OpenGL peer, Cornell box, llvmpipe on "
                           "two cores\n");
}

bool lsf_bench_cone(lsf_bench *bench, lsf_error *error)
{
    const lsf_settings *settings = &bench->settings;
    bool given = lsf_settings_given(settings, "resolution");
    lsf_bench_table table = {.rows = rows, .row_count = LSF_COUNT(rows)};
    lsf_render_params params = lsf_settings_render_params(settings);
    uint32_t frames = settings->samples        ? settings->samples
                      : bench->device.software ? FRAMES_SOFTWARE
                                               : FRAMES_GPU;
    const char **options = join_options(settings, &params.option_count);
    if (!options)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    params.options = options;
    params.technique = "cone";
    params.width = given ? settings->resolution[0] : SIDE;
    params.height = given ? settings->resolution[1] : SIDE;
    params.samples = 1;
    params.bounces = lsf_summary_bounces(settings, bench->scene);
    params.time_limit = INFINITY;
    params.rgb8 = true;
    bool good = measure(&table, bench, &params, frames, error) &&
                print(&table, bench, &params, frames, error);
    if (good) {
        lsf_json *json = &bench->json;
        lsf_json_vector(json, "screen", (float[]){(float)params.width, (float)params.height}, 2);
        lsf_json_integer(json, "bounces", params.bounces);
        lsf_json_integer(json, "frames", frames);
        lsf_json_begin(json, "options", '[');
        for (uint32_t i = 0; i < params.option_count; i++)
            lsf_json_string(json, NULL, options[i]);
        lsf_json_end(json, ']');
        lsf_bench_table_add(&table, json, PEER_MS);
    }
    free((void *)options);
    return good;
}
