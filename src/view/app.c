/* The viewer as the window's client. */
#include "view/app.h"

#include "base/base.h"

#include <stdlib.h>
#include <string.h>

#define NOTICE_SECONDS 4.0
#define BUDGET_SOFTWARE 0.1
#define BUDGET_GPU 0.034 /* two frames of a display of 60 Hz */

void lsf_viewer_say(lsf_viewer *viewer, lsf_ui_color color, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    lsf_format_plain(viewer->notice, sizeof viewer->notice, format, arguments);
    va_end(arguments);
    viewer->notice_color = color;
    viewer->notice_until = (viewer->input ? viewer->input->time : 0.0) + NOTICE_SECONDS;
}

static bool open_viewer(void *user, lsf_window *window, lsf_error *error)
{
    lsf_viewer *viewer = user;
    (void)error;
    viewer->window = window;
    viewer->context = lsf_window_context(window);
    viewer->device = lsf_context_get_info(viewer->context);
    double seconds = viewer->start->budget;
    if (seconds == 0.0)
        seconds = viewer->device.software ? BUDGET_SOFTWARE : BUDGET_GPU;
    viewer->budget.seconds = seconds;
    if (!viewer->scene && viewer->path_count > 0)
        lsf_viewer_show_file(viewer, viewer->shown);
    lsf_viewer_touch_settings(viewer);
    lsf_viewer_list_keys();
    return true;
}

static void close_viewer(void *user)
{
    lsf_viewer_drop_pictures(user);
}

static void advance_time(lsf_viewer *viewer)
{
    if (!viewer->playing)
        return;
    viewer->time += viewer->input->step;
    if (viewer->time > viewer->duration) {
        viewer->time = 0.0;
        viewer->cut = true;
    }
    lsf_viewer_touch(viewer);
}

static void follow_plan(lsf_viewer *viewer)
{
    if (!viewer->plan_wanted || !viewer->still.begun)
        return;
    free(viewer->plan_text);
    viewer->plan_text = lsf_plan_describe(lsf_renderer_plan(viewer->still.renderer), false);
    viewer->plan_wanted = false;
}

static void follow_captures(lsf_viewer *viewer)
{
    lsf_error error;
    const char *path = lsf_window_captured(viewer->window, &error);
    if (path && error.code == LSF_OK)
        lsf_viewer_say(viewer, LSF_UI_TEXT, "Saved %s", path);
    else if (path)
        lsf_viewer_say(viewer, LSF_UI_ERROR, "%s", error.message);
    if (!viewer->capture || !lsf_viewer_finished(viewer))
        return;
    if (viewer->still.error.code == LSF_OK)
        lsf_viewer_save_picture(viewer, viewer->capture);
    free(viewer->capture);
    viewer->capture = NULL;
}

/* A frame lasts until the next one begins. */
static void follow_clock(lsf_viewer *viewer)
{
    double now = lsf_now();
    double seconds = now - viewer->frame_begun;
    if (viewer->frame_begun > 0.0) {
        lsf_viewer_log_frame(viewer, seconds);
        lsf_viewer_spend(viewer, seconds);
    }
    viewer->frame_begun = now;
}

static bool frame(void *user, lsf_window *window, const lsf_input *input, lsf_error *error)
{
    lsf_viewer *viewer = user;
    viewer->input = input;
    follow_clock(viewer);
    lsf_viewer_take_dropped(viewer);
    lsf_viewer_watch(viewer);
    lsf_viewer_handle(viewer);
    advance_time(viewer);
    lsf_viewer_show_panels(viewer);
    follow_plan(viewer);
    follow_captures(viewer);
    lsf_window_rest(window, !lsf_viewer_finished(viewer) || viewer->capture, 0.5);
    return !input->snapshot || lsf_viewer_take_snapshot(viewer, input->snapshot, error);
}

static bool view(const lsf_viewer_start *start, lsf_error *error)
{
    lsf_viewer *viewer = lsf_alloc(1, sizeof *viewer);
    if (!viewer)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    viewer->start = start;
    viewer->scene_params = start->scene;
    viewer->panels = true;
    viewer->looked_at = -1.0; /* at once */
    viewer->compare.split = 0.5f;
    viewer->compare.gain = 4.0f;
    viewer->expose_wanted = start->auto_exposure;
    lsf_viewer_settings_start(&viewer->settings, start);
    bool good = true;
    for (uint32_t i = 0; good && i < start->path_count; i++)
        good = lsf_viewer_add_path(viewer, start->paths[i]) ||
               lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    const lsf_window_client client = {viewer, open_viewer, close_viewer, frame};
    good = good && lsf_viewer_open_frame_log(viewer, error) &&
           lsf_window_run(&start->window, &client, error);
    if (viewer->frame_log)
        good = lsf_viewer_close_frame_log(viewer, good ? error : NULL) && good;
    lsf_scene_destroy(viewer->scene);
    for (uint32_t i = 0; i < viewer->path_count; i++)
        free(viewer->paths[i]);
    free(viewer->paths);
    for (int kind = 0; kind < LSF_KIND_CAMERA; kind++)
        free(viewer->edited[kind]);
    free(viewer->plan_text);
    free(viewer->capture);
    free(viewer);
    return good;
}

const lsf_window_module lsf_window_module_table = {.view = view, .view_key = lsf_viewer_key};
