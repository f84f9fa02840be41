/* Table 1 of Y. Tokuyoshi and S. Ogaki, "Real-Time Bidirectional Path Tracing via Rasterization",
 * I3D 2012, row for row: what a frame of 21 VPLs and 21 ray-bundles takes. */
#include "tools/bench_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Triangles of the scene behind the paper's table (its figure 9). */
#define PAPER_TRIANGLES 174e3

/* Frames before the first one that counts: programs settle and lists grow to their size. */
#define WARM_UP 2u
#define FRAMES_SOFTWARE 3u
#define FRAMES_GPU 32u

/* Pixels that are rendered for one of the screen, along each side. */
#define SUPERSAMPLING 2u

/* As the paper's figures: light from x0 over x1 and x2 to x3. */
#define BOUNCES 2u

/* What makes a frame of the paper of it; -D on the command line comes later and wins. The pattern
 * of interleaving is the largest whose tiles all get one of the 21. */
static const char *const frame_options[] = {
    "vpl.count=21",          "vpl.shadow_resolution=256", "bundle.count=21",
    "bundle.resolution=256", "bundle.window=visible",     "rsm.resolution=256",
    "shadow.filter=pcf",     "interleave.size=4",
};

static const lsf_bench_row rows[] = {
    {"Create G-Buffer", 6.0, {"gbuffer"}},
    {"Create Reflective Shadow Maps",
     2.7,
     {"reflective_shadow_map", "reflective_shadow_map_pdf", "vpl_draw"}},
    {"Create Shadow Maps", 2.9, {"shadow_map"}},
    {"Split", 1.6, {"interleave_split"}},
    {"Compute Bounds of Ray-bundles", 0.4, {"ray_bundle_bounds"}},
    {"Create Ray-Bundle x21", 15.4, {"ray_bundle_build"}},
    {"Create VPL Shadow Map x21", 29.9, {"vpl_shadow_map"}},
    {"Compute Bidirectional Path Tracing x21",
     5.5,
     {"ray_bundle_search", "bidirectional_shade_vpl", "bidirectional_shade_hit"}},
    {"Gather", 1.0, {"interleave_gather"}},
    {"Filter", 8.4, {"interleave_filter"}},
    {"Output", 3.6, {"compose", "accumulate", "tonemap"}},
    {"Others", 0.4, {NULL}},
};
#define PAPER_TOTAL 77.8

/* --- the scene and its frame */

typedef struct frame {
    uint32_t factor; /* of tessellation */
    uint64_t triangles;
    uint32_t width, height; /* of the screen */
    uint32_t count;
    char tessellation[40];
    const char **options;
    lsf_render_params params;
} frame;

/* The factor that comes closest to the paper's scene. */
static uint32_t factor_for(uint64_t triangles)
{
    uint32_t best = 1;
    for (uint32_t factor = 2; factor <= 16 && triangles > 0; factor++) {
        double ratio = PAPER_TRIANGLES / (double)triangles;
        if (fabs(log(factor * factor / ratio)) < fabs(log(best * best / ratio)))
            best = factor;
    }
    return best;
}

static bool set_options(frame *f, const lsf_settings *settings, lsf_error *error)
{
    static const char key[] = "tessellation.factor=";
    uint32_t count = 0;
    f->options = lsf_alloc((uint64_t)LSF_COUNT(frame_options) + 1 + settings->defines.count,
                           sizeof *f->options);
    if (!f->options)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    for (size_t i = 0; i < LSF_COUNT(frame_options); i++)
        f->options[count++] = frame_options[i];
    snprintf(f->tessellation, sizeof f->tessellation, "%s%u", key, f->factor);
    f->options[count++] = f->tessellation;
    for (uint32_t i = 0; i < settings->defines.count; i++) {
        f->options[count++] = settings->defines.items[i];
        if (strncmp(settings->defines.items[i], key, strlen(key)) == 0)
            f->factor = (uint32_t)strtoul(settings->defines.items[i] + strlen(key), NULL, 10);
    }
    f->params.options = f->options;
    f->params.option_count = count;
    return true;
}

