/* Benchmark of ray-bundles against a ray tracer: the same rays, on the same machine, one after
 * the other. It serves `lightsheaf bench rays` and is not part of the stable API. */
#ifndef LIGHTSHEAF_BENCH_H
#define LIGHTSHEAF_BENCH_H

#include <lightsheaf/renderer.h>

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

/* One ray from every visible point, along the bundle's direction on the surface's side. Times
 * are medians over directions. */
typedef struct lsf_ray_bench_row {
    uint32_t width, height;    /* of the screen [pixels] */
    uint32_t bundle;           /* texels along a side of the bundle's map */
    uint32_t slices;           /* bundle.slices, or as many as fit on the device */
    uint64_t rays;             /* per direction: pixels that show a surface */
    double build_ms;           /* fitting the window and drawing the scene into the lists */
    double search_ms;          /* the nearest hit of every ray */
    double mrays_per_s;        /* million rays a second, build and search together */
    double embree_mrays_per_s; /* on all cores; without building its tree */
    double agreement; /* share of the rays for which both find no hit, or whose distances differ
                       * by no more than 1 % and a texel of the bundle */
} lsf_ray_bench_row;

typedef struct lsf_ray_bench lsf_ray_bench;

/* Loads the reference's module and builds its tree. Uses camera, time, seed and options of
 * `params`. Scene and context are borrowed and must outlive it. */
lsf_ray_bench *lsf_ray_bench_create(lsf_context *context, const lsf_scene *scene,
                                    const lsf_render_params *params, lsf_error *error);
void lsf_ray_bench_destroy(lsf_ray_bench *bench); /* NULL allowed */

/* Runs one direction to warm up, then `directions` (1 to 64) that are measured. */
bool lsf_ray_bench_run(lsf_ray_bench *bench, uint32_t width, uint32_t height, uint32_t bundle,
                       uint32_t directions, lsf_ray_bench_row *row, lsf_error *error);
/* Embree's fastest function on these rays, "" before the first run. */
const char *lsf_ray_bench_embree_function(const lsf_ray_bench *bench);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
