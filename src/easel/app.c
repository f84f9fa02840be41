/* The sandbox as the window's client. */
#include "easel/app.h"

#include "base/base.h"
#include "easel/worker.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* How long a frame of the window waits for a picture, so that panels stay lively [s]. */
#define PATIENCE 0.015
/* How often files are looked at while nothing is drawn [s]. */
#define LOOK_EVERY 0.25

static struct timespec stamp_of(const char *path)
{
    struct stat status = {0};
    (void)stat(path, &status);
    return status.st_mtim;
}

static void start_process(lsf_easel *easel)
{
    lsf_error error;
    easel->stamp = stamp_of(easel->start->sandbox.path);
    easel->trouble[0] = '\0';
    easel->dirty = true;
    if (!lsf_easel_process_start(&easel->process, easel->start->command, &error)) {
        lsf_easel_process_end(&easel->process);
        snprintf(easel->trouble, sizeof easel->trouble, "%s", error.message);
    }
}

/* A process that is gone is started again as soon as the shader is another one. */
static void follow_process(lsf_easel *easel)
{
    double limit = easel->start->watchdog;
    if (easel->process.asked && limit > 0.0 && lsf_now() - easel->process.since > limit) {
        lsf_easel_process_end(&easel->process);
        snprintf(easel->trouble, sizeof easel->trouble,
                 "%s: frame %u: no end after %g s: look for an endless loop; saving the shader or "
                 "Restart runs it again",
                 easel->start->sandbox.path, easel->request.frame.number, limit);
    }
    const struct timespec now = stamp_of(easel->start->sandbox.path);
    bool changed = now.tv_sec != easel->stamp.tv_sec || now.tv_nsec != easel->stamp.tv_nsec;
    if (easel->process.id == 0 && (changed || easel->restart))
        start_process(easel);
    easel->stamp = now;
    easel->dirty |= changed;
}

static void set_date(float date[4])
{
    time_t now = time(NULL);
    struct tm local;
    localtime_r(&now, &local);
    date[0] = (float)(local.tm_year + 1900);
    date[1] = (float)local.tm_mon;
    date[2] = (float)local.tm_mday;
    date[3] = (float)(3600 * local.tm_hour + 60 * local.tm_min + local.tm_sec);
}

static uint32_t picture_size(const lsf_easel *easel, uint32_t window)
{
    uint32_t size = window / (uint32_t)easel->reduction;
    return size > 0 ? size : 1;
}

static void fill_request(lsf_easel *easel)
{
    lsf_easel_request *r = &easel->request;
    const lsf_input *input = easel->input;
    r->width = picture_size(easel, input->width);
    r->height = picture_size(easel, input->height);
    r->restart = easel->restart;
    r->frame = (lsf_sandbox_frame){LSF_SANDBOX_FRAME_DEFAULTS};
    r->frame.number = easel->number;
    if (!(easel->playing || easel->step) && easel->number > 0)
        r->frame.number--; /* the last one again */
    r->frame.time = easel->time;
    r->frame.time_delta = easel->time - easel->time_of_last;
    memcpy(r->frame.mouse, easel->mouse, sizeof r->frame.mouse);
    set_date(r->frame.date);
    memcpy(r->keys, easel->keys, sizeof r->keys);
    r->has_view = easel->has_camera && easel->camera.own;
    if (r->has_view)
        r->view = lsf_viewer_camera_view(&easel->camera);
    r->exposure = easel->exposure;
    r->uniform_count = 0;
    for (uint32_t i = 0; i < easel->answer.uniform_count; i++)
        if (easel->set[i])
            r->uniforms[r->uniform_count++] = easel->answer.uniforms[i];
}

/* Paused, the same frame is drawn again with what is set otherwise, and files are looked at. */
static void ask(lsf_easel *easel)
{
    lsf_error error;
    bool next = easel->playing || easel->step;
    bool look = !next && !easel->dirty;
    if (easel->process.id == 0 || easel->process.asked ||
        (look && easel->input->time < easel->looked_at + LOOK_EVERY))
        return;
    fill_request(easel);
    easel->request.look = look;
    easel->looked_at = easel->input->time;
    if (!lsf_easel_process_ask(&easel->process, &easel->request, &error)) {
        snprintf(easel->trouble, sizeof easel->trouble, "%s", error.message);
        return;
    }
    memset(easel->keys[1], 0, sizeof easel->keys[1]);
    memset(easel->set, 0, sizeof easel->set);
    easel->mouse[3] = easel->mouse[3] > 0.0f ? -easel->mouse[3] : easel->mouse[3];
    easel->time_of_last = easel->time;
    easel->number += next;
    easel->restart = easel->step = easel->dirty = false;
}

