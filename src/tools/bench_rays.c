#include "tools/bench.h"

#include <lightsheaf/bench.h>

#include <stdio.h>

/* Directions that are measured for each row; an odd number has a median that was measured. */
#define DIRECTIONS 7u

static const uint32_t screens[][2] = {{512, 512}, {1024, 1024}, {1920, 1080}};
static const uint32_t bundles[] = {256, 512, 1024};

static void add_json_row(lsf_json *json, const lsf_ray_bench_row *row)
{
    lsf_json_begin(json, NULL, '{');
    lsf_json_vector(json, "screen", (float[]){(float)row->width, (float)row->height}, 2);
    lsf_json_integer(json, "bundle", row->bundle);
    lsf_json_integer(json, "slices", row->slices);
    lsf_json_integer(json, "rays", row->rays);
    lsf_json_number(json, "build_ms", row->build_ms);
    lsf_json_number(json, "search_ms", row->search_ms);
    lsf_json_number(json, "mrays_per_s", row->mrays_per_s);
    lsf_json_number(json, "embree_mrays_per_s", row->embree_mrays_per_s);
    lsf_json_number(json, "agreement", row->agreement);
    lsf_json_end(json, '}');
}

static bool print_row(const lsf_bench *bench, const lsf_ray_bench_row *row, lsf_error *error)
{
    char screen[24];
    snprintf(screen, sizeof screen, "%ux%u", row->width, row->height);
    return lsf_bench_print(bench, error, "%-12s%6u%11.2f%12.2f%11.2f%10.2f%12.4f\n", screen,
                           row->bundle, row->build_ms, row->search_ms, row->mrays_per_s,
                           row->embree_mrays_per_s, row->agreement);
}

static bool run_screen(lsf_bench *bench, lsf_ray_bench *rays, uint32_t width, uint32_t height,
                       lsf_error *error)
{
    uint32_t directions = bench->settings.samples ? bench->settings.samples : DIRECTIONS;
    for (size_t b = 0; b < LSF_COUNT(bundles); b++) {
        lsf_ray_bench_row row;
        if (!lsf_ray_bench_run(rays, width, height, bundles[b], directions, &row, error) ||
            !print_row(bench, &row, error))
            return false;
        add_json_row(&bench->json, &row);
    }
    return true;
}

static bool run_screens(lsf_bench *bench, lsf_ray_bench *rays, lsf_error *error)
{
    const uint32_t *resolution = bench->settings.resolution;
    if (lsf_settings_given(&bench->settings, "resolution"))
        return run_screen(bench, rays, resolution[0], resolution[1], error);
    for (size_t s = 0; s < LSF_COUNT(screens); s++)
        if (!run_screen(bench, rays, screens[s][0], screens[s][1], error))
            return false;
    return true;
}

bool lsf_bench_rays(lsf_bench *bench, lsf_error *error)
{
    lsf_render_params params = lsf_settings_render_params(&bench->settings);
    params.samples = 1;
    params.raw = true; /* a ray for each pixel */
    lsf_ray_bench *rays = lsf_ray_bench_create(bench->context, bench->scene, &params, error);
    if (!rays)
        return false;
    bool good = lsf_bench_print(bench, error,
                                "Ray-bundles on %s against Embree on all cores, the same rays\n"
                                "%s\n\n%-12s%6s%11s%12s%11s%10s%12s\n",
                                bench->device.renderer, bench->scene_path, "screen", "bundle",
                                "build ms", "search ms", "M rays/s", "Embree", "agreement");
    lsf_json_begin(&bench->json, "rows", '[');
    good = good && run_screens(bench, rays, error);
    lsf_json_end(&bench->json, ']');
    lsf_json_string(&bench->json, "embree_function", lsf_ray_bench_embree_function(rays));
    good = good && lsf_bench_print(bench, error, "\nEmbree by its %s, the fastest here\n",
                                   lsf_ray_bench_embree_function(rays));
    lsf_ray_bench_destroy(rays);
    return good;
}
