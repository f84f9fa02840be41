/* A frame of a sandbox: its shader's passes, one after the other. */
#include <stdio.h>
#include <string.h>

#include "base/base.h"
#include "sandbox/sandbox.h"
#include "shared/sandbox_data.h"

#define SAMPLE_RATE 44100.0f

static bool create_target(lsf_sandbox *sandbox, uint32_t index, lsf_error *error)
{
    const lsf_plan *plan = sandbox->version.stage->setup.plan;
    lsf_sandbox_target *target = &sandbox->targets[index];
    const char *pass = lsf_sandbox_pass_name(index);
    for (int k = 0; k < 2; k++) {
        char name[32];
        snprintf(name, sizeof name, "sandbox.%s%s", pass, k ? "_before" : "");
        if (target->textures[k] || !lsf_plan_find(plan, name))
            continue;
        if (!lsf_plan_create_texture(plan, sandbox->context, name, &target->textures[k], error))
            return false;
        const lsf_framebuffer_desc desc = {
            .label = name, .color_count = 1, .colors = {target->textures[k]}, .layer = -1};
        target->framebuffers[k] = lsf_framebuffer_create(sandbox->context, &desc, error);
        if (!target->framebuffers[k])
            return false;
        glClearTexImage(target->textures[k], 0, GL_RGBA, GL_FLOAT, NULL);
    }
    if (!target->timer)
        target->timer = lsf_timer_create(sandbox->context, pass, error);
    return target->timer != NULL;
}

bool lsf_sandbox_targets_create(lsf_sandbox *sandbox, lsf_error *error)
{
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        if (sandbox->version.passes[p].program && !create_target(sandbox, p, error))
            return false;
    return true;
}

void lsf_sandbox_targets_destroy(lsf_sandbox *sandbox, bool all)
{
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++) {
        lsf_sandbox_target *target = &sandbox->targets[p];
        if (!all && sandbox->version.passes[p].program)
            continue;
        for (int k = 0; k < 2; k++) {
            lsf_framebuffer_destroy(sandbox->context, &target->framebuffers[k]);
            lsf_texture_destroy(sandbox->context, &target->textures[k]);
        }
        if (target->timer)
            lsf_timer_destroy(target->timer);
        *target = (lsf_sandbox_target){0};
    }
}

void lsf_sandbox_targets_clear(lsf_sandbox *sandbox)
{
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        for (int k = 0; k < 2; k++)
            if (sandbox->targets[p].textures[k])
                glClearTexImage(sandbox->targets[p].textures[k], 0, GL_RGBA, GL_FLOAT, NULL);
}

/* The texture that a channel reads in that pass, and its size. */
static GLuint texture_of(const lsf_sandbox *sandbox, const lsf_sandbox_channel *channel,
                         uint32_t size[2])
{
    const lsf_plan *plan = sandbox->version.stage->setup.plan;
    size[0] = plan->width;
    size[1] = plan->height;
    switch (channel->source) {
    case LSF_SOURCE_BUFFER:
    case LSF_SOURCE_PREVIOUS: {
        bool picture = channel->source == LSF_SOURCE_PREVIOUS;
        const lsf_sandbox_target *target =
            &sandbox->targets[picture ? LSF_SANDBOX_IMAGE : channel->buffer];
        return target->textures[target->now]; /* drawn last: in this frame, or the one before */
    }
    case LSF_SOURCE_KEYBOARD:
        size[0] = LSF_SANDBOX_KEYS;
        size[1] = 3;
        return sandbox->keyboard;
    case LSF_SOURCE_NOISE:
    case LSF_SOURCE_FILE:
    case LSF_SOURCE_CUBE:
        size[0] = channel->width;
        size[1] = channel->height;
        return channel->texture;
    case LSF_SOURCE_NONE:
        break;
    }
    size[0] = size[1] = 1;
    return sandbox->black;
}

static GLint location(const lsf_sandbox_pass *pass, const char *name)
{
    uint32_t row = lsf_sandbox_find_name(name, strlen(name));
    return pass->locations[row];
}

