/* Light that visible points of media transmit, by refracted paths through the voxels. See
 * refraction.md. */
#ifndef LSF_PASSES_REFRACTION_H
#define LSF_PASSES_REFRACTION_H

#include "frame/emitter_points.h"
#include "frame/path_inputs.h"
#include "plan/option.h"

typedef struct lsf_refraction_params {
    int32_t paths; /* of each visible point of a medium in an iteration, times the `factor` of the
                    * use; 0: its light goes straight */
} lsf_refraction_params;

#define LSF_REFRACTION_PARAMS_DEFAULTS .paths = 4

#define LSF_REFRACTION_OPTION_COUNT 1
extern const lsf_option_row lsf_refraction_options[LSF_REFRACTION_OPTION_COUNT];

typedef struct lsf_refraction_use {
    uint32_t factor;     /* of paths, higher the longer the rest of an iteration takes */
    const char *reads;   /* the specular light at the points, to which this is added, and that of
                          * voxels, as for lsf_plan_reads */
    uint32_t interleave; /* side of the pattern in whose order points are; 1: that of pixels */
    bool split_direct;   /* emission that lobes show is added apart */
    bool lobes;          /* paths have a share of narrow lobes */
    bool mirrors;        /* paths go on from smooth metals */
    bool lamps;          /* which keep one */
    bool bounces;        /* voxels are lit directly: paths go on from all */
} lsf_refraction_use;

/* Textures that its light is added to. */
typedef struct lsf_refraction_targets {
    GLuint specular;
    GLuint direct; /* specular light of emission that lobes show; 0: it is in the other, too */
} lsf_refraction_targets;

typedef struct lsf_refraction {
    lsf_context *context;
    uint32_t paths; /* of a point */
    uint32_t targets;
    bool lobes;
    lsf_emitter_points emitters; /* no buffer: none are drawn */
    float lobe_kernel;           /* see lib/lobe_paths.glsl; set before it runs */
    GLuint framebuffer, program;
    lsf_timer *timer; /* NULL: not planned */
} lsf_refraction;

/* Whether visible media are refracted, where voxels with two sides are lit. Without bounces paths
 * would end within them. */
bool lsf_refraction_needed(const lsf_plan *plan, const lsf_refraction_params *params);
/* Whether paths have a share of the narrow lobes of visible points. */
bool lsf_refraction_lobes(const lsf_plan *plan, const lsf_refraction_params *params);
void lsf_refraction_plan(lsf_plan *plan, const lsf_refraction_params *params,
                         const lsf_refraction_use *use);
bool lsf_refraction_create(lsf_refraction *pass, lsf_context *context, const lsf_plan *plan,
                           const lsf_refraction_params *params, uint32_t factor,
                           const lsf_refraction_targets *targets, const lsf_scene *scene,
                           const lsf_state *state, lsf_error *error);
/* Updates the emitters to the current state. False without memory. */
bool lsf_refraction_follow(lsf_refraction *pass, bool materials_edited);
void lsf_refraction_run(lsf_refraction *pass, const lsf_iteration *iteration,
                        const lsf_path_inputs *inputs);
void lsf_refraction_destroy(lsf_refraction *pass);

#endif
