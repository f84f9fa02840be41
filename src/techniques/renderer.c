#include "techniques/renderer_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "techniques/grain.h"

/* Seconds between two questions whether a long iteration shall go on. */
#define QUESTION_EVERY 0.1

lsf_context *lsf_renderer_enter(lsf_renderer *renderer, lsf_error *error)
{
    if (renderer->broken) {
        lsf_error_set(error, LSF_ERROR_RENDER,
                      "the renderer has no frame since going over to one has failed; begin "
                      "another frame or destroy it");
        return NULL;
    }
    return lsf_context_enter(renderer->context, error);
}

/* --- making, and going over to another plan --- */

static bool create_filter(lsf_renderer *renderer, lsf_error *error)
{
    const lsf_setup *setup = &renderer->setup;
    return !lsf_plan_find_pass(setup->plan, "light_filter") ||
           (lsf_light_mean_create(&renderer->light_mean, renderer->context, setup->plan, error) &&
            lsf_light_filter_create(&renderer->light_filter, renderer->context, setup->plan,
                                    &setup->pass_params.light_filter, error));
}

/* What depends on the plan but for the scene on the GPU. */
static bool create_technique(lsf_renderer *renderer, lsf_error *error)
{
    lsf_setup *setup = &renderer->setup;
    lsf_context *context = renderer->context;
    renderer->iterations = 0;
    return lsf_iteration_create(&renderer->iteration, context, setup->plan, &renderer->scene,
                                &setup->state, lsf_setup_previous(setup), setup->params.seed,
                                error) &&
           setup->technique->create(&renderer->technique, context, setup->plan, &setup->pass_params,
                                    &renderer->scene, &setup->state, error) &&
           lsf_accumulate_create(&renderer->accumulate, context, setup->plan, setup->layer_count,
                                 setup->layer_names, error) &&
           create_filter(renderer, error) &&
           (!(setup->params.rgb8 || setup->params.present) ||
            lsf_tonemap_create(&renderer->tonemap, context, setup->plan, setup->params.rgb8,
                               error));
}

static void destroy_technique(lsf_renderer *renderer)
{
    lsf_tonemap_destroy(&renderer->tonemap);
    lsf_light_filter_destroy(&renderer->light_filter);
    lsf_light_mean_destroy(&renderer->light_mean);
    lsf_accumulate_destroy(&renderer->accumulate);
    if (renderer->setup.technique)
        renderer->setup.technique->destroy(renderer->technique);
    renderer->technique = NULL;
    renderer->outputs = (lsf_technique_outputs){0};
    lsf_iteration_destroy(&renderer->iteration);
}

static void log_remarks(const lsf_plan *plan)
{
    for (uint64_t i = 0; i < plan->remark_count; i++)
        lsf_log(LSF_LOG_INFO, "%s", plan->remarks[i]);
}

static bool create_resources(lsf_renderer *renderer, lsf_error *error)
{
    lsf_setup *setup = &renderer->setup;
    double start = lsf_now();
    if (!lsf_plan_check(setup->plan, renderer->context, error) ||
        !lsf_scene_gpu_create(&renderer->scene, renderer->context, setup->plan, setup->scene,
                              &setup->state, lsf_setup_previous(setup), error))
        return false;
    double uploaded = lsf_now();
    if (!create_technique(renderer, error))
        return false;
    renderer->upload_seconds = uploaded - start;
    renderer->compile_seconds = lsf_now() - uploaded;
    return lsf_context_check(renderer->context, error);
}

lsf_renderer *lsf_renderer_create(lsf_context *context, const lsf_scene *scene,
                                  const lsf_render_params *params, lsf_error *error)
{
    if (!lsf_given(context, "context", error))
        return NULL;
    lsf_renderer *renderer = lsf_alloc(1, sizeof *renderer);
    if (!renderer) {
        lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
        return NULL;
    }
    renderer->context = context;
    LSF_LEAVE lsf_context *entered = NULL;
    if (!lsf_setup_init(&renderer->setup, scene, params, error) ||
        !(entered = lsf_context_enter(context, error)) || !create_resources(renderer, error)) {
        lsf_renderer_destroy(renderer);
        return NULL;
    }
    log_remarks(renderer->setup.plan);
    return renderer;
}

