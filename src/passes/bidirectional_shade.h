/* Joins light paths and camera paths at the vertices that the camera's paths have reached. See
 * bidirectional_shade.md. */
#ifndef LSF_PASSES_BIDIRECTIONAL_SHADE_H
#define LSF_PASSES_BIDIRECTIONAL_SHADE_H

#include "frame/bundle_nodes.h"
#include "frame/light_projection.h"
#include "frame/maps.h"
#include "plan/option.h"

typedef enum lsf_bidirectional_strategy {
    LSF_BIDIRECTIONAL_BOTH,   /* VPLs and bundles, combined by multiple importance sampling */
    LSF_BIDIRECTIONAL_VPL,    /* light of punctual lights arrives by VPLs alone */
    LSF_BIDIRECTIONAL_BUNDLE, /* by bundles alone */
} lsf_bidirectional_strategy;

typedef enum lsf_bidirectional_sequence {
    LSF_BIDIRECTIONAL_SOBOL,  /* low discrepancy over all iterations */
    LSF_BIDIRECTIONAL_RANDOM, /* plain random numbers */
} lsf_bidirectional_sequence;

typedef enum lsf_glossy_suppression {
    LSF_GLOSSY_SUPPRESSION_ROUGHNESS, /* roughness follows the density of samples */
    LSF_GLOSSY_SUPPRESSION_CLAMP,     /* the distribution of normals is cut off instead */
    LSF_GLOSSY_SUPPRESSION_NONE,
} lsf_glossy_suppression;

typedef struct lsf_bidirectional_shade_params {
    int32_t strategy;     /* lsf_bidirectional_strategy */
    int32_t sequence;     /* lsf_bidirectional_sequence */
    int32_t suppression;  /* lsf_glossy_suppression */
    float kernel_samples; /* m': samples that a glossy lobe is to be spread over */
    float mis_beta;       /* exponent of the power heuristic */
    float bound; /* distance below which 1/d^2 is held, where only VPLs join a path [radii of a
                  * disc of the area that a VPL stands for]; 0: never */
} lsf_bidirectional_shade_params;

#define LSF_BIDIRECTIONAL_SHADE_PARAMS_DEFAULTS                                                    \
    .strategy = LSF_BIDIRECTIONAL_BOTH, .sequence = LSF_BIDIRECTIONAL_SOBOL,                       \
    .suppression = LSF_GLOSSY_SUPPRESSION_ROUGHNESS, .kernel_samples = 16.0f, .mis_beta = 1.0f,    \
    .bound = 1.0f

#define LSF_BIDIRECTIONAL_SHADE_OPTION_COUNT 6
extern const lsf_option_row lsf_bidirectional_shade_options[LSF_BIDIRECTIONAL_SHADE_OPTION_COUNT];

/* The parts of the pass that the technique uses. */
typedef struct lsf_bidirectional_shade_use {
    uint32_t segments;   /* ray-bundles along a path; 0: VPLs light visible points only */
    uint32_t vertices;   /* segments whose hits become vertices */
    bool vpl_light;      /* there are VPLs that reflect punctual lights */
    bool vpl_emitter;    /* there are VPLs on emissive surfaces */
    bool hit_light;      /* hits of bundles reflect punctual lights */
    bool deep_vpl;       /* VPLs are connected to vertices beyond the visible one */
    bool split_direct;   /* their light on visible points is asked for apart */
    bool lobes;          /* paths gather narrow lobes (specular_path.h) */
    uint32_t interleave; /* size of the pattern, 1: none */
} lsf_bidirectional_shade_use;

