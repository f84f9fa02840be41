/* The interface between the library and the module that holds the path tracer. */
#ifndef LSF_REFERENCE_MODULE_H
#define LSF_REFERENCE_MODULE_H

#include <lightsheaf/reference.h>

#include "scene/background.h"
#include "scene/state.h"

#define LSF_REFERENCE_MODULE_NAME "lightsheaf-reference"
#define LSF_REFERENCE_MODULE_ENTRY "lsf_reference_module_render"

typedef enum lsf_reference_layer {
    LSF_REFERENCE_BEAUTY,
    LSF_REFERENCE_ALBEDO,
    LSF_REFERENCE_NORMAL,
    LSF_REFERENCE_DEPTH,
    LSF_REFERENCE_EMISSION,
    LSF_REFERENCE_DIRECT,
    LSF_REFERENCE_INDIRECT_DIFFUSE,
    LSF_REFERENCE_INDIRECT_SPECULAR,
    LSF_REFERENCE_COVERAGE,
    LSF_REFERENCE_LAYER_COUNT,
} lsf_reference_layer;

typedef struct lsf_reference_job {
    const lsf_scene *scene;
    const lsf_state *state;
    const lsf_render_params *params;
    lsf_seen_background background;
    uint32_t half;
    uint32_t threads; /* 0: one for each core */
    lsf_image *image;
    int channels[LSF_REFERENCE_LAYER_COUNT]; /* each layer's first channel in the image; -1: none */
    lsf_reference_result result;             /* filled */
} lsf_reference_job;

typedef bool (*lsf_reference_module_function)(lsf_reference_job *job, lsf_error *error);

__attribute__((visibility("default"))) bool lsf_reference_module_render(lsf_reference_job *job,
                                                                        lsf_error *error);

/* --- closest hits, as fast as Embree finds them */

#define LSF_REFERENCE_RAYS_ENTRY "lsf_reference_module_rays"

typedef struct lsf_reference_ray {
    float origin[3], direction[3]; /* normalised space, unit */
} lsf_reference_ray;

typedef struct lsf_reference_tracer lsf_reference_tracer;

typedef struct lsf_reference_ray_functions {
    /* Builds the tree. Borrows scene and state. */
    lsf_reference_tracer *(*create)(const lsf_scene *scene, const lsf_state *state,
                                    lsf_error *error);
    void (*destroy)(lsf_reference_tracer *tracer); /* NULL allowed */
    /* The nearest hit beyond `near` of each ray, infinity where there is none, on all cores; and
     * the seconds that took. Consecutive rays should be coherent. A call with more rays than any
     * before tries all of Embree's traversal functions; the fastest is used from then on. */
    bool (*trace)(lsf_reference_tracer *tracer, const lsf_reference_ray *rays, uint64_t count,
                  float near, float *distances, double *seconds, lsf_error *error);
    const char *(*kernel)(const lsf_reference_tracer *tracer); /* "rtcIntersect16" */
} lsf_reference_ray_functions;

extern const lsf_reference_ray_functions lsf_reference_module_rays
    __attribute__((visibility("default")));

/* The function of the module, which is loaded on first use; NULL when it is not installed. */
const lsf_reference_ray_functions *lsf_reference_load_rays(lsf_error *error);

#endif