static bool prepare(frame *f, const lsf_bench *bench, lsf_error *error)
{
    const lsf_settings *settings = &bench->settings;
    bool software = bench->device.software;
    bool given = lsf_settings_given(settings, "resolution");
    f->width = given ? settings->resolution[0] : software ? 480 : 1920;
    f->height = given ? settings->resolution[1] : software ? 270 : 1088;
    f->count = settings->samples ? settings->samples : software ? FRAMES_SOFTWARE : FRAMES_GPU;
    f->triangles = lsf_scene_get_requirements(bench->scene)->triangles;
    f->factor = factor_for(f->triangles);
    f->params = lsf_settings_render_params(settings);
    if (!set_options(f, settings, error))
        return false;
    f->triangles *= (uint64_t)f->factor * f->factor;
    f->params.technique = "bidirectional";
    f->params.width = f->width * SUPERSAMPLING;
    f->params.height = f->height * SUPERSAMPLING;
    f->params.samples = 1;
    f->params.time_limit = INFINITY;
    f->params.bounces = BOUNCES;
    f->params.rgb8 = true;
    return true;
}

/* --- the table */

static bool print_table(const lsf_bench *bench, const frame *f, const lsf_bench_table *t,
                        lsf_error *error)
{
    bool good = lsf_bench_print(
        bench, error,
        "Table 1 of Tokuyoshi and Ogaki 2012 on %s\n%s, %llu triangles\n"
        "%ux%u with 2x2 supersampling (%ux%u pixels), %u bounces, mean of %u frame%s\n",
        bench->device.renderer, bench->scene_path, (unsigned long long)f->triangles, f->width,
        f->height, f->params.width, f->params.height, BOUNCES, f->count, lsf_plural(f->count));
    for (uint32_t i = 0; good && i < f->params.option_count; i++)
        good = lsf_bench_print(bench, error, "%s%s", i ? " " : "", f->options[i]);
    return good && lsf_bench_print(bench, error, "\n\n") &&
           lsf_bench_table_print(t, bench, PAPER_TOTAL, error) &&
           lsf_bench_print(
               bench, error,
               "\nThe paper's: 1920x1088, 2x2 supersampling, 174 k triangles, AMD Radeon "
               "HD 6990\n");
}

static void add_json(lsf_json *json, const frame *f, const lsf_bench_table *t)
{
    lsf_json_integer(json, "triangles", f->triangles);
    lsf_json_integer(json, "tessellation_factor", f->factor);
    lsf_json_vector(json, "screen", (float[]){(float)f->width, (float)f->height}, 2);
    lsf_json_integer(json, "supersampling", SUPERSAMPLING);
    lsf_json_integer(json, "bounces", BOUNCES);
    lsf_json_integer(json, "frames", f->count);
    lsf_json_begin(json, "options", '[');
    for (uint32_t i = 0; i < f->params.option_count; i++)
        lsf_json_string(json, NULL, f->options[i]);
    lsf_json_end(json, ']');
    lsf_bench_table_add(t, json, PAPER_TOTAL);
}

bool lsf_bench_bidirectional(lsf_bench *bench, lsf_error *error)
{
    frame f = {0};
    lsf_bench_table t = {.rows = rows, .row_count = LSF_COUNT(rows)};
    lsf_renderer *renderer = NULL;
    uint8_t *rgb = NULL;
    bool good = prepare(&f, bench, error);
    if (good) {
        rgb = lsf_alloc((uint64_t)f.params.width * f.params.height, 3);
        renderer = rgb ? lsf_renderer_create(bench->context, bench->scene, &f.params, error) : NULL;
        good =
            renderer || (rgb == NULL && lsf_error_set(error, LSF_ERROR_RENDER, "no memory left"));
    }
    good = good && lsf_bench_table_measure(&t, renderer, rgb, WARM_UP, f.count, error) &&
           print_table(bench, &f, &t, error);
    if (good)
        add_json(&bench->json, &f, &t);
    lsf_renderer_destroy(renderer);
    free(rgb);
    free((void *)f.options);
    return good;
}
