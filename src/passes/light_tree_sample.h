/* Light at visible points from a cloud of VPLs, by way of the tree over it. See
 * light_tree_sample.md. */
#ifndef LSF_PASSES_LIGHT_TREE_SAMPLE_H
#define LSF_PASSES_LIGHT_TREE_SAMPLE_H

#include "frame/iteration.h"
#include "frame/light_tree_buffers.h"
#include "frame/maps.h"
#include "frame/voxel_grid.h"
#include "plan/option.h"

typedef enum lsf_light_tree_stop {
    LSF_LIGHT_TREE_SUBSTITUTE, /* at a node that stands for all VPLs below it, for the diffuse
                                * lobe */
    LSF_LIGHT_TREE_LIGHTCUT,   /* at a VPL */
    LSF_LIGHT_TREE_VPL,        /* at a VPL, drawn by its luminance alone */
} lsf_light_tree_stop;

typedef enum lsf_light_tree_sight {
    LSF_LIGHT_TREE_VOXELS, /* occluders are searched among voxels */
    LSF_LIGHT_TREE_EXACT,  /* ... among all triangles */
    LSF_LIGHT_TREE_OPEN,   /* nothing occludes light */
} lsf_light_tree_sight;

typedef struct lsf_light_tree_sample_params {
    int32_t node;    /* lsf_light_tree_stop */
    float angle;     /* largest angle under which a node that stands for VPLs may be seen [rad];
                      * 0: any */
    float cut;       /* under which nodes where ways begin are seen, at most [rad]; 0: any */
    int32_t samples; /* samples of a point in an iteration; 0: 4, or those that fit into the time */
    float bound;     /* least distance that VPLs count with [radii of their discs]; 0: the true
                      * distance */
    float kernel_samples; /* least number of samples that a glossy lobe is spread over; 0: it is
                           * not */
    float lobe_alpha;     /* least alpha of lobes of VPLs in a single iteration */
    int32_t sight;        /* lsf_light_tree_sight */
} lsf_light_tree_sample_params;

/* Samples of a point, at most: software GL ends all loops of a shader together after 65535 turns,
 * some thousand of which a sample may take in a fine grid. */
#define LSF_LIGHT_TREE_SAMPLE_MOST 32

#define LSF_LIGHT_TREE_SAMPLE_PARAMS_DEFAULTS                                                      \
    .node = LSF_LIGHT_TREE_SUBSTITUTE, .angle = 0.25f, .cut = 0.5f, .samples = 0, .bound = 4.0f,   \
    .kernel_samples = 16.0f, .lobe_alpha = 0.35f, .sight = LSF_LIGHT_TREE_VOXELS

#define LSF_LIGHT_TREE_SAMPLE_OPTION_COUNT 8
extern const lsf_option_row lsf_light_tree_sample_options[LSF_LIGHT_TREE_SAMPLE_OPTION_COUNT];

extern const char *const lsf_light_tree_sample_count_names[LSF_LIGHT_TREE_SAMPLE_COUNTS];

typedef struct lsf_light_tree_sample_inputs {
    const lsf_surface_maps *seen; /* by points */
    const lsf_voxels *voxels;     /* NULL allowed where nothing occludes */
    const lsf_light_tree_buffers *tree;
} lsf_light_tree_sample_inputs;

typedef struct lsf_light_tree_sample {
    lsf_context *context;
    lsf_light_tree_sample_params params;
    int sight;  /* as LSF_LIGHT_TREE_SIGHT */
    bool lobes; /* paths gather narrow lobes */
    /* Output, at the points' places. Alpha: luminance that the bound took away. */
    lsf_split_light light;
    GLuint count_buffer;
    uint64_t counts[LSF_LIGHT_TREE_SAMPLE_COUNTS];
    GLuint framebuffer, program;
    lsf_light_tree_fetch fetch;
    lsf_timer *timer;
} lsf_light_tree_sample;

/* `covariance`: as for the tree; `lobes`: paths gather narrow lobes (specular_path.h). Needs the
 * G-buffer's plan, that of the tree and, where voxels occlude, that of the voxels. */
void lsf_light_tree_sample_plan(lsf_plan *plan, const lsf_light_tree_sample_params *params,
                                bool covariance, bool lobes);
bool lsf_light_tree_sample_create(lsf_light_tree_sample *pass, lsf_context *context,
                                  const lsf_plan *plan, const lsf_light_tree_sample_params *params,
                                  lsf_error *error);
/* For lib/specular_share.glsl: solid angle of as many samples of a point as its lobes are to be
 * spread over, were they uniform over the half sphere [sr]. */
float lsf_light_tree_sample_lobe_kernel(const lsf_light_tree_sample *pass,
                                        const lsf_iteration *iteration);
void lsf_light_tree_sample_run(lsf_light_tree_sample *pass, const lsf_iteration *iteration,
                               const lsf_light_tree_sample_inputs *inputs);
/* Counts of all runs; it waits for them. */
const uint64_t *lsf_light_tree_sample_counts(lsf_light_tree_sample *pass);
void lsf_light_tree_sample_destroy(lsf_light_tree_sample *pass);

#endif