void lsf_renderer_destroy(lsf_renderer *renderer)
{
    if (!renderer)
        return;
    /* Without its context nothing of GL can be given back. */
    LSF_LEAVE lsf_context *entered = lsf_context_enter(renderer->context, NULL);
    if (entered) {
        destroy_technique(renderer);
        lsf_scene_gpu_destroy(&renderer->scene);
    }
    lsf_setup_finish(&renderer->setup);
    free(renderer);
}

/* Goes over to the plan of the state as it is. The scene stays on the GPU. */
static bool replan(lsf_renderer *renderer, lsf_error *error)
{
    lsf_setup *setup = &renderer->setup;
    lsf_plan *old = NULL;
    double start = lsf_now();
    destroy_technique(renderer);
    bool planned = lsf_setup_replan(setup, &old, error) &&
                   lsf_plan_check(setup->plan, renderer->context, error);
    const lsf_state *previous = lsf_setup_previous(setup);
    bool good = planned &&
                (renderer->scene.context
                     ? lsf_scene_gpu_replan(&renderer->scene, old, setup->plan, &setup->state,
                                            previous, error)
                     : lsf_scene_gpu_create(&renderer->scene, renderer->context, setup->plan,
                                            setup->scene, &setup->state, previous, error)) &&
                create_technique(renderer, error);
    lsf_plan_destroy(old);
    if (!good) /* it may be of neither plan */
        lsf_scene_gpu_destroy(&renderer->scene);
    renderer->compile_seconds += lsf_now() - start;
    if (good)
        log_remarks(setup->plan);
    return good;
}

/* --- frames --- */

/* Brings what follows the state up to date; makes another plan where this one does not fit. */
static bool follow_state(lsf_renderer *renderer, const lsf_frame *frame, lsf_error *error)
{
    lsf_setup *setup = &renderer->setup;
    const lsf_technique *technique = setup->technique;
    const lsf_state *previous = lsf_setup_previous(setup);
    lsf_update update = LSF_UPDATE_REPLAN;
    if (renderer->technique && lsf_setup_fits(setup)) {
        lsf_scene_gpu_update(&renderer->scene, &setup->state, previous);
        lsf_iteration_frame(&renderer->iteration, &setup->state, previous, frame->first_sample);
        update = technique->update ? technique->update(renderer->technique, &setup->pass_params,
                                                       &renderer->iteration, &setup->changes)
                                   : LSF_UPDATE_DONE;
    }
    if (update == LSF_UPDATE_FAILED)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for a frame");
    if (update == LSF_UPDATE_REPLAN && !replan(renderer, error))
        return false;
    if (update == LSF_UPDATE_REPLAN)
        lsf_iteration_frame(&renderer->iteration, &setup->state, previous, frame->first_sample);
    return lsf_context_check(renderer->context, error);
}

bool lsf_renderer_begin_frame(lsf_renderer *renderer, const lsf_frame *frame, lsf_error *error)
{
    if (!lsf_given(renderer, "renderer", error) || !lsf_given(frame, "frame", error))
        return false;
    LSF_LEAVE lsf_context *entered = lsf_context_enter(renderer->context, error);
    if (!entered || !lsf_setup_frame(&renderer->setup, frame, error))
        return false;
    renderer->samples = renderer->next = 0;
    renderer->broken = !follow_state(renderer, frame, error);
    return !renderer->broken;
}

