/* Specular light at visible points, by paths through the voxels: what media transmit, refracted,
 * and what narrow lobes reflect. See specular_path.md. */
#ifndef LSF_PASSES_SPECULAR_PATH_H
#define LSF_PASSES_SPECULAR_PATH_H

#include "frame/emitter_points.h"
#include "frame/path_inputs.h"
#include "plan/option.h"

typedef struct lsf_specular_path_params {
    int32_t samples; /* paths of each such point in an iteration, times the `factor` of the use; 0:
                      * light goes straight through media, and other samples gather all lobes */
} lsf_specular_path_params;

#define LSF_SPECULAR_PATH_PARAMS_DEFAULTS .samples = 4

#define LSF_SPECULAR_PATH_OPTION_COUNT 1
extern const lsf_option_row lsf_specular_path_options[LSF_SPECULAR_PATH_OPTION_COUNT];

typedef struct lsf_specular_path_use {
    uint32_t factor;     /* of paths, higher the longer the rest of an iteration takes */
    const char *reads;   /* the specular light at the points, to which this is added, and that of
                          * voxels, as for lsf_plan_reads */
    uint32_t interleave; /* side of the pattern in whose order points are; 1: that of pixels */
    bool split_direct;   /* emission that lobes show is added apart */
    bool lobes;          /* paths have a share of narrow lobes (lib/specular_share.glsl) */
    bool mirrors;        /* paths go on from smooth metals */
    bool lamps;          /* which keep one */
    bool bounces;        /* voxels are lit directly: paths go on from all */
} lsf_specular_path_use;

/* Textures that its light is added to. */
typedef struct lsf_specular_path_targets {
    GLuint specular;
    GLuint direct; /* specular light of emission that lobes show; 0: it is in the other, too */
} lsf_specular_path_targets;

typedef struct lsf_specular_path {
    lsf_context *context;
    uint32_t samples; /* paths of a point */
    uint32_t targets; /* number of textures that light is added to */
    bool lobes;
    float lobe_kernel; /* with lobes, as in lib/specular_share.glsl; to be set before each run */
    lsf_emitter_points emitters; /* no buffer: none are drawn */
    GLuint framebuffer, program;
    lsf_timer *timer; /* NULL: not planned */
} lsf_specular_path;

/* Whether visible media are refracted, where voxels with two sides are lit. Without bounces paths
 * would end within them. */
bool lsf_specular_path_media(const lsf_plan *plan, const lsf_specular_path_params *params);
/* Whether paths have a share of narrow lobes: where there are smooth metals, and media, whose
 * voxels are there already. */
bool lsf_specular_path_lobes(const lsf_plan *plan, const lsf_specular_path_params *params);
void lsf_specular_path_plan(lsf_plan *plan, const lsf_specular_path_params *params,
                            const lsf_specular_path_use *use);
bool lsf_specular_path_create(lsf_specular_path *pass, lsf_context *context, const lsf_plan *plan,
                              const lsf_specular_path_params *params, uint32_t factor,
                              const lsf_specular_path_targets *targets, const lsf_scene *scene,
                              const lsf_state *state, lsf_error *error);
/* Updates the emitters to the current state. False without memory. */
bool lsf_specular_path_follow(lsf_specular_path *pass, bool materials_edited);
void lsf_specular_path_run(lsf_specular_path *pass, const lsf_iteration *iteration,
                           const lsf_path_inputs *inputs);
void lsf_specular_path_destroy(lsf_specular_path *pass);

#endif
