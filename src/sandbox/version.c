#include "sandbox/version.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "gl/context.h"

/* --- channels --- */

static void note_feedback(lsf_sandbox_text *text, uint32_t reader,
                          const lsf_sandbox_channel *channel)
{
    if (channel->source == LSF_SOURCE_PREVIOUS)
        text->passes[LSF_SANDBOX_IMAGE].feeds_back = true;
    else if (channel->source == LSF_SOURCE_BUFFER && channel->buffer >= reader)
        text->passes[channel->buffer].feeds_back = true;
}

/* "[BUFFER:]N=SOURCE" of the caller, for that pass and channel; NULL: it says nothing. The last one
 * counts. */
static const char *given_channel(const lsf_sandbox_params *params, uint32_t pass, uint32_t index)
{
    const char *source = NULL;
    for (uint32_t i = 0; i < params->channel_count; i++) {
        const char *text = params->channels[i];
        char wanted[16];
        snprintf(wanted, sizeof wanted, "%s:%u=", lsf_sandbox_pass_name(pass), index);
        const char *start = pass == LSF_SANDBOX_IMAGE ? strchr(wanted, ':') + 1 : wanted;
        if (strncmp(text, start, strlen(start)) == 0)
            source = text + strlen(start);
    }
    return source;
}

static bool check_given(const lsf_sandbox_params *params, lsf_error *error)
{
    for (uint32_t i = 0; i < params->channel_count; i++) {
        const char *text = params->channels[i], *at = text;
        if (at[0] >= 'a' && at[0] <= 'd' && at[1] == ':')
            at += 2;
        if (at[0] < '0' || at[0] > '3' || at[1] != '=' || at[2] == '\0')
            return lsf_error_set(error, LSF_ERROR_USAGE,
                                 "channel %s: write N=SOURCE, N from 0 to 3, or a:N=SOURCE for "
                                 "that of buffer a",
                                 text);
    }
    return true;
}

static bool parse_channel(lsf_sandbox_text *text, const lsf_sandbox_params *params, uint32_t p,
                          uint32_t c, lsf_sandbox_channel *channel, lsf_error *error)
{
    const lsf_sandbox_pass_text *pass = &text->passes[p];
    const lsf_sandbox_channel_text *said = &pass->channels[c];
    const char *given = given_channel(params, p, c), *source = given ? given : said->source;
    char name[16], location[512] = "channel";
    snprintf(name, sizeof name, "iChannel%u", c);
    uint32_t row = lsf_sandbox_find_name(name, strlen(name));
    if (!pass->part.text || !pass->mentions[row])
        return true;
    if (!source) {
        lsf_log(LSF_LOG_WARNING, "%s:%u: %s is black: declare its source by // @channel %u SOURCE",
                pass->locations[row].path, pass->locations[row].line, name, c);
        return true;
    }
    if (!given)
        snprintf(location, sizeof location, "%.480s:%u", said->location.path, said->location.line);
    if (!lsf_sandbox_channel_parse(channel, source, given ? "." : text->folder, location, error))
        return false;
    if (channel->source == LSF_SOURCE_BUFFER && !text->passes[channel->buffer].part.text)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "%s: there is no buffer %s: add a section // @buffer %s, or a file "
                             "beside the shader",
                             location, lsf_sandbox_pass_name(channel->buffer),
                             lsf_sandbox_pass_name(channel->buffer));
    note_feedback(text, p, channel);
    text->keyboard |= channel->source == LSF_SOURCE_KEYBOARD;
    return !channel->path || strstr(channel->path, "%s") ||
           lsf_sandbox_text_watch(text, channel->path) ||
           lsf_error_set(error, LSF_ERROR_RENDER, "out of memory while reading a shader");
}

bool lsf_sandbox_channels_parse(lsf_sandbox_text *text, const lsf_sandbox_params *params,
                                lsf_sandbox_channel channels[][LSF_SANDBOX_CHANNELS],
                                lsf_error *error)
{
    if (!check_given(params, error))
        return false;
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        for (uint32_t c = 0; c < LSF_SANDBOX_CHANNELS; c++)
            if (!parse_channel(text, params, p, c, &channels[p][c], error))
                return false;
    return true;
}

/* --- versions --- */

