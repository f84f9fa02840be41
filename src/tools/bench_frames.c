/* Frames of papers and talks, procedure for procedure, on the machine at hand. */
#include "tools/bench_table.h"
#include "tools/summary.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FRAMES_GPU 32u
#define MAX_OPTIONS 10

/* A frame to time. Its options come before those of -D, which win. */
typedef struct bench_frame {
    const char *measurement, *title;
    const char *technique;
    const char *options[MAX_OPTIONS];
    uint32_t screen[2], software_screen[2]; /* [pixels]; the second where GL is software */
    uint32_t supersampling;                 /* pixels rendered for one of the screen, a side */
    uint32_t bounces;                       /* 0: the value of --bounces */
    uint32_t warm_up;         /* frames before the first one that counts, in which programs
                               * settle */
    uint32_t software_frames; /* frames that count where GL is software */
    double triangles;         /* approximate number that the scene is tessellated to; 0: it is
                               * not */
    const lsf_bench_row *rows;
    size_t row_count;
    double paper_ms;   /* time of a frame; NAN: not published */
    const char *paper; /* source of that figure */
} bench_frame;

/* Table 1 of Y. Tokuyoshi and S. Ogaki, "Real-Time Bidirectional Path Tracing via Rasterization",
 * I3D 2012, row for row. */
static const lsf_bench_row bidirectional_rows[] = {
    {"Create G-Buffer", 6.0, {"gbuffer"}},
    {"Create Reflective Shadow Maps",
     2.7,
     {"reflective_shadow_map", "reflective_shadow_map_pdf", "vpl_draw"}},
    {"Create Shadow Maps", 2.9, {"shadow_map"}},
    {"Split", 1.6, {"sparse_split"}},
    {"Compute Bounds of Ray-bundles", 0.4, {"ray_bundle_bounds"}},
    {"Create Ray-Bundle x21", 15.4, {"ray_bundle_build"}},
    {"Create VPL Shadow Map x21", 29.9, {"vpl_shadow_map"}},
    {"Compute Bidirectional Path Tracing x21",
     5.5,
     {"ray_bundle_search", "bidirectional_shade_vpl", "bidirectional_shade_hit"}},
    {"Gather", 1.0, {"sparse_gather"}},
    {"Filter", 8.4, {"blur"}},
    {"Output", 3.6, {"compose", "accumulate", "tonemap"}},
    {"Others", 0.4, {NULL}},
};

static const lsf_bench_row cone_rows[] = {
    {"G-buffer", NAN, {"gbuffer"}},
    {"Shadow maps and direct light", NAN, {"shadow_map", "direct_light"}},
    {"Voxelise", NAN, {"voxelize"}},
    {"Light voxels", NAN, {"voxel_light", "voxel_bounce"}},
    {"Build pyramid", NAN, {"voxel_mip"}},
    {"Trace cones", NAN, {"sparse_fit", "sparse_split", "cone_trace"}},
    {"Blur", NAN, {"blur"}},
    {"Upsample", NAN, {"sparse_gather", "sparse_upsample"}},
    {"Output", NAN, {"compose", "accumulate", "tonemap"}},
    {"Others", NAN, {NULL}},
};

static const lsf_bench_row voxel_path_rows[] = {
    {"Voxelise what moves", NAN, {"voxelize"}},
    {"Light voxels", NAN, {"voxel_light"}},
    {"Shadow maps and direct light", NAN, {"shadow_map", "direct_light"}},
    {"Gather", NAN, {"gbuffer", "sparse_fit", "sparse_split"}},
    {"Trace", NAN, {"voxel_path"}},
    {"Blur", NAN, {"blur"}},
    {"Upsample", NAN, {"sparse_gather", "sparse_upsample"}},
    {"Output", NAN, {"compose", "accumulate", "tonemap"}},
    {"Others", NAN, {NULL}},
};

/* The talk on voxel path tracing of 2018 gives frames a second, of another atrium. What does not
 * move is voxelised once, every frame stands alone, and paths find light by chance. */
#define TALK_OPTIONS                                                                               \
    "voxel.resolution=128", "voxel.jitter=off", "voxel_path.draws=0", "voxel_path.max_samples=6",  \
        "sparse.blur=5"
#define VOXEL_PATH_FRAME                                                                           \
    .measurement = "voxel_path", .title = "A frame of voxel path tracing (2018)",                  \
    .technique = "voxel_path", .supersampling = 1, .bounces = 1, .warm_up = 1,                     \
    .software_frames = 3, .rows = voxel_path_rows, .row_count = LSF_COUNT(voxel_path_rows)

