#include "techniques/renderer_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "techniques/grain.h"

/* Seconds between two checks whether a long iteration is to go on. */
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

/* --- creation, and the change to another plan --- */

/* Creates the passes that work on the mean of split light. */
static bool create_filters(lsf_renderer *renderer, lsf_error *error)
{
    const lsf_setup *setup = &renderer->setup;
    lsf_plan *plan = setup->plan;
    lsf_context *context = renderer->context;
    const lsf_pass_params *params = &setup->pass_params;
    uint32_t tiles = (uint32_t)(params->sparse.interleave * params->sparse.interleave);
    return (!lsf_plan_find_pass(plan, "light_mean") ||
            lsf_light_mean_create(&renderer->light_mean, context, plan, error)) &&
           (!lsf_plan_find_pass(plan, "light_guide") ||
            lsf_light_guide_create(&renderer->light_guide, context, plan, error)) &&
           (!lsf_plan_find_pass(plan, "temporal") ||
            lsf_temporal_create(&renderer->temporal, context, plan, &params->temporal,
                                plan->tiles > 1 ? tiles : 0, error)) &&
           (!lsf_plan_find_pass(plan, "light_filter") ||
            lsf_light_filter_create(&renderer->light_filter, context, plan, &params->light_filter,
                                    error)) &&
           (!lsf_plan_find_pass(plan, "denoise") ||
            lsf_denoise_create(&renderer->denoise, context, plan, &params->denoise, setup->net,
                               error));
}

bool lsf_renderer_create_technique(lsf_renderer *renderer, lsf_error *error)
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
           create_filters(renderer, error) &&
           (!(setup->params.rgb8 || setup->params.present) ||
            lsf_tonemap_create(&renderer->tonemap, context, setup->plan, setup->params.rgb8,
                               error));
}

void lsf_renderer_destroy_technique(lsf_renderer *renderer)
{
    lsf_tonemap_destroy(&renderer->tonemap);
    lsf_denoise_destroy(&renderer->denoise);
    lsf_light_filter_destroy(&renderer->light_filter);
    lsf_temporal_destroy(&renderer->temporal);
    lsf_light_guide_destroy(&renderer->light_guide);
    lsf_light_mean_destroy(&renderer->light_mean);
    lsf_accumulate_destroy(&renderer->accumulate);
    if (renderer->setup.technique)
        renderer->setup.technique->destroy(renderer->technique);
    renderer->technique = NULL;
    renderer->outputs = (lsf_technique_outputs){0};
    lsf_iteration_destroy(&renderer->iteration);
}

void lsf_renderer_log_remarks(const lsf_plan *plan)
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
    if (!lsf_renderer_create_technique(renderer, error))
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
    bool software = lsf_context_get_info(context).software;
    if (!lsf_setup_init(&renderer->setup, scene, params, software, error) ||
        !(entered = lsf_context_enter(context, error)) || !create_resources(renderer, error)) {
        lsf_renderer_destroy(renderer);
        return NULL;
    }
    lsf_renderer_log_remarks(renderer->setup.plan);
    return renderer;
}

