/* Indirect light at fewer points than there are pixels: splits the picture's visible points into
 * these points, which may each take samples of their own, brings light that was gathered there
 * back in order, and upsamples it to every pixel. See sparse.md. */
#ifndef LSF_PASSES_SPARSE_H
#define LSF_PASSES_SPARSE_H

#include "frame/iteration.h"
#include "frame/maps.h"
#include "plan/option.h"

typedef struct lsf_sparse_params {
    int32_t grid;        /* 0: by the plan; else one more than the stride's logarithm */
    int32_t interleave;  /* tiles along a side of the pattern in which points take different
                          * samples; 1: none; 0: by the plan */
    int32_t radius;      /* radius of the search for points of a pixel's surface [points] */
    float slope;         /* at which a point's light counts half, by how far it rises from the plane
                          * for its distance */
    float normal_weight; /* exponent of the cosine between normals */
    bool chosen;         /* the grid: by the plan */
    bool outliers;       /* are scaled to the mean of their neighbours */
} lsf_sparse_params;

#define LSF_SPARSE_PARAMS_DEFAULTS                                                                 \
    .grid = 0, .interleave = 0, .radius = 3, .slope = 0.125f, .normal_weight = 32.0f,              \
    .outliers = false

#define LSF_SPARSE_OPTION_COUNT 6
extern const lsf_option_row lsf_sparse_options[LSF_SPARSE_OPTION_COUNT];

enum {
    LSF_SPARSE_ALONE,    /* pixels that no point of the grid fits, over all iterations */
    LSF_SPARSE_BORROWED, /* of these, such that no point of their own kind fits either */
    LSF_SPARSE_COUNTS,
};
extern const char *const lsf_sparse_count_names[LSF_SPARSE_COUNTS];

typedef struct lsf_sparse {
    lsf_context *context;
    lsf_sparse_params params;
    lsf_surface_maps split;   /* output of split, in the order in which light is to be gathered */
    lsf_split_light gathered; /* output of gather: of points; and a second layer above these. Where
                               * the plan is sparse, the specular part is without its tint */
    lsf_split_light light;    /* output of upsample, of the picture's size */
    GLuint source;            /* the points that each pixel's light comes from */
    GLuint source_framebuffer, split_framebuffer, gathered_framebuffer, light_framebuffer;
    GLuint fit_program, split_program, gather_program, upsample_program;
    GLuint count_buffer;
    uint64_t counts[LSF_SPARSE_COUNTS];
    lsf_timer *fit_timer, *split_timer, *gather_timer, *upsample_timer;
} lsf_sparse;

/* The region of tile `index`, 0 to size * size - 1, row by row, with both layers of points: point
 * (x, y) belongs to tile (x % size, y % size) and lies at the tile's corner plus (x / size,
 * y / size). A region is empty when there are fewer points than tiles. */
lsf_region lsf_sparse_region(const lsf_sparse_grid *grid, uint32_t size, uint32_t index);

/* Lists "sparse_fit" and "sparse_split", then "sparse_gather", then "sparse_upsample", or what of
 * them the plan's strides, a pattern of so many tiles along a side and the options take. Need the
 * G-buffer's plan. */
void lsf_sparse_plan_split(lsf_plan *plan, const lsf_sparse_params *params, uint32_t interleave);
void lsf_sparse_plan_gather(lsf_plan *plan, const lsf_sparse_params *params, uint32_t interleave);
void lsf_sparse_plan_upsample(lsf_plan *plan, const lsf_sparse_params *params, uint32_t interleave);
/* Creates the listed resources. */
bool lsf_sparse_create(lsf_sparse *pass, lsf_context *context, const lsf_plan *plan,
                       const lsf_sparse_params *params, lsf_error *error);
/* Sets `split` from the picture's visible points. */
void lsf_sparse_split(lsf_sparse *pass, const lsf_iteration *iteration,
                      const lsf_surface_maps *seen);
/* Sets `gathered` from light in split order. */
void lsf_sparse_gather(lsf_sparse *pass, const lsf_iteration *iteration,
                       const lsf_surface_maps *seen, const lsf_split_light *split_light);
/* Sets `light` from that of the grid's points, gathered and maybe filtered, and from the second
 * layer of `gathered`. */
void lsf_sparse_upsample(lsf_sparse *pass, const lsf_iteration *iteration,
                         const lsf_surface_maps *seen, const lsf_split_light *points);
/* Counts up to now; it waits for the GPU. */
const uint64_t *lsf_sparse_counts(lsf_sparse *pass);
void lsf_sparse_destroy(lsf_sparse *pass);

#endif