/* Weights of a draw's samples; see lib/mis.glsl. */
typedef struct lsf_bidirectional_sample {
    float vpl_count, bundle_count; /* numbers that share a vertex's light by MIS; 0: not in use */
    float weight;                  /* 1 / number of samples of the current strategy */
    float path_count;              /* number of bundles that begin a path at a visible point */
    float iterations;              /* number that the picture will have, for suppression; 0: it
                                    * is off */
    float light_probability;       /* probability of having picked the current light */
    float emitter_weight; /* hits: density by area, for weights, with which VPLs find what emits,
                           * for each unit of its luminance; 0: they do not */
    bool emitter;         /* VPLs: the current one is on an emissive surface */
    float bound; /* squared distance below which 1/d^2 is held times the VPLs' density by area; 0:
                    never */
    /* Hits: densities with which directions drawn by the environment's radiance join the vertex to
     * it along the bundle and against it, and that of the bundle [1/sr], per path. */
    float sky_pdf[2], bundle_pdf;
    /* The bundle that found the deep vertices: its direction and density [1/sr]. */
    const float *arrival;
    float arrival_pdf;
} lsf_bidirectional_sample;

typedef struct lsf_bidirectional_shade_inputs {
    const lsf_surface_maps *seen; /* visible points, maybe split; not read for deep vertices */
    const lsf_shadow *shadow;     /* of the current VPL, or of the light that hits reflect */
    GLuint vpls;                  /* lsf_vpl_outputs.fetch; VPLs only */
    lsf_bundle_nodes nodes;       /* of the current bundle; hits only */
    GLuint hits;                  /* nodes found by ray_bundle; hits only */
    GLuint importance;            /* of the light's map, with adaptive emission */
    GLuint bundle_pdf;            /* 0: uniform */
} lsf_bidirectional_shade_inputs;

/* Alpha of light: luminance that the bound took away. Position: RGBA32F. */
typedef struct lsf_bidirectional_shade_outputs {
    lsf_split_light light;
    lsf_split_light direct;                    /* 0 unless split_direct */
    GLuint position, surface, specular_params; /* the vertices that the last hits became */
} lsf_bidirectional_shade_outputs;

typedef struct lsf_bidirectional_shade {
    lsf_context *context;
    lsf_bidirectional_shade_params params;
    lsf_bidirectional_shade_outputs outputs;
    GLuint throughput;
    bool lobes;
    float lobe_kernel;          /* see lib/specular_share.glsl; set before it runs */
    GLuint vpl_framebuffers[2]; /* [1]: for light that is asked for apart; 0 unless it is */
    GLuint hit_framebuffers[2]; /* [deep] */
    uint32_t hit_floats[2];     /* blended attachments of these */
    GLuint vpl_programs[2], hit_programs[2];
    lsf_timer *vpl_timer, *hit_timer;
} lsf_bidirectional_shade;

/* Lists "bidirectional_shade_vpl" and "bidirectional_shade_hit", and the same with "_deep". */
void lsf_bidirectional_shade_plan(lsf_plan *plan, const lsf_bidirectional_shade_params *params,
                                  const lsf_bidirectional_shade_use *use);
bool lsf_bidirectional_shade_create(lsf_bidirectional_shade *pass, lsf_context *context,
                                    const lsf_plan *plan,
                                    const lsf_bidirectional_shade_params *params, lsf_error *error);
/* Empties the sums. */
void lsf_bidirectional_shade_clear(lsf_bidirectional_shade *pass);
/* Adds the light of VPL `vpl` at the vertices of `region`: visible points, or deep ones. */
void lsf_bidirectional_shade_vpl(lsf_bidirectional_shade *pass, const lsf_iteration *iteration,
                                 const lsf_bidirectional_shade_inputs *inputs,
                                 const lsf_bidirectional_sample *sample, bool deep, uint32_t vpl,
                                 const lsf_region *region);
/* Adds the light that the current bundle brings to the vertices of `region`: `emission` of the
 * surfaces that it met, and the `light` that these reflect. The hits then become the vertices. */
void lsf_bidirectional_shade_hit(lsf_bidirectional_shade *pass, const lsf_iteration *iteration,
                                 const lsf_bidirectional_shade_inputs *inputs,
                                 const lsf_bidirectional_sample *sample, bool deep, bool emission,
                                 bool light, const lsf_region *region);
void lsf_bidirectional_shade_destroy(lsf_bidirectional_shade *pass);

#endif