void lsf_renderer_destroy(lsf_renderer *renderer)
{
    if (!renderer)
        return;
    /* Without its context nothing of GL can be given back. */
    LSF_LEAVE lsf_context *entered = lsf_context_enter(renderer->context, NULL);
    if (entered) {
        lsf_renderer_destroy_technique(renderer);
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
    lsf_renderer_destroy_technique(renderer);
    bool planned = lsf_setup_replan(setup, &old, error) &&
                   lsf_plan_check(setup->plan, renderer->context, error);
    const lsf_state *previous = lsf_setup_previous(setup);
    bool good = planned &&
                (renderer->scene.context
                     ? lsf_scene_gpu_replan(&renderer->scene, old, setup->plan, &setup->state,
                                            previous, error)
                     : lsf_scene_gpu_create(&renderer->scene, renderer->context, setup->plan,
                                            setup->scene, &setup->state, previous, error)) &&
                lsf_renderer_create_technique(renderer, error);
    lsf_plan_destroy(old);
    if (!good) /* it may fit neither plan */
        lsf_scene_gpu_destroy(&renderer->scene);
    renderer->compile_seconds += lsf_now() - start;
    if (good)
        lsf_renderer_log_remarks(setup->plan);
    return good;
}

/* --- the picture made of the mean --- */

/* Makes the guides of temporal and light_filter, for the mean of so many iterations. */
static void guide(lsf_renderer *renderer, uint32_t iterations)
{
    const lsf_light_mean *mean = &renderer->light_mean;
    const lsf_light_guide_inputs inputs = {.mean = mean->guide,
                                           .diffuse_factor = mean->diffuse.factor,
                                           .specular_factor = mean->specular.factor,
                                           .kernel = renderer->outputs.kernel};
    lsf_light_guide_run(&renderer->light_guide, renderer->setup.plan, iterations, &inputs);
}

static lsf_temporal_inputs temporal_inputs(const lsf_renderer *renderer)
{
    const lsf_light_mean *mean = &renderer->light_mean;
    return (lsf_temporal_inputs){.guide = renderer->light_guide.maps,
                                 .motion = renderer->outputs.parts.gbuffer->motion,
                                 .picture = renderer->accumulate.means[0],
                                 .parts = {{mean->diffuse.light, mean->diffuse.factor},
                                           {mean->specular.light, mean->specular.factor}}};
}

/* What the network makes of filtered light; the light itself where there is none. */
static const GLuint *denoise(lsf_renderer *renderer, const lsf_light_filter_inputs *filter)
{
    const lsf_light_mean *mean = &renderer->light_mean;
    const GLuint *light = renderer->light_filter.light, *done = renderer->light_filter.filtered;
    if (!renderer->denoise.timer)
        return done;
    const lsf_denoise_inputs inputs = {
        .mean = mean->guide,
        .specular_factor = mean->specular.factor,
        .light = {light[0], light[1]},
        .filtered = {done[0], done[1]},
        .factors = {filter->parts[0].factor, filter->parts[1].factor}};
    lsf_denoise_run(&renderer->denoise, &renderer->iteration, &inputs);
    return renderer->denoise.net ? renderer->denoise.light : done;
}

static void filter(lsf_renderer *renderer, GLuint picture)
{
    const lsf_light_mean *mean = &renderer->light_mean;
    const lsf_temporal_part *kept = renderer->temporal.parts;
    bool temporal = renderer->temporal.timer;
    const lsf_light_filter_inputs inputs = {
        .guide = renderer->light_guide.maps,
        .half = temporal ? 0 : mean->half, /* the mean holds more than the frame's iterations */
        .half_count = lsf_light_mean_half(renderer->samples),
        .picture = picture,
        .parts = {{temporal ? kept[0].light : mean->diffuse.light, mean->diffuse.factor},
                  {temporal ? kept[1].light : mean->specular.light, mean->specular.factor}}};
    /* One iteration has no variance of its own, but with light of the frames before. */
    uint32_t iterations = temporal && renderer->samples == 1 ? 2 : renderer->samples;
    lsf_light_filter_run(&renderer->light_filter, &renderer->iteration, iterations, &inputs);
    const GLuint *done = denoise(renderer, &inputs);
    const GLuint blended[2] = {kept[0].denoised, kept[1].denoised};
    if (blended[0]) {
        lsf_temporal_blend_denoised(&renderer->temporal, renderer->setup.plan, renderer->samples,
                                    done);
        done = blended;
    }
    lsf_light_filter_finish(&renderer->light_filter, &renderer->iteration, iterations, &inputs,
                            done);
}

GLuint lsf_renderer_picture(lsf_renderer *renderer)
{
    GLuint picture = renderer->accumulate.means[0];
    bool finished = renderer->finished || renderer->samples == 0;
    if (renderer->light_guide.timer && !finished)
        guide(renderer, renderer->samples);
    if (renderer->temporal.timer && renderer->samples > 0) {
        const lsf_temporal_inputs inputs = temporal_inputs(renderer);
        if (!finished)
            lsf_temporal_blend(&renderer->temporal, &renderer->iteration, renderer->samples,
                               &inputs);
        picture = renderer->temporal.picture;
    }
    if (renderer->light_filter.timer && renderer->samples > 0) {
        if (!finished)
            filter(renderer, picture);
        picture = renderer->light_filter.picture;
    }
    if (renderer->temporal.timer && renderer->samples > 0) {
        if (!finished)
            lsf_temporal_resolve(&renderer->temporal, renderer->setup.plan, renderer->samples,
                                 picture);
        picture = renderer->temporal.resolved;
    }
    renderer->finished = true;
    return picture;
}

/* Finishes a frame whose picture nobody has asked for. */
static bool keep_light(lsf_renderer *renderer, lsf_error *error)
{
    if (!renderer->temporal.timer || renderer->finished || renderer->samples == 0)
        return true;
    if (!lsf_renderer_catch_up(renderer, true, error))
        return false;
    lsf_renderer_picture(renderer);
    return true;
}

/* --- frames --- */

/* Updates what depends on the state; makes another plan where this one does not fit. */
static bool follow_state(lsf_renderer *renderer, uint32_t first_sample, lsf_error *error)
{
    lsf_setup *setup = &renderer->setup;
    const lsf_technique *technique = setup->technique;
    const lsf_state *previous = lsf_setup_previous(setup);
    lsf_update update = LSF_UPDATE_REPLAN;
    if (renderer->technique && lsf_setup_fits(setup)) {
        lsf_scene_gpu_update(&renderer->scene, &setup->state, previous);
        lsf_iteration_frame(&renderer->iteration, &setup->state, previous, first_sample);
        if (setup->changes.environment && !lsf_iteration_update_sky(&renderer->iteration))
            return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the environment");
        update = technique->update ? technique->update(renderer->technique, &setup->pass_params,
                                                       &renderer->iteration, &setup->changes)
                                   : LSF_UPDATE_DONE;
    }
    if (update == LSF_UPDATE_FAILED)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for a frame");
    if (update == LSF_UPDATE_REPLAN && !replan(renderer, error))
        return false;
    if (update == LSF_UPDATE_REPLAN)
        lsf_iteration_frame(&renderer->iteration, &setup->state, previous, first_sample);
    return lsf_context_check(renderer->context, error);
}

/* Whether the mean of the frame before is one of this frame as well. */
static bool goes_on(lsf_renderer *renderer, const lsf_frame *frame)
{
    const lsf_setup *setup = &renderer->setup;
    const lsf_changes *changes = &setup->changes;
    bool before = renderer->unchanged;
    renderer->unchanged =
        !(changes->view || changes->moved || changes->shining || changes->materials);
    return setup->params.temporal && !frame->cut && !renderer->broken && renderer->samples > 0 &&
           renderer->unchanged && (before || !(setup->params.aovs & LSF_AOV_MOTION)) &&
           lsf_setup_fits(setup);
}

static void go_on(lsf_renderer *renderer)
{
    lsf_setup *setup = &renderer->setup;
    lsf_scene_gpu_update(&renderer->scene, &setup->state, lsf_setup_previous(setup));
    renderer->iteration.previous_camera = setup->state.camera;
    renderer->kept = renderer->samples;
    if (renderer->temporal.timer)
        lsf_temporal_go_on(&renderer->temporal);
}

/* Frames that keep light of those before need other random numbers than they had. */
static uint32_t first_sample_of(const lsf_renderer *renderer, const lsf_frame *frame)
{
    if (!renderer->setup.params.temporal || frame->cut || !renderer->begun)
        return frame->first_sample;
    return renderer->iteration.first_index + renderer->samples;
}

bool lsf_renderer_begin_frame(lsf_renderer *renderer, const lsf_frame *frame, lsf_error *error)
{
    if (!lsf_given(renderer, "renderer", error) || !lsf_given(frame, "frame", error))
        return false;
    LSF_LEAVE lsf_context *entered = lsf_context_enter(renderer->context, error);
    if (!entered || !lsf_setup_frame(&renderer->setup, frame, error))
        return false;
    if (goes_on(renderer, frame)) {
        go_on(renderer);
        return lsf_context_check(renderer->context, error);
    }
    const lsf_changes *changes = &renderer->setup.changes;
    const lsf_temporal_change change = {.cut = frame->cut,
                                        .moved = changes->moved,
                                        .lights = changes->shining || changes->materials};
    uint32_t first_sample = first_sample_of(renderer, frame);
    bool good = frame->cut || renderer->broken || keep_light(renderer, error);
    renderer->samples = renderer->next = renderer->kept = 0;
    renderer->begun = renderer->begun && !frame->cut;
    renderer->broken = !good || !follow_state(renderer, first_sample, error);
    if (renderer->denoise.timer)
        lsf_denoise_begin(&renderer->denoise, frame->cut);
    if (renderer->temporal.timer)
        renderer->iteration.kept =
            lsf_temporal_begin(&renderer->temporal, &change, renderer->setup.params.samples,
                               &renderer->setup.state.camera);
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
    if (renderer->temporal.timer && renderer->next == 0) {
        const lsf_temporal_inputs inputs = temporal_inputs(renderer);
        guide(renderer, 1);
        lsf_temporal_carry(&renderer->temporal, &renderer->iteration, &inputs);
    }
    renderer->finished = false;
    renderer->begun = true;
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

/* Until the GPU is done: the time since then counts as rendered. */
static void wait_for_gpu(lsf_renderer *renderer, double since)
{
    glFinish();
    renderer->render_seconds += lsf_now() - since;
}

static bool wants_more(const lsf_renderer *renderer, uint32_t done)
{
    const lsf_render_params *params = &renderer->setup.params;
    return !params->progress ||
           params->progress(done - renderer->kept, params->samples, params->progress_user);
}

/* Called within an iteration. The limit does not cut the first one short: a late picture is better
 * than none. */
static bool goes_further(void *user)
{
    lsf_renderer *renderer = user;
    if (renderer->stopped || lsf_now() < renderer->next_question)
        return !renderer->stopped;
    glFinish(); /* else the clock would measure commands that were issued, not work that was done */
    bool late = lsf_now() >= renderer->deadline + renderer->grace;
    renderer->stopped =
        (late && renderer->next > renderer->kept) || !wants_more(renderer, renderer->next);
    renderer->next_question = lsf_now() + QUESTION_EVERY;
    return !renderer->stopped;
}

/* 0 as long as only one iteration has run. */
static double compiled_seconds(const lsf_first_uses *uses)
{
    return uses->sum - uses->iterations * uses->least;
}

/* The time limit is one of rendering: it is put off while the driver compiles, by the seconds that
 * are returned; they are below 0 where too much was allowed before. `seconds`: of the calling
 * thread in the last iteration. */
static double allow_compilation(lsf_renderer *renderer, double seconds)
{
    enum { FIRST_ITERATIONS = 4 };
    lsf_first_uses *uses = &renderer->first_uses;
    if (!renderer->setup.software || uses->iterations == FIRST_ITERATIONS)
        return 0.0;
    uses->least = uses->iterations == 0 ? seconds : fmin(uses->least, seconds);
    uses->sum += seconds;
    uses->iterations++;
    double before = uses->allowed;
    uses->allowed = uses->iterations == 1 ? uses->sum : compiled_seconds(uses);
    renderer->deadline += uses->allowed - before;
    return uses->allowed - before;
}

/* Whether another iteration is likely to end before the limit or at most a quarter of its time
 * later, after which it is dropped. */
static bool leaves_time(lsf_renderer *renderer, double last_seconds)
{
    renderer->grace = 0.25 * last_seconds;
    return lsf_now() + last_seconds < renderer->deadline + renderer->grace;
}

static bool run_until_stopped(lsf_renderer *renderer, lsf_error *error)
{
    const lsf_render_params *params = &renderer->setup.params;
    bool limited = isfinite(params->time_limit);
    while (renderer->samples - renderer->kept < params->samples) {
        double start = lsf_now(), computed = lsf_thread_seconds();
        renderer->next_question = start + QUESTION_EVERY;
        if (!lsf_renderer_iterate(renderer, error))
            return false;
        if (renderer->stopped || !wants_more(renderer, renderer->samples))
            break;
        /* A GPU accepts commands faster than it runs them: without this the limit would apply to
         * commands issued. */
        if (limited)
            wait_for_gpu(renderer, lsf_now());
        double compiled = allow_compilation(renderer, lsf_thread_seconds() - computed);
        if (!leaves_time(renderer, lsf_now() - start - fmax(compiled, 0.0)))
            break;
        lsf_context_pause(renderer->context);
    }
    wait_for_gpu(renderer, lsf_now());
    if (!lsf_renderer_catch_up(renderer, true, error))
        return false;
    double finished = lsf_now();
    lsf_renderer_picture(renderer);
    wait_for_gpu(renderer, finished);
    return lsf_context_check(renderer->context, error);
}

bool lsf_renderer_run(lsf_renderer *renderer, lsf_error *error)
{
    if (!lsf_given(renderer, "renderer", error))
        return false;
    LSF_LEAVE lsf_context *entered = lsf_renderer_enter(renderer, error);
    if (!entered)
        return false;
    renderer->deadline = lsf_now() + renderer->setup.params.time_limit;
    renderer->first_uses = (lsf_first_uses){0};
    renderer->iteration.question = goes_further;
    renderer->iteration.question_user = renderer;
    bool good = run_until_stopped(renderer, error);
    double compiled = compiled_seconds(&renderer->first_uses);
    renderer->compile_seconds += compiled;
    renderer->render_seconds -= compiled;
    renderer->iteration.question = NULL;
    if (good && !renderer->grain_checked && renderer->samples > 0) {
        lsf_grain_check(&renderer->iteration, renderer->outputs.parts.gbuffer->seen.depth);
        renderer->grain_checked = true;
    }
    return good;
}