static bool show_answer(lsf_easel *easel, lsf_error *error)
{
    lsf_easel_answer *answer = &easel->answer;
    double now = lsf_now();
    if (answer->has_camera && !easel->has_camera) {
        easel->camera = answer->camera;
        easel->has_camera = true;
    }
    if (!answer->drawn)
        return true;
    if (!lsf_canvas_resize(&easel->canvas, easel->request.width, easel->request.height, error))
        return false;
    lsf_canvas_write(&easel->canvas, easel->process.mapped);
    easel->canvas_frames++;
    double since = now - easel->shown_at;
    if (easel->canvas_frames > 1)
        easel->frame_seconds +=
            (easel->canvas_frames == 2 ? 1.0 : 0.1) * (since - easel->frame_seconds);
    easel->shown_at = now;
    return true;
}

static bool listen(lsf_easel *easel, lsf_error *error)
{
    static lsf_easel_answer answer; /* it is large */
    lsf_error died;
    double wait = easel->process.asked ? PATIENCE : 0.0;
    switch (lsf_easel_process_poll(&easel->process, wait, &answer, &died)) {
    case LSF_EASEL_NOTHING:
        return true;
    case LSF_EASEL_GONE:
        snprintf(easel->trouble, sizeof easel->trouble, "%.3000s; save the shader to run it again",
                 died.message);
        return true;
    case LSF_EASEL_ANSWER:
        break;
    }
    /* What is being dragged stays as the user has it. */
    for (uint32_t i = 0; i < answer.uniform_count && i < easel->answer.uniform_count; i++)
        if (easel->set[i] && strcmp(answer.uniforms[i].name, easel->answer.uniforms[i].name) == 0)
            memcpy(answer.uniforms[i].value, easel->answer.uniforms[i].value,
                   sizeof answer.uniforms[i].value);
    easel->answer = answer;
    return show_answer(easel, error);
}

/* What the window shows as an error, once. */
static void say_errors(lsf_easel *easel)
{
    const char *text = easel->trouble[0] ? easel->trouble : easel->answer.error;
    if (strcmp(text, easel->said) == 0)
        return;
    snprintf(easel->said, sizeof easel->said, "%s", text);
    if (text[0])
        lsf_log(LSF_LOG_ERROR, "%s", text);
}

static bool open_easel(void *user, lsf_window *window, lsf_error *error)
{
    lsf_easel *easel = user;
    (void)error;
    easel->window = window;
    easel->dirty = true;
    lsf_easel_list_keys();
    if (easel->process.id == 0)
        start_process(easel);
    return true;
}

static void close_easel(void *user)
{
    lsf_easel *easel = user;
    lsf_canvas_destroy(&easel->canvas);
}

static bool frame(void *user, lsf_window *window, const lsf_input *input, lsf_error *error)
{
    lsf_easel *easel = user;
    lsf_error captured;
    easel->input = input;
    easel->dirty |= easel->request.width != picture_size(easel, input->width) ||
                    easel->request.height != picture_size(easel, input->height);
    if (easel->playing && easel->canvas_frames > 0) /* it begins with the first picture */
        easel->time += input->step;
    lsf_easel_handle(easel);
    follow_process(easel);
    ask(easel);
    if (!listen(easel, error))
        return false;
    if (lsf_window_captured(window, &captured) && captured.code != LSF_OK)
        snprintf(easel->trouble, sizeof easel->trouble, "%s", captured.message);
    say_errors(easel);
    lsf_easel_show_panels(easel);
    bool awaits = easel->process.asked && !easel->request.look;
    bool busy = easel->playing || easel->step || awaits || (easel->dirty && easel->process.id != 0);
    lsf_window_rest(window, busy, 0.1);
    return true;
}

static bool show(const lsf_easel_start *start, lsf_error *error)
{
    lsf_easel *easel = lsf_alloc(1, sizeof *easel);
    if (!easel)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    easel->start = start;
    easel->process = (lsf_easel_process){.socket = -1, .pixels = -1};
    easel->playing = easel->panels = true;
    easel->exposure = start->exposure;
    easel->reduction = 1;
    const lsf_window_client client = {easel, open_easel, close_easel, frame};
    bool good = lsf_window_run(&start->window, &client, error);
    lsf_easel_process_end(&easel->process);
    free(easel);
    return good;
}

const lsf_easel_module lsf_easel_module_table = {.show = show, .work = lsf_easel_work};
