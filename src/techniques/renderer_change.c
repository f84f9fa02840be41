#include "techniques/renderer_parts.h"

#include <string.h>

#include "base/base.h"

/* The state of a new renderer. */
static void begin_anew(lsf_renderer *renderer)
{
    renderer->finished = renderer->broken = renderer->grain_checked = false;
    renderer->begun = renderer->unchanged = renderer->stopped = false;
    renderer->samples = renderer->kept = renderer->next = 0;
}

/* The scene on the GPU goes over to another plan; where it is of other triangles, it is made anew.
 */
static bool follow_scene(lsf_renderer *renderer, const lsf_setup *old, lsf_error *error)
{
    lsf_setup *setup = &renderer->setup;
    const lsf_state *previous = lsf_setup_previous(setup);
    if (renderer->scene.context && old->scene == setup->scene)
        return lsf_scene_gpu_replan(&renderer->scene, old->plan, setup->plan, &setup->state,
                                    previous, error);
    lsf_scene_gpu_destroy(&renderer->scene);
    return lsf_scene_gpu_create(&renderer->scene, renderer->context, setup->plan, setup->scene,
                                &setup->state, previous, error);
}

static bool change_plan(lsf_renderer *renderer, const lsf_render_params *params, lsf_error *error)
{
    lsf_setup next;
    double start = lsf_now();
    if (!lsf_setup_init(&next, renderer->setup.source, params, renderer->setup.software, error)) {
        lsf_setup_finish(&next);
        return false;
    }
    lsf_renderer_destroy_technique(renderer);
    lsf_setup old = renderer->setup;
    renderer->setup = next;
    /* The parameters' pointers are to the setup itself. */
    lsf_setup *setup = &renderer->setup;
    if (params->camera_position)
        setup->params.camera_position = setup->camera_position;
    if (params->camera_target)
        setup->params.camera_target = setup->camera_target;
    begin_anew(renderer);
    bool good = lsf_plan_check(setup->plan, renderer->context, error) &&
                follow_scene(renderer, &old, error) &&
                lsf_renderer_create_technique(renderer, error) &&
                lsf_context_check(renderer->context, error);
    lsf_setup_finish(&old);
    renderer->broken = !good;
    if (good)
        lsf_renderer_log_remarks(setup->plan);
    else /* it may fit neither plan */
        lsf_scene_gpu_destroy(&renderer->scene);
    renderer->compile_seconds = lsf_now() - start;
    return good;
}

bool lsf_renderer_change(lsf_renderer *renderer, const lsf_render_params *params, lsf_error *error)
{
    bool alike;
    if (!lsf_given(renderer, "renderer", error) || !lsf_given(params, "params", error))
        return false;
    LSF_LEAVE lsf_context *entered = lsf_context_enter(renderer->context, error);
    if (!entered || !lsf_setup_plans_alike(&renderer->setup, params, &alike, error))
        return false;
    if (!alike || renderer->broken)
        return change_plan(renderer, params, error);
    if (!lsf_setup_take(&renderer->setup, params, error))
        return false;
    const lsf_frame frame = {.time = params->time, .first_sample = 0, .cut = true};
    return lsf_renderer_begin_frame(renderer, &frame, error);
}
