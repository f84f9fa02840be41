#include "sandbox/sandbox.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "scene/checks.h"

/* --- what the caller gave, kept for as long as the shader is read again --- */

static char *keep_text(const char *text, bool *good)
{
    char *copy = text ? strdup(text) : NULL;
    *good = *good && (copy || !text);
    return copy;
}

static const char *const *keep_list(const char *const *list, uint32_t count, bool *good)
{
    char **copy = lsf_alloc((uint64_t)count + 1, sizeof *copy);
    *good = *good && copy;
    for (uint32_t i = 0; copy && i < count; i++)
        copy[i] = keep_text(list[i], good);
    return (const char *const *)copy;
}

static void free_list(const char *const *list, uint32_t count)
{
    for (uint32_t i = 0; list && i < count; i++)
        free((char *)list[i]);
    free((void *)list);
}

static const float *keep_point(float kept[3], const float *point)
{
    if (point)
        memcpy(kept, point, 3 * sizeof *kept);
    return point ? kept : NULL;
}

static bool keep_params(lsf_sandbox *sandbox, const lsf_sandbox_params *params, lsf_error *error)
{
    lsf_sandbox_params *kept = &sandbox->params;
    bool good = true;
    *kept = *params;
    kept->path = keep_text(params->path, &good);
    kept->text = keep_text(params->text, &good);
    kept->channels = keep_list(params->channels, params->channel_count, &good);
    kept->uniforms = keep_list(params->uniforms, params->uniform_count, &good);
    kept->render.options = keep_list(params->render.options, params->render.option_count, &good);
    kept->render.camera = keep_text(params->render.camera, &good);
    kept->render.technique = keep_text(params->render.technique, &good);
    kept->render.camera_position =
        keep_point(sandbox->camera_position, params->render.camera_position);
    kept->render.camera_target = keep_point(sandbox->camera_target, params->render.camera_target);
    return good || lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
}

static void free_params(lsf_sandbox_params *params)
{
    free((char *)params->path);
    free((char *)params->text);
    free_list(params->channels, params->channel_count);
    free_list(params->uniforms, params->uniform_count);
    free_list(params->render.options, params->render.option_count);
    free((char *)params->render.camera);
    free((char *)params->render.technique);
}

static bool check_params(const lsf_sandbox_params *params, lsf_error *error)
{
    if (!lsf_given(params, "params", error) ||
        !lsf_given(params->path, "lsf_sandbox_params.path", error))
        return false;
    if (params->render.width == 0 || params->render.height == 0)
        return lsf_error_set(error, LSF_ERROR_USAGE, "resolution %u,%u: both must be at least 1",
                             params->render.width, params->render.height);
    return true;
}

/* --- making --- */