static void bind_channels(const lsf_sandbox *sandbox, const lsf_sandbox_pass *pass,
                          const lsf_sandbox_frame *frame)
{
    float sizes[LSF_SANDBOX_CHANNELS][3], times[LSF_SANDBOX_CHANNELS];
    for (uint32_t c = 0; c < LSF_SANDBOX_CHANNELS; c++) {
        const lsf_sandbox_channel *channel = &pass->channels[c];
        uint32_t size[2];
        GLuint texture = texture_of(sandbox, channel, size);
        if (channel->source == LSF_SOURCE_BUFFER || channel->source == LSF_SOURCE_PREVIOUS)
            lsf_sandbox_channel_set_filter(channel, texture);
        lsf_bind_texture(LSF_UNIT_CHANNEL + c, texture);
        sizes[c][0] = (float)size[0];
        sizes[c][1] = (float)size[1];
        sizes[c][2] = 1.0f;
        times[c] = (float)frame->time;
    }
    if (location(pass, "iChannelResolution") >= 0)
        glUniform3fv(location(pass, "iChannelResolution"), LSF_SANDBOX_CHANNELS, sizes[0]);
    if (location(pass, "iChannelTime") >= 0)
        glUniform1fv(location(pass, "iChannelTime"), LSF_SANDBOX_CHANNELS, times);
}

static void set_uniforms(const lsf_sandbox *sandbox, const lsf_sandbox_pass *pass,
                         const lsf_sandbox_frame *frame)
{
    const lsf_plan *plan = sandbox->version.stage->setup.plan;
    double rate = frame->time_delta > 0.0 ? 1.0 / frame->time_delta : 0.0;
    glUniform3f(location(pass, "iResolution"), (float)plan->width, (float)plan->height, 1.0f);
    glUniform1f(location(pass, "iTime"), (float)frame->time);
    glUniform1f(location(pass, "iGlobalTime"), (float)frame->time);
    glUniform1f(location(pass, "iTimeDelta"), (float)frame->time_delta);
    glUniform1f(location(pass, "iFrameRate"), (float)rate);
    glUniform1i(location(pass, "iFrame"), (GLint)frame->number);
    glUniform4fv(location(pass, "iMouse"), 1, frame->mouse);
    glUniform4fv(location(pass, "iDate"), 1, frame->date);
    glUniform1f(location(pass, "iSampleRate"), SAMPLE_RATE);
}

static uint32_t groups(uint32_t length, GLint size)
{
    return (length + (uint32_t)size - 1) / (uint32_t)size;
}

static void draw_pass(lsf_sandbox *sandbox, uint32_t index, const lsf_sandbox_frame *frame)
{
    const lsf_sandbox_pass *pass = &sandbox->version.passes[index];
    lsf_sandbox_target *target = &sandbox->targets[index];
    const lsf_sandbox_text *text = &sandbox->version.text;
    const lsf_plan *plan = sandbox->version.stage->setup.plan;
    uint32_t next = target->textures[1] ? 1 - target->now : 0;
    lsf_timer_begin(target->timer);
    lsf_begin_fullscreen(target->framebuffers[next], plan->width, plan->height, pass->program);
    bind_channels(sandbox, pass, frame);
    set_uniforms(sandbox, pass, frame);
    if (text->needs != 0)
        lsf_sandbox_engine_bind(&sandbox->version.stage->engine, text->passes[index].needs);
    if (text->passes[index].compute) {
        glBindImageTexture(0, target->textures[next], 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
        glDispatchCompute(groups(plan->width, pass->groups[0]),
                          groups(plan->height, pass->groups[1]), 1);
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                        GL_FRAMEBUFFER_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    } else {
        lsf_draw_fullscreen(sandbox->context);
    }
    target->now = next;
    lsf_timer_end(target->timer);
}

static void upload_keys(const lsf_sandbox *sandbox, const lsf_sandbox_frame *frame)
{
    uint8_t texels[3][LSF_SANDBOX_KEYS] = {0};
    for (uint32_t row = 0; frame->keys && row < 3; row++)
        for (uint32_t key = 0; key < LSF_SANDBOX_KEYS; key++)
            texels[row][key] = frame->keys[row][key] ? 255 : 0;
    glTextureSubImage2D(sandbox->keyboard, 0, 0, 0, LSF_SANDBOX_KEYS, 3, GL_RED, GL_UNSIGNED_BYTE,
                        texels);
}

void lsf_sandbox_draw(lsf_sandbox *sandbox, const lsf_sandbox_frame *frame)
{
    if (sandbox->keyboard)
        upload_keys(sandbox, frame);
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        if (sandbox->version.passes[p].program)
            draw_pass(sandbox, p, frame);
}
