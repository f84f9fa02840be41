/* Declarations that the files of the ray-bundle pass share. */
#ifndef LSF_PASSES_RAY_BUNDLE_PARTS_H
#define LSF_PASSES_RAY_BUNDLE_PARTS_H

#include "frame/triangle_fetch.h"
#include "passes/ray_bundle.h"

/* The nodes of one bundle. */
typedef struct lsf_ray_bundle_slot {
    uint32_t index;
    GLuint arrays[LSF_RAY_BUNDLE_ARRAYS];
    GLuint head_fetch, key_fetch, chain_fetch; /* buffer textures of what the search reads */
} lsf_ray_bundle_slot;

/* DrawElementsIndirectCommand */
typedef struct lsf_ray_bundle_draw {
    GLuint count, instance_count, first_index;
    GLint base_vertex;
    GLuint base_instance;
} lsf_ray_bundle_draw;

struct lsf_ray_bundle {
    lsf_context *context;
    lsf_ray_bundle_params params;
    lsf_ray_bundle_use use;
    bool fitted;
    struct lsf_bundle_slot_data *projections; /* of this iteration's bundles */
    GLuint projection_buffer;
    lsf_ray_bundle_slot *slots;
    uint32_t capacity;                    /* number of chained nodes that each slot can hold */
    uint32_t side;                        /* texels of a map that are in use, along a side */
    GLuint status, readback;              /* lsf_bundle_status, and a copy on its way to the host */
    const struct lsf_bundle_status *read; /* mapped */
    GLsync sent;                          /* the copy has arrived; NULL: none is under way */
    GLuint samples_query;
    GLuint tiles, tiles_framebuffer, build_framebuffer, hits, hits_framebuffer;
    GLuint rest; /* pixels whose search takes longer */
    GLuint tiles_program, fit_program, build_program, search_program, rest_program, tally_program;
    /* Only where small triangles are rasterised by a shader. */
    GLuint small_program;
    GLuint large; /* draws of large triangles, and their indices */
    lsf_triangle_fetch fetch;
    lsf_ray_bundle_draw *draws;
    uint32_t draw_count;
    lsf_timer *bounds_timer, *build_timer, *search_timer;
    uint64_t counts[LSF_RAY_BUNDLE_COUNTS];
    uint64_t draw_counts[LSF_DRAW_COUNTS];
};

/* --- ray_bundle.c */

/* Adds to the pass in turn the switch of lib/bundle_map.glsl. */
void lsf_ray_bundle_gap_switch(lsf_plan *plan);

/* --- ray_bundle_nodes.c */

/* Texels of a map in memory, in whole tiles. */
uint64_t lsf_ray_bundle_texels(const lsf_ray_bundle_params *params);
/* bundle.slices as a multiple of 4 less one, and no more than a storage block holds; or 0. */
int32_t lsf_ray_bundle_slices(const lsf_ray_bundle_params *params);
/* Sets the sizes in `data`. */
void lsf_ray_bundle_set_sizes(const lsf_ray_bundle_params *params, struct lsf_bundle_data *data);
/* Whether nodes hold anisotropy or transmission. */
bool lsf_ray_bundle_has_wide_specular_params(const lsf_plan *plan);
void lsf_ray_bundle_nodes_plan(lsf_plan *plan, const lsf_ray_bundle_params *params,
                               const lsf_ray_bundle_use *use);
bool lsf_ray_bundle_nodes_create(lsf_ray_bundle *pass, const lsf_plan *plan, lsf_error *error);
/* Makes space for `needed` chained nodes and some more. Where the device cannot hold that many,
 * later bundles use fewer texels. On failure there are no nodes at all. */
bool lsf_ray_bundle_nodes_grow(lsf_ray_bundle *pass, lsf_plan *plan, uint32_t needed,
                               lsf_error *error);
void lsf_ray_bundle_nodes_bind_textures(const lsf_ray_bundle_slot *slot);
void lsf_ray_bundle_nodes_destroy(lsf_ray_bundle *pass);

/* --- ray_bundle_raster.c */

void lsf_ray_bundle_raster_plan(lsf_plan *plan, const lsf_ray_bundle_params *params);
bool lsf_ray_bundle_raster_create(lsf_ray_bundle *pass, const lsf_plan *plan, lsf_error *error);
/* Appends the whole scene to the bound bundle, number `bundle` of the iteration. */
void lsf_ray_bundle_raster_run(lsf_ray_bundle *pass, const lsf_iteration *iteration,
                               uint32_t bundle);
/* Sets the random numbers, for the program in use, by which surfaces that let light straight
 * through or are blended are in the bundle. */
void lsf_ray_bundle_set_chance(const lsf_ray_bundle *pass, const lsf_iteration *iteration,
                               uint32_t bundle);
void lsf_ray_bundle_raster_destroy(lsf_ray_bundle *pass);

/* --- ray_bundle_tally.c; lsf_ray_bundle_end, _gate and _settle are there, too */

void lsf_ray_bundle_tally_plan(lsf_plan *plan);
bool lsf_ray_bundle_tally_create(lsf_ray_bundle *pass, const lsf_plan *plan, lsf_error *error);
/* Counts the nodes of the bundle that is bound and was drawn within samples_query. */
void lsf_ray_bundle_tally_build(const lsf_ray_bundle *pass);
void lsf_ray_bundle_tally_destroy(lsf_ray_bundle *pass);

/* --- ray_bundle_gaps.c */

/* The same as in lsf_bundle_data. */
typedef struct lsf_ray_bundle_gaps {
    lsf_vec4 starts[3], lengths[3];
} lsf_ray_bundle_gaps;

/* Finds the empty space between islands along a bundle's axes, for a map of `texels` a side.
 * Sets low and high to the bounds of the whole scene without it. */
lsf_ray_bundle_gaps lsf_ray_bundle_close_gaps(const lsf_islands *islands, const lsf_float3 axes[3],
                                              float texels, float low[3], float high[3]);

/* --- ray_bundle_aim.c */

/* lsf_ray_bundle_aim is there, too. */
void lsf_ray_bundle_aim_plan(lsf_plan *plan);
bool lsf_ray_bundle_aim_create(lsf_ray_bundle *pass, const lsf_plan *plan, lsf_error *error);

#endif