/* Whether the engine made for one text does for another. */
static bool same_stage(const lsf_sandbox_text *a, const lsf_sandbox_text *b)
{
    bool same = a->needs == b->needs && a->radiance == b->radiance && a->jitter == b->jitter &&
                a->keyboard == b->keyboard && a->light == b->light &&
                memcmp(a->bundle, b->bundle, sizeof a->bundle) == 0 &&
                a->define_count == b->define_count;
    for (uint64_t i = 0; same && i < a->define_count; i++)
        same = strcmp(a->defines[i], b->defines[i]) == 0;
    for (uint32_t p = 0; same && p < LSF_SANDBOX_PASSES; p++)
        same = !a->passes[p].part.text == !b->passes[p].part.text &&
               a->passes[p].feeds_back == b->passes[p].feeds_back;
    return same;
}

static bool make_stage(lsf_sandbox_version *version, lsf_context *context, const lsf_scene *scene,
                       const lsf_sandbox_params *params, lsf_error *error)
{
    lsf_sandbox_stage *stage = version->stage = lsf_alloc(1, sizeof *stage);
    if (!stage)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    return lsf_sandbox_setup_begin(&stage->setup, scene, &version->text, &params->render, error) &&
           lsf_sandbox_engine_create(&stage->engine, context, &stage->setup, &version->text, error);
}

static bool load_channels(lsf_sandbox_version *version, lsf_context *context,
                          lsf_sandbox_version *before, lsf_error *error)
{
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        for (uint32_t c = 0; c < LSF_SANDBOX_CHANNELS; c++) {
            const lsf_sandbox_location *said = &version->text.passes[p].channels[c].location;
            lsf_sandbox_channel *channel = &version->passes[p].channels[c];
            lsf_sandbox_channel *old = before ? before->passes[p].channels : NULL;
            char location[512] = "channel";
            if (said->path)
                snprintf(location, sizeof location, "%.480s:%u: @channel", said->path, said->line);
            if (!lsf_sandbox_channel_load(channel, context, old, old ? LSF_SANDBOX_CHANNELS : 0,
                                          location, error))
                return false;
        }
    return true;
}

static bool make(lsf_sandbox_version *version, lsf_context *context, const lsf_scene *scene,
                 const lsf_sandbox_params *params, lsf_sandbox_version *before, lsf_error *error)
{
    lsf_sandbox_text *text = &version->text;
    lsf_sandbox_channel channels[LSF_SANDBOX_PASSES][LSF_SANDBOX_CHANNELS] = {0};
    bool good =
        lsf_sandbox_text_read(text, context->shader_dir, params->path, params->text, error) &&
        lsf_sandbox_channels_parse(text, params, channels, error);
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        memcpy(version->passes[p].channels, channels[p], sizeof channels[p]);
    if (!good)
        return false;
    bool lent = before && same_stage(text, &before->text);
    if (!lent && !make_stage(version, context, scene, params, error))
        return false;
    const lsf_plan *plan = (lent ? before->stage : version->stage)->setup.plan;
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        if (text->passes[p].part.text &&
            !lsf_sandbox_pass_build(&version->passes[p], context, text, p, plan, error))
            return false;
    return load_channels(version, context, before, error);
}

/* The objects of OpenGL, without the text. */
static void drop(lsf_sandbox_version *version, lsf_context *context)
{
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++) {
        lsf_program_destroy(&version->passes[p].program);
        for (uint32_t c = 0; c < LSF_SANDBOX_CHANNELS; c++)
            lsf_sandbox_channel_finish(&version->passes[p].channels[c], context);
    }
    if (version->stage) {
        lsf_sandbox_engine_destroy(&version->stage->engine);
        lsf_sandbox_setup_finish(&version->stage->setup);
    }
    free(version->stage);
    version->stage = NULL;
}

bool lsf_sandbox_version_make(lsf_sandbox_version *version, lsf_context *context,
                              const lsf_scene *scene, const lsf_sandbox_params *params,
                              lsf_sandbox_version *before, lsf_error *error)
{
    *version = (lsf_sandbox_version){0};
    bool good = make(version, context, scene, params, before, error);
    if (!good)
        drop(version, context);
    return good;
}

void lsf_sandbox_version_keep(lsf_sandbox_version *version, lsf_sandbox_version *before)
{
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        for (uint32_t c = 0; c < LSF_SANDBOX_CHANNELS; c++)
            lsf_sandbox_channel_keep(&version->passes[p].channels[c]);
    if (!version->stage) {
        version->stage = before->stage;
        before->stage = NULL;
    }
}

void lsf_sandbox_version_finish(lsf_sandbox_version *version, lsf_context *context)
{
    drop(version, context);
    lsf_sandbox_text_finish(&version->text);
}
