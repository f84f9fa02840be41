/* The decisions made before GL is needed: options, the state of the scene, the plan. */
#ifndef LSF_TECHNIQUES_SETUP_H
#define LSF_TECHNIQUES_SETUP_H

#include "denoiser/net.h"
#include "passes/accumulate.h"
#include "scene/layer.h"
#include "scene/state.h"
#include "techniques/technique.h"

/* The properties of the scene and its state that decide on a plan, beside the parameters. */
typedef struct lsf_plan_basis {
    lsf_requirements requirements;
    uint32_t lights[LSF_LIGHT_DIRECTIONAL + 1]; /* of each type */
    bool shines;                                /* some light is on */
    uint64_t movable;                           /* number of nodes that were edited */
    bool divided;                               /* into islands, for maps over all of it */
    bool orthographic;
    bool open; /* the environment, and no lamp, lights a scene that is seen from outside */
    uint32_t width, height;
} lsf_plan_basis;

typedef struct lsf_setup {
    const lsf_technique *technique;
    lsf_render_params params; /* the camera and the strings that it points to are owned */
    float camera_position[3], camera_target[3];
    lsf_pass_params asked;       /* as given by `params` */
    lsf_pass_params pass_params; /* the same, with what was chosen for the rest */
    bool software;               /* OpenGL runs on the processor */
    const lsf_scene *source;     /* the caller's */
    const lsf_scene *scene;      /* the scene that is drawn: the caller's, or `tessellated` */
    lsf_scene *tessellated;      /* NULL unless tessellation.factor is above 1 */
    lsf_state state;
    lsf_state previous;  /* the state of the frame before, from which motion is measured */
    lsf_changes changes; /* from that one */
    lsf_plan_basis basis;
    lsf_net *net; /* NULL: light_filter takes its steps alone */
    lsf_plan *plan;
    uint32_t layer_count;                     /* number of layers of the result; the first is the
                                               * picture */
    const char *layer_names[LSF_LAYER_COUNT]; /* "picture", "albedo", ... */
    uint32_t layer_aovs[LSF_LAYER_COUNT];     /* 0 for the picture */
} lsf_setup;

/* Options, scene, state, and a plan that lists what the scene takes, without a technique.
 * LSF_ERROR_USAGE names what is wrong with `params`. Finish it in either case, before `scene`.
 * `software`: OpenGL runs on the processor, where a time limit leaves room for less. */
bool lsf_setup_begin(lsf_setup *setup, const lsf_scene *scene, const lsf_render_params *params,
                     bool software, lsf_error *error);
/* The same with the technique's whole plan. */
bool lsf_setup_init(lsf_setup *setup, const lsf_scene *scene, const lsf_render_params *params,
                    bool software, lsf_error *error);
/* Whether the plan would be the same with `params`. */
bool lsf_setup_plans_alike(const lsf_setup *setup, const lsf_render_params *params, bool *alike,
                           lsf_error *error);
/* Takes over parameters that lead to the same plan. */
bool lsf_setup_take(lsf_setup *setup, const lsf_render_params *params, lsf_error *error);
/* Goes over to the state of another frame, and sets what has changed. The plan stays: whether it
 * still fits is what lsf_setup_fits says. On failure the state is that of the frame before. */
bool lsf_setup_frame(lsf_setup *setup, const lsf_frame *frame, lsf_error *error);
bool lsf_setup_fits(const lsf_setup *setup);
/* Makes a plan for the state as it is, and sets `old` to the one before, which the caller destroys.
 */
bool lsf_setup_replan(lsf_setup *setup, lsf_plan **old, lsf_error *error);
/* The state that motion is measured from; NULL where nothing asks for motion. */
const lsf_state *lsf_setup_previous(const lsf_setup *setup);
void lsf_setup_finish(lsf_setup *setup);

#endif