bool lsf_renderer_resize(lsf_renderer *renderer, uint32_t width, uint32_t height,
                         const lsf_frame *frame, lsf_error *error)
{
    if (!lsf_given(renderer, "renderer", error) || !lsf_given(frame, "frame", error))
        return false;
    lsf_render_params *params = &renderer->setup.params;
    const uint32_t old[2] = {params->width, params->height};
    if (width == 0 || height == 0)
        return lsf_error_set(error, LSF_ERROR_USAGE, "resolution %u,%u: both must be at least 1",
                             width, height);
    params->width = width;
    params->height = height;
    bool resized = lsf_renderer_begin_frame(renderer, frame, error);
    if (!resized && !renderer->broken) {
        params->width = old[0];
        params->height = old[1];
    }
    return resized;
}

const lsf_plan *lsf_renderer_plan(const lsf_renderer *renderer)
{
    if (!renderer)
        return NULL;
    return renderer->setup.plan;
}

/* --- iterations --- */

GLuint lsf_renderer_layer(const lsf_technique_outputs *outputs, uint32_t aov)
{
    const lsf_gbuffer_maps *gbuffer = outputs->parts.gbuffer;
    if (!gbuffer)
        return 0; /* no iteration has run */
    switch (aov) {
    case LSF_AOV_ALBEDO:
    case LSF_AOV_NORMAL:
        return gbuffer->seen.surface;
    case LSF_AOV_DEPTH:
        return gbuffer->seen.depth;
    case LSF_LAYER_COVERAGE:
        return outputs->layers.coverage;
    case LSF_AOV_EMISSION:
        return outputs->layers.emission;
    case LSF_AOV_DIRECT:
        return outputs->layers.direct;
    case LSF_AOV_INDIRECT_DIFFUSE:
        return outputs->layers.indirect_diffuse;
    case LSF_AOV_INDIRECT_SPECULAR:
        return outputs->layers.indirect_specular;
    case LSF_AOV_MOTION:
        return gbuffer->motion;
    case LSF_AOV_VOXEL_ALBEDO:
        return outputs->voxels.albedo;
    case LSF_AOV_VOXEL_NORMAL:
        return outputs->voxels.normal;
    case LSF_AOV_VOXEL_RADIANCE:
        return outputs->voxels.radiance;
    default:
        return outputs->layers.picture;
    }
}

GLuint lsf_renderer_picture(lsf_renderer *renderer)
{
    const lsf_light_mean *mean = &renderer->light_mean;
    if (!renderer->light_filter.timer || renderer->samples == 0)
        return renderer->accumulate.means[0];
    if (!renderer->filtered) {
        const lsf_light_filter_inputs inputs = {
            .guide = mean->guide,
            .half = mean->half,
            .half_count = lsf_light_mean_half(renderer->samples),
            .picture = renderer->accumulate.means[0],
            .kernel = renderer->outputs.kernel,
            .parts = {{mean->diffuse.light, mean->diffuse.factor},
                      {mean->specular.light, mean->specular.factor}}};
        lsf_light_filter_run(&renderer->light_filter, &renderer->iteration, renderer->samples,
                             &inputs);
    }
    renderer->filtered = true;
    return renderer->light_filter.picture;
}

static void run_iteration(lsf_renderer *renderer)
{
    GLuint layers[LSF_LAYER_COUNT];
    const lsf_setup *setup = &renderer->setup;
    lsf_iteration_begin(&renderer->iteration, renderer->next);
    setup->technique->run(renderer->technique, &renderer->iteration, &renderer->outputs);
    if (renderer->stopped)
        return;
    for (uint32_t i = 0; i < setup->layer_count; i++)
        layers[i] = lsf_renderer_layer(&renderer->outputs, setup->layer_aovs[i]);
    lsf_accumulate_run(&renderer->accumulate, &renderer->iteration, layers,
                       renderer->outputs.parts.gbuffer->seen.depth, renderer->outputs.gate);
    if (renderer->light_mean.timer)
        lsf_light_mean_run(&renderer->light_mean, &renderer->iteration, &renderer->outputs.parts,
                           renderer->outputs.gate);
    renderer->filtered = false;
    renderer->next++;
}

/* Whether all that ran went into the means, as far as it is known. If not, `next` goes back: of the
 * frames before nothing is run again. */
