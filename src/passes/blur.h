/* Blurs light that was traced with few samples, more on rougher surfaces. See blur.md. */
#ifndef LSF_PASSES_BLUR_H
#define LSF_PASSES_BLUR_H

#include "frame/iteration.h"
#include "frame/maps.h"
#include "plan/option.h"

typedef struct lsf_blur_params {
    int32_t phases;      /* 0: no blur */
    float step;          /* between the taps of the first phase at the viewer [texels] */
    float ratio;         /* ratio of a phase's step to the one before */
    float growth;        /* growth of the last phase's step with each half extent of the scene from
                          * the viewer */
    float min_roughness; /* below it the specular part is left alone */
    float cutoff;        /* taps further than this many steps in space are dropped */
    float slope; /* taps that rise from the surface by more than this share of their distance are
                  * dropped as well */
    float normal_weight; /* exponent of the cosine between normals */
} lsf_blur_params;

#define LSF_BLUR_PARAMS_DEFAULTS                                                                   \
    .phases = 0, .step = 1.0f, .ratio = 1.5f, .growth = 0.25f, .min_roughness = 0.1f,              \
    .cutoff = 6.0f, .slope = 0.25f, .normal_weight = 4.0f

#define LSF_BLUR_OPTION_COUNT 1
extern const lsf_option_row lsf_blur_options[LSF_BLUR_OPTION_COUNT];

/* Whether light is to be blurred; notes in the plan where that is a bias. */
bool lsf_blur_wanted(const lsf_blur_params *params);
void lsf_blur_remark(lsf_plan *plan, const lsf_blur_params *params);

typedef struct lsf_blur_inputs {
    const lsf_surface_maps *seen; /* by the picture's pixels */
    const lsf_split_light *light; /* of the iteration's points */
} lsf_blur_inputs;

typedef struct lsf_blur {
    lsf_context *context;
    lsf_blur_params params;
    lsf_split_light light;   /* output */
    lsf_split_light between; /* blurred along x */
    GLuint guide;            /* positions, normals and phases */
    GLuint framebuffer, between_framebuffer, guide_framebuffer;
    GLuint program, guide_program;
    lsf_timer *timer;
} lsf_blur;

/* Lists "blur_guide" and "blur" for light of the plan's points, where it is to be blurred. Needs
 * the G-buffer's plan. */
void lsf_blur_plan(lsf_plan *plan, const lsf_blur_params *params);
bool lsf_blur_create(lsf_blur *pass, lsf_context *context, const lsf_plan *plan,
                     const lsf_blur_params *params, lsf_error *error);
void lsf_blur_run(lsf_blur *pass, const lsf_iteration *iteration, const lsf_blur_inputs *inputs);
void lsf_blur_destroy(lsf_blur *pass);

#endif
