/* Everything that is decided before GL is needed: options, the state of the scene, the plan. */
#ifndef LSF_TECHNIQUES_SETUP_H
#define LSF_TECHNIQUES_SETUP_H

#include "passes/accumulate.h"
#include "scene/state.h"
#include "techniques/technique.h"

/* The layer of coverage, beside those of lsf_aov: channel A of the picture. */
#define LSF_LAYER_COVERAGE (1u << 31)

typedef struct lsf_setup {
    const lsf_technique *technique;
    lsf_pass_params pass_params;
    const lsf_scene *scene; /* that is drawn: the caller's, or `tessellated` */
    lsf_scene *tessellated; /* NULL unless tessellation.factor is above 1 */
    lsf_state state;
    lsf_state previous; /* that motion is measured from; only when motion is asked for */
    lsf_plan *plan;
    uint32_t layer_count; /* of the result; the first is the picture */
    const char *layer_names[LSF_ACCUMULATE_MAX_LAYERS]; /* "picture", "albedo", ... */
    uint32_t layer_aovs[LSF_ACCUMULATE_MAX_LAYERS];     /* 0 for the picture */
} lsf_setup;

/* Options, scene, state, and a plan that lists what the scene takes, without a technique.
 * LSF_ERROR_USAGE names what is wrong with `params`. Finish it in either case, before `scene`. */
bool lsf_setup_begin(lsf_setup *setup, const lsf_scene *scene, const lsf_render_params *params,
                     lsf_error *error);
/* The same with the technique's whole plan. */
bool lsf_setup_init(lsf_setup *setup, const lsf_scene *scene, const lsf_render_params *params,
                    lsf_error *error);
void lsf_setup_finish(lsf_setup *setup);

#endif
