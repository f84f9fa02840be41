/* Light from a coarse grid to the picture's pixels, by a search for the surface that each shows.
 * See upsample_search.md. */
#ifndef LSF_PASSES_UPSAMPLE_SEARCH_H
#define LSF_PASSES_UPSAMPLE_SEARCH_H

#include "frame/coarse_grid.h"
#include "frame/maps.h"
#include "plan/option.h"

typedef struct lsf_upsample_search_params {
    int32_t radius;   /* of the search [texels of the grid] */
    float min_cosine; /* between normals that are alike */
    float slope;      /* a candidate may rise from the surface by this for its distance */
} lsf_upsample_search_params;

#define LSF_UPSAMPLE_SEARCH_PARAMS_DEFAULTS .radius = 3, .min_cosine = 0.9f, .slope = 0.25f

#define LSF_UPSAMPLE_SEARCH_OPTION_COUNT 3
extern const lsf_option_row lsf_upsample_search_options[LSF_UPSAMPLE_SEARCH_OPTION_COUNT];

typedef struct lsf_upsample_search {
    lsf_context *context;
    lsf_upsample_search_params params;
    lsf_surface_maps coarse; /* output of split, of the grid's size */
    lsf_split_light light;   /* output of run, of the picture's size */
    lsf_coarse_grid grid;    /* of the last split */
    GLuint split_framebuffer, light_framebuffer;
    GLuint split_program, program;
    lsf_timer *split_timer, *timer;
} lsf_upsample_search;

/* Lists "upsample_search_split" and "upsample_search" for a grid of width by height texels; leaves
 * them out when it is as fine as the picture. Needs the G-buffer's plan. */
void lsf_upsample_search_plan(lsf_plan *plan, const lsf_upsample_search_params *params,
                              uint32_t width, uint32_t height);
bool lsf_upsample_search_create(lsf_upsample_search *pass, lsf_context *context,
                                const lsf_plan *plan, const lsf_upsample_search_params *params,
                                lsf_error *error);
/* Sets `grid`, and `coarse` to what it sees of what the picture's pixels see. */
void lsf_upsample_search_split(lsf_upsample_search *pass, const lsf_iteration *iteration,
                               const lsf_surface_maps *seen);
/* Sets `light` from light on the grid of the last split. */
void lsf_upsample_search_run(lsf_upsample_search *pass, const lsf_iteration *iteration,
                             const lsf_surface_maps *seen, const lsf_split_light *coarse_light);
void lsf_upsample_search_destroy(lsf_upsample_search *pass);

#endif