static bool settle(lsf_renderer *renderer, bool wait)
{
    const lsf_technique *technique = renderer->setup.technique;
    uint32_t before = renderer->iteration.serial_before, done;
    if (renderer->next == 0 || !technique->settle ||
        technique->settle(renderer->technique, &renderer->iteration, wait, &done))
        return true;
    renderer->next = done > before ? done - before : 0;
    return false;
}

bool lsf_renderer_catch_up(lsf_renderer *renderer, bool wait, lsf_error *error)
{
    double start = lsf_now();
    do {
        while (renderer->next < renderer->samples && !renderer->stopped) {
            run_iteration(renderer);
            if (!lsf_context_check(renderer->context, error))
                return false;
        }
        if (renderer->stopped)
            renderer->samples = renderer->next;
    } while (!settle(renderer, wait));
    renderer->render_seconds += lsf_now() - start;
    return lsf_context_check(renderer->context, error);
}

bool lsf_renderer_iterate(lsf_renderer *renderer, lsf_error *error)
{
    if (!lsf_given(renderer, "renderer", error))
        return false;
    LSF_LEAVE lsf_context *entered = lsf_renderer_enter(renderer, error);
    if (!entered)
        return false;
    renderer->stopped = false;
    renderer->samples++;
    renderer->iterations++;
    return lsf_renderer_catch_up(renderer, false, error);
}

/* Until the GPU is done: what was handed to it so far counts as rendered. */
static void wait_for_gpu(lsf_renderer *renderer)
{
    double start = lsf_now();
    glFinish();
    renderer->render_seconds += lsf_now() - start;
}

static bool wants_more(const lsf_renderer *renderer, uint32_t done)
{
    const lsf_render_params *params = &renderer->setup.params;
    return !params->progress || params->progress(done, params->samples, params->progress_user);
}

/* Within an iteration. The limit leaves the first one whole: a late picture is better than none. */
static bool goes_on(void *user)
{
    lsf_renderer *renderer = user;
    if (renderer->stopped || lsf_now() < renderer->next_question)
        return !renderer->stopped;
    glFinish(); /* or the question would be about commands that are given, not about work */
    renderer->stopped = (renderer->next > 0 && lsf_now() >= renderer->deadline) ||
                        !wants_more(renderer, renderer->next);
    renderer->next_question = lsf_now() + QUESTION_EVERY;
    return !renderer->stopped;
}

static bool run_until_stopped(lsf_renderer *renderer, lsf_error *error)
{
    const lsf_render_params *params = &renderer->setup.params;
    bool limited = isfinite(params->time_limit);
    while (renderer->samples < params->samples) {
        renderer->next_question = lsf_now() + QUESTION_EVERY;
        if (!lsf_renderer_iterate(renderer, error))
            return false;
        if (renderer->stopped || !wants_more(renderer, renderer->samples))
            break;
        /* A GPU takes commands faster than it runs them: without this, the limit would be one on
         * commands given. */
        if (limited)
            wait_for_gpu(renderer);
        if (lsf_now() >= renderer->deadline)
            break;
    }
    wait_for_gpu(renderer);
    return lsf_renderer_catch_up(renderer, true, error);
}

bool lsf_renderer_run(lsf_renderer *renderer, lsf_error *error)
{
    if (!lsf_given(renderer, "renderer", error))
        return false;
    LSF_LEAVE lsf_context *entered = lsf_renderer_enter(renderer, error);
    if (!entered)
        return false;
    renderer->deadline = lsf_now() + renderer->setup.params.time_limit;
    renderer->iteration.question = goes_on;
    renderer->iteration.question_user = renderer;
    bool good = run_until_stopped(renderer, error);
    renderer->iteration.question = NULL;
    if (good && !renderer->grain_checked && renderer->samples > 0) {
        lsf_grain_check(&renderer->iteration, renderer->outputs.parts.gbuffer->seen.depth);
        renderer->grain_checked = true;
    }
    return good;
}