static const bench_frame frames[] = {
    /* The pattern of interleaving is the largest whose tiles all get one of the 21. Light goes from
     * x0 over x1 and x2 to x3, as in the paper's figures. */
    {.measurement = "bidirectional",
     .title = "Table 1 of Tokuyoshi and Ogaki 2012",
     .technique = "bidirectional",
     .options = {"vpl.count=21", "vpl.shadow_resolution=256", "bundle.count=21",
                 "bundle.resolution=256", "bundle.window=visible", "rsm.resolution=256",
                 "shadow.filter=pcf", "interleave.size=4", "sparse.blur=3"},
     .screen = {1920, 1088},
     .software_screen = {480, 270},
     .supersampling = 2,
     .bounces = 2,
     .warm_up = 2, /* lists grow to their size, too */
     .software_frames = 3,
     .triangles = 174e3,
     .rows = bidirectional_rows,
     .row_count = LSF_COUNT(bidirectional_rows),
     .paper_ms = 77.8,
     .paper = "1920x1088, 2x2 supersampling, 174 k triangles, AMD Radeon HD 6990"},
    /* Everything may have moved: a grid that shifts is never the one before. The rest is for one
     * frame alone: few cones on a coarse grid, whose pattern the blur takes away, and maps no finer
     * than a filter needs. docs/voxels.md tells their error. */
    {.measurement = "cone",
     .title = "A frame of cone tracing, all made anew",
     .technique = "cone",
     .options = {"voxel.resolution=128", "voxel.jitter=on", "cone.count=3", "cone.draws=0",
                 "sparse.grid=4", "sparse.blur=5", "shadow.filter=pcf",
                 "shadow.texels_per_pixel=4"},
     .screen = {512, 512},
     .software_screen = {512, 512},
     .supersampling = 1,
     .bounces = 1,
     .warm_up = 2, /* programs that clear settle in the second */
     .software_frames = 10,
     .rows = cone_rows,
     .row_count = LSF_COUNT(cone_rows),
     .paper_ms = NAN},
    {VOXEL_PATH_FRAME, .options = {TALK_OPTIONS}, .screen = {1024, 768},
     .software_screen = {1024, 768}, .paper_ms = 1e3 / 17.5,
     .paper = "17.5 frames/s on a GTX 970M, where a path tracer with a BVH had 7.4"},
    /* At 960x540 points, the next that are no fewer. */
    {VOXEL_PATH_FRAME, .options = {TALK_OPTIONS, "sparse.grid=2"}, .screen = {1920, 1080},
     .software_screen = {1920, 1080}, .paper_ms = 1e3 / 30.0,
     .paper = "30 frames/s and more on a GTX 970M, traced at 640x480"},
};

/* A frame as it is rendered. */
typedef struct measured {
    const bench_frame *frame;
    uint32_t factor; /* of tessellation */
    char tessellation[40];
    uint64_t triangles;
    uint32_t screen[2];
    uint32_t count; /* of frames */
    const char **options;
    lsf_render_params params;
    lsf_bench_table table;
} measured;

/* The factor whose number of triangles comes closest to the one asked for. */
static uint32_t factor_for(uint64_t triangles, double wanted)
{
    uint32_t best = 1;
    for (uint32_t factor = 2; factor <= 16 && triangles > 0 && wanted > 0.0; factor++) {
        double ratio = wanted / (double)triangles;
        if (fabs(log(factor * factor / ratio)) < fabs(log(best * best / ratio)))
            best = factor;
    }
    return best;
}

static bool set_options(measured *m, const lsf_settings *settings, lsf_error *error)
{
    static const char key[] = "tessellation.factor=";
    uint32_t count = 0;
    m->options = lsf_alloc((uint64_t)MAX_OPTIONS + 1 + settings->defines.count, sizeof *m->options);
    if (!m->options)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    while (count < MAX_OPTIONS && m->frame->options[count]) {
        m->options[count] = m->frame->options[count];
        count++;
    }
    if (m->frame->triangles > 0.0) {
        snprintf(m->tessellation, sizeof m->tessellation, "%s%u", key, m->factor);
        m->options[count++] = m->tessellation;
    }
    for (uint32_t i = 0; i < settings->defines.count; i++) {
        m->options[count++] = settings->defines.items[i];
        if (strncmp(settings->defines.items[i], key, strlen(key)) == 0)
            m->factor = (uint32_t)strtoul(settings->defines.items[i] + strlen(key), NULL, 10);
    }
    m->params.options = m->options;
    m->params.option_count = count;
    return true;
}