/* Those of the plan that have the same size in all of them. */
static bool create_small_textures(lsf_sandbox *sandbox, lsf_error *error)
{
    const lsf_plan *plan = sandbox->version.stage->setup.plan;
    lsf_context *context = sandbox->context;
    bool good =
        (sandbox->keyboard || lsf_plan_create_texture_if_planned(plan, context, "sandbox.keyboard",
                                                                 &sandbox->keyboard, error)) &&
        (sandbox->black ||
         lsf_plan_create_texture(plan, context, "sandbox.black", &sandbox->black, error));
    if (good)
        glClearTexImage(sandbox->black, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    return good;
}

/* What depends on the plan's size and on what passes there are. */
static bool follow_plan(lsf_sandbox *sandbox, lsf_error *error)
{
    const lsf_plan *plan = sandbox->version.stage->setup.plan;
    lsf_tonemap_destroy(&sandbox->tonemap);
    lsf_sandbox_targets_destroy(sandbox, false);
    if (!sandbox->version.text.keyboard)
        lsf_texture_destroy(sandbox->context, &sandbox->keyboard);
    return create_small_textures(sandbox, error) && lsf_sandbox_targets_create(sandbox, error) &&
           (!sandbox->version.text.radiance ||
            lsf_tonemap_create(&sandbox->tonemap, sandbox->context, plan, true, error));
}

static bool create(lsf_sandbox *sandbox, lsf_error *error)
{
    const lsf_sandbox_params *params = &sandbox->params;
    if (!lsf_sandbox_version_make(&sandbox->version, sandbox->context, sandbox->scene, params, NULL,
                                  error) ||
        !follow_plan(sandbox, error))
        return false;
    for (uint32_t i = 0; i < params->uniform_count; i++)
        if (!lsf_sandbox_assign(sandbox, params->uniforms[i], error))
            return false;
    return lsf_context_check(sandbox->context, error);
}

lsf_sandbox *lsf_sandbox_create(lsf_context *context, const lsf_scene *scene,
                                const lsf_sandbox_params *params, lsf_error *error)
{
    if (!lsf_given(context, "context", error) || (scene && !lsf_scene_given(scene, error)) ||
        !check_params(params, error))
        return NULL;
    lsf_sandbox *sandbox = lsf_alloc(1, sizeof *sandbox);
    if (!sandbox) {
        lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
        return NULL;
    }
    sandbox->context = context;
    sandbox->scene = scene;
    LSF_LEAVE lsf_context *entered = NULL;
    if (!keep_params(sandbox, params, error) || !(entered = lsf_context_enter(context, error)) ||
        !create(sandbox, error)) {
        lsf_sandbox_destroy(sandbox);
        return NULL;
    }
    return sandbox;
}

void lsf_sandbox_destroy(lsf_sandbox *sandbox)
{
    if (!sandbox)
        return;
    LSF_LEAVE lsf_context *entered = lsf_context_enter(sandbox->context, NULL);
    if (entered) {
        lsf_tonemap_destroy(&sandbox->tonemap);
        lsf_sandbox_targets_destroy(sandbox, true);
        lsf_texture_destroy(sandbox->context, &sandbox->keyboard);
        lsf_texture_destroy(sandbox->context, &sandbox->black);
        lsf_sandbox_version_finish(&sandbox->version, sandbox->context);
    }
    lsf_sandbox_text_finish(&sandbox->failed);
    for (uint64_t i = 0; i < sandbox->value_count; i++)
        free(sandbox->values[i].name);
    free(sandbox->values);
    free_params(&sandbox->params);
    free(sandbox);
}

/* --- going on --- */

bool lsf_sandbox_changed(const lsf_sandbox *sandbox)
{
    if (!sandbox)
        return false;
    return lsf_sandbox_text_changed(sandbox->failed.file_count > 0 ? &sandbox->failed
                                                                   : &sandbox->version.text);
}

bool lsf_sandbox_reload(lsf_sandbox *sandbox, lsf_error *error)
{
    if (!lsf_given(sandbox, "sandbox", error))
        return false;
    LSF_LEAVE lsf_context *entered = lsf_context_enter(sandbox->context, error);
    if (!entered)
        return false;
    lsf_sandbox_version version;
    lsf_sandbox_text_finish(&sandbox->failed);
    if (!lsf_sandbox_version_make(&version, sandbox->context, sandbox->scene, &sandbox->params,
                                  &sandbox->version, error)) {
        sandbox->failed = version.text;
        return false;
    }
    lsf_sandbox_version_keep(&version, &sandbox->version);
    lsf_sandbox_version_finish(&sandbox->version, sandbox->context);
    sandbox->version = version;
    if (!follow_plan(sandbox, error))
        return false;
    lsf_sandbox_apply_values(sandbox);
    return lsf_context_check(sandbox->context, error);
}

/* Makes everything anew, for another size or an edited scene. */
static bool remake(lsf_sandbox *sandbox, lsf_error *error)
{
    lsf_sandbox_version_finish(&sandbox->version, sandbox->context);
    if (!lsf_sandbox_version_make(&sandbox->version, sandbox->context, sandbox->scene,
                                  &sandbox->params, NULL, error) ||
        !follow_plan(sandbox, error))
        return false;
    lsf_sandbox_apply_values(sandbox);
    return true;
}

bool lsf_sandbox_resize(lsf_sandbox *sandbox, uint32_t width, uint32_t height, lsf_error *error)
{
    if (!lsf_given(sandbox, "sandbox", error))
        return false;
    if (width == 0 || height == 0)
        return lsf_error_set(error, LSF_ERROR_USAGE, "resolution %u,%u: both must be at least 1",
                             width, height);
    LSF_LEAVE lsf_context *entered = lsf_context_enter(sandbox->context, error);
    if (!entered)
        return false;
    sandbox->params.render.width = width;
    sandbox->params.render.height = height;
    lsf_sandbox_targets_destroy(sandbox, true);
    return remake(sandbox, error) && lsf_context_check(sandbox->context, error);
}

void lsf_sandbox_restart(lsf_sandbox *sandbox)
{
    if (!sandbox)
        return;
    LSF_LEAVE lsf_context *entered = lsf_context_enter(sandbox->context, NULL);
    if (entered)
        lsf_sandbox_targets_clear(sandbox);
}

bool lsf_sandbox_run(lsf_sandbox *sandbox, const lsf_sandbox_frame *frame, lsf_error *error)
{
    if (!lsf_given(sandbox, "sandbox", error) || !lsf_given(frame, "frame", error))
        return false;
    LSF_LEAVE lsf_context *entered = lsf_context_enter(sandbox->context, error);
    if (!entered)
        return false;
    if (!sandbox->version.stage)
        return lsf_error_set(error, LSF_ERROR_RENDER,
                             "the sandbox has nothing to run because it could not be recreated");
    if (sandbox->version.text.needs != 0) {
        lsf_update update = lsf_sandbox_engine_run(&sandbox->version.stage->engine, frame, error);
        if (update == LSF_UPDATE_REPLAN) {
            if (!remake(sandbox, error))
                return false;
            update = lsf_sandbox_engine_run(&sandbox->version.stage->engine, frame, error);
        }
        if (update != LSF_UPDATE_DONE)
            return false;
    }
    lsf_sandbox_draw(sandbox, frame);
    return lsf_context_check(sandbox->context, error);
}

/* --- answers --- */

bool lsf_sandbox_feeds_back(const lsf_sandbox *sandbox)
{
    bool feeds = false;
    for (uint32_t p = 0; sandbox && p < LSF_SANDBOX_PASSES; p++)
        feeds |= sandbox->version.text.passes[p].feeds_back;
    /* A technique's picture is the mean of frames. */
    return feeds || (sandbox && (sandbox->version.text.needs & LSF_NEED_PICTURE));
}

bool lsf_sandbox_writes_radiance(const lsf_sandbox *sandbox)
{
    return sandbox && sandbox->version.text.radiance;
}

const lsf_plan *lsf_sandbox_get_plan(const lsf_sandbox *sandbox)
{
    return sandbox && sandbox->version.stage ? sandbox->version.stage->setup.plan : NULL;
}

/* The plan apart from what it was made with. */
static lsf_plan *take_plan(lsf_sandbox_setup *setup)
{
    lsf_plan *plan = setup->plan;
    setup->plan = NULL;
    if (setup->setup.plan == plan)
        setup->setup.plan = NULL;
    return plan;
}

lsf_plan *lsf_sandbox_plan(const lsf_scene *scene, const lsf_sandbox_params *params,
                           lsf_error *error)
{
    if ((scene && !lsf_scene_given(scene, error)) || !check_params(params, error))
        return NULL;
    lsf_sandbox_text text;
    lsf_sandbox_setup setup = {0};
    lsf_sandbox_channel channels[LSF_SANDBOX_PASSES][LSF_SANDBOX_CHANNELS] = {0};
    bool good = lsf_sandbox_text_read(&text, NULL, params->path, params->text, error) &&
                lsf_sandbox_channels_parse(&text, params, channels, error) &&
                lsf_sandbox_setup_begin(&setup, scene, &text, &params->render, error);
    lsf_plan *plan = good ? take_plan(&setup) : NULL;
    lsf_sandbox_setup_finish(&setup);
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        for (uint32_t c = 0; c < LSF_SANDBOX_CHANNELS; c++)
            free(channels[p][c].path);
    lsf_sandbox_text_finish(&text);
    return plan;
}

uint32_t lsf_sandbox_poll_times(lsf_sandbox *sandbox, const lsf_pass_time **times)
{
    lsf_timer *timers[LSF_SANDBOX_TIMERS];
    if (!sandbox || !times || !sandbox->version.stage)
        return 0;
    LSF_LEAVE lsf_context *entered = lsf_context_enter(sandbox->context, NULL);
    if (!entered)
        return 0;
    uint32_t count = lsf_sandbox_engine_report(&sandbox->version.stage->engine, timers);
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        if (sandbox->targets[p].timer)
            timers[count++] = sandbox->targets[p].timer;
    for (uint32_t i = 0; i < count; i++) {
        lsf_pass_time *time = &sandbox->times[i];
        time->name = lsf_timer_name(timers[i]);
        time->runs = lsf_timer_poll(timers[i], &time->milliseconds);
    }
    *times = sandbox->times;
    return count;
}
