/* Global ray-bundles: every fragment of the scene along a direction, in lists for each texel. See
 * ray_bundle.md. */
#ifndef LSF_PASSES_RAY_BUNDLE_H
#define LSF_PASSES_RAY_BUNDLE_H

#include "frame/bundle_nodes.h"
#include "frame/iteration.h"
#include "plan/option.h"
#include "shared/bundle_data.h"

typedef enum lsf_ray_bundle_window {
    LSF_RAY_BUNDLE_WINDOW_AUTO, /* the whole scene where paths go on along bundles, else the view */
    LSF_RAY_BUNDLE_WINDOW_VISIBLE, /* fitted to the visible points: paths cannot go on */
    LSF_RAY_BUNDLE_WINDOW_SCENE,   /* all of the scene */
} lsf_ray_bundle_window;

typedef enum lsf_ray_bundle_raster {
    LSF_RAY_BUNDLE_RASTER_COMPUTE, /* small triangles by a shader, large ones by GL */
    LSF_RAY_BUNDLE_RASTER_GL,
} lsf_ray_bundle_raster;

typedef struct lsf_ray_bundle_params {
    int32_t count;            /* bundles an iteration */
    int32_t resolution;       /* texels along a map's side */
    int32_t window;           /* lsf_ray_bundle_window */
    int32_t slices;           /* number of a texel's fragments that are stored in order; more are
                               * chained */
    float capacity;           /* initial number of chained fragments for each texel; it grows
                               * when they do not fit */
    int32_t raster;           /* lsf_ray_bundle_raster */
    float environment_offset; /* L_u, relative to the mean luminance of the environment */
} lsf_ray_bundle_params;

/* Fewest texels along a side of a map. */
#define LSF_RAY_BUNDLE_LEAST 16

#define LSF_RAY_BUNDLE_PARAMS_DEFAULTS                                                             \
    .count = 1, .resolution = 0, .window = LSF_RAY_BUNDLE_WINDOW_AUTO, .slices = 15,               \
    .capacity = 1.0f, .raster = LSF_RAY_BUNDLE_RASTER_COMPUTE, .environment_offset = 1.0f

#define LSF_RAY_BUNDLE_OPTION_COUNT 7
extern const lsf_option_row lsf_ray_bundle_options[LSF_RAY_BUNDLE_OPTION_COUNT];

/* The parts of the pass that the technique uses. */
typedef struct lsf_ray_bundle_use {
    uint32_t count;      /* bundles aimed at once */
    uint32_t slots;      /* bundles held at once; bundle i is held in slot i % slots */
    bool whole_scene;    /* else windows are fitted to the visible points */
    uint32_t interleave; /* size of the interleaving pattern, 1: none */
    bool distances_only; /* nodes hold no surface: lib/ray_bundle.glsl must not be asked for one */
    bool deep_vertices;  /* searches start from positions too, not from the G-buffer alone */
} lsf_ray_bundle_use;

typedef struct lsf_ray_bundle_direction {
    float direction[3]; /* unit */
    float pdf;          /* [1/sr], p_r */
} lsf_ray_bundle_direction;

/* The points where rays start. From the G-buffer: depth and surface. From other vertices:
 * position and surface; surfaces are as in lib/gbuffer.glsl. With use.deep_vertices both depth and
 * position are given, whichever is read: software GL compiles a program again when one of its
 * textures is missing. */
typedef struct lsf_ray_bundle_origins {
    bool from_position;
    GLuint depth;    /* G-buffer depth, or its split copy (R32F) */
    GLuint position; /* RGBA32F: xyz; w 0: no vertex */
    GLuint surface;  /* its geometric normal turns the ray: +direction or -direction */
    GLuint pixels;   /* as in lsf_surface_maps; with depth */
} lsf_ray_bundle_origins;

enum {
    LSF_RAY_BUNDLE_NODES,    /* fragments kept, over all iterations that had room */
    LSF_RAY_BUNDLE_OVERFLOW, /* of these, chained beyond the slices */
    LSF_RAY_BUNDLE_REGROWN,  /* times that buffers were too small and iterations run again */
    LSF_RAY_BUNDLE_COUNTS,
};
extern const char *const lsf_ray_bundle_count_names[LSF_RAY_BUNDLE_COUNTS];

typedef struct lsf_ray_bundle lsf_ray_bundle;

/* Lists passes "ray_bundle_bounds" (where the window is fitted), "ray_bundle_build" and
 * "ray_bundle_search". */
void lsf_ray_bundle_plan(lsf_plan *plan, const lsf_ray_bundle_params *params,
                         const lsf_ray_bundle_use *use);
bool lsf_ray_bundle_create(lsf_ray_bundle **pass, lsf_context *context, const lsf_plan *plan,
                           const lsf_ray_bundle_params *params, const lsf_ray_bundle_use *use,
                           lsf_error *error);
/* Sets the projections of this iteration's bundles, `use.count` of them: a random turn about the
 * axis and a random place of the texels' grid for each; fits the windows to what `depth` (of the
 * G-buffer, not split) shows. */
void lsf_ray_bundle_aim(lsf_ray_bundle *pass, const lsf_iteration *iteration,
                        const lsf_ray_bundle_direction *directions, GLuint depth);
/* Draws the scene into a bundle's lists. */
void lsf_ray_bundle_build(lsf_ray_bundle *pass, const lsf_iteration *iteration, uint32_t bundle);
/* A bundle's nodes, valid until its slot is built again. */
lsf_bundle_nodes lsf_ray_bundle_nodes(const lsf_ray_bundle *pass, uint32_t bundle);
/* The nearest fragment beyond each origin in the region. RG32UI of the picture's size, valid until
 * the next search: x the distance as float bits, y the node, LSF_NO_NODE when the ray leaves the
 * scene. */
GLuint lsf_ray_bundle_search(lsf_ray_bundle *pass, const lsf_iteration *iteration, uint32_t bundle,
                             const lsf_ray_bundle_origins *origins, const lsf_region *region);
/* Ends the iteration: its picture may be kept if all of its bundles had room, and so those before.
 */
void lsf_ray_bundle_end(lsf_ray_bundle *pass, const lsf_iteration *iteration);
/* A buffer that begins with a DrawArraysIndirectCommand: of three vertices if the picture of the
 * iteration that ended may be kept, of none when it or one before it lacks nodes. */
GLuint lsf_ray_bundle_gate(const lsf_ray_bundle *pass);
/* Makes more space when some bundle had too little, as far as the host knows; it knows
 * everything only with `wait`. False: there is more now, and iterations are to be run again from
 * `iterations_done` on. */
bool lsf_ray_bundle_settle(lsf_ray_bundle *pass, const lsf_iteration *iteration, bool wait,
                           uint32_t *iterations_done);
/* Adds the switches of lib/ray_bundle.glsl to the current pass, which reads nodes. */
void lsf_ray_bundle_reader_switches(lsf_plan *plan);
void lsf_ray_bundle_destroy(lsf_ray_bundle *pass); /* NULL allowed */

/* Timers of bounds (NULL where there are none), build and search, in this order. */
void lsf_ray_bundle_timers(const lsf_ray_bundle *pass, lsf_timer *timers[3]);
/* Counts as of the last lsf_ray_bundle_settle. */
const uint64_t *lsf_ray_bundle_counts(const lsf_ray_bundle *pass);

#endif