static bool prepare(measured *m, const lsf_bench *bench, const bench_frame *frame, lsf_error *error)
{
    const lsf_settings *settings = &bench->settings;
    bool software = bench->device.software;
    const uint32_t *screen = lsf_settings_given(settings, "resolution") ? settings->resolution
                             : software                                 ? frame->software_screen
                                                                        : frame->screen;
    uint64_t triangles = lsf_scene_get_requirements(bench->scene)->triangles;
    *m = (measured){.frame = frame,
                    .factor = factor_for(triangles, frame->triangles),
                    .screen = {screen[0], screen[1]},
                    .count = settings->samples ? settings->samples
                             : software        ? frame->software_frames
                                               : FRAMES_GPU,
                    .params = lsf_settings_render_params(settings),
                    .table = {.rows = frame->rows, .row_count = frame->row_count}};
    if (!set_options(m, settings, error))
        return false;
    m->triangles = triangles * m->factor * m->factor;
    m->params.technique = frame->technique;
    m->params.width = screen[0] * frame->supersampling;
    m->params.height = screen[1] * frame->supersampling;
    m->params.samples = 1;
    m->params.bounces =
        frame->bounces > 0 ? frame->bounces : lsf_summary_bounces(settings, bench->scene);
    m->params.time_limit = INFINITY;
    m->params.raw = true;
    m->params.rgb8 = true;
    return true;
}

static bool measure(measured *m, const lsf_bench *bench, lsf_error *error)
{
    uint8_t *rgb = lsf_alloc((uint64_t)m->params.width * m->params.height, 3);
    if (!rgb)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    lsf_renderer *renderer = lsf_renderer_create(bench->context, bench->scene, &m->params, error);
    bool good = renderer && lsf_bench_table_measure(&m->table, renderer, rgb, m->frame->warm_up,
                                                    m->count, error);
    lsf_renderer_destroy(renderer);
    free(rgb);
    return good;
}

static bool print(const measured *m, const lsf_bench *bench, lsf_error *error)
{
    const bench_frame *frame = m->frame;
    char rendered[80] = "";
    if (frame->supersampling > 1)
        snprintf(rendered, sizeof rendered, " with %ux%u supersampling (%ux%u pixels)",
                 frame->supersampling, frame->supersampling, m->params.width, m->params.height);
    bool good = lsf_bench_print(
        bench, error, "%s on %s\n%s, %llu triangles\n%ux%u%s, %u bounce%s, mean of %u frame%s\n",
        frame->title, bench->device.renderer, bench->scene_path, (unsigned long long)m->triangles,
        m->screen[0], m->screen[1], rendered, m->params.bounces, lsf_plural(m->params.bounces),
        m->count, lsf_plural(m->count));
    for (uint32_t i = 0; good && i < m->params.option_count; i++)
        good = lsf_bench_print(bench, error, "%s%s", i ? " " : "", m->options[i]);
    good = good && lsf_bench_print(bench, error, "\n\n") &&
           lsf_bench_table_print(&m->table, bench, frame->paper_ms, error);
    if (frame->paper)
        good = good && lsf_bench_print(bench, error, "\nTheirs: %s\n", frame->paper);
    return good;
}

static void add_json(lsf_json *json, const measured *m)
{
    lsf_json_begin(json, NULL, '{');
    lsf_json_integer(json, "triangles", m->triangles);
    lsf_json_integer(json, "tessellation_factor", m->factor);
    lsf_json_vector(json, "screen", (float[]){(float)m->screen[0], (float)m->screen[1]}, 2);
    lsf_json_integer(json, "supersampling", m->frame->supersampling);
    lsf_json_integer(json, "bounces", m->params.bounces);
    lsf_json_integer(json, "frames", m->count);
    lsf_json_begin(json, "options", '[');
    for (uint32_t i = 0; i < m->params.option_count; i++)
        lsf_json_string(json, NULL, m->options[i]);
    lsf_json_end(json, ']');
    lsf_bench_table_add(&m->table, json, m->frame->paper_ms);
    lsf_json_end(json, '}');
}

bool lsf_bench_frames(lsf_bench *bench, lsf_error *error)
{
    bool good = true, first = true;
    lsf_json_begin(&bench->json, "measured", '[');
    for (size_t i = 0; good && i < LSF_COUNT(frames); i++) {
        measured m;
        if (strcmp(frames[i].measurement, bench->settings.operands.items[0]) != 0)
            continue;
        good = (first || lsf_bench_print(bench, error, "\n")) &&
               prepare(&m, bench, &frames[i], error) && measure(&m, bench, error) &&
               print(&m, bench, error);
        if (good)
            add_json(&bench->json, &m);
        free((void *)m.options);
        first = false;
    }
    lsf_json_end(&bench->json, ']');
    return good;
}
