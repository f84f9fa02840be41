#include "window/window_parts.h"

#include "base/base.h"
#include "window/canvas.h"
#include "window/gl_calls.h"
#include "window/reach.h"
#include "window/ui_frame.h"

#include <errno.h>
#include <lightsheaf/image.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_LOSSES = 3 }; /* of the context, with no successful frame between */

/* --- creating the window --- */

static bool fail(lsf_error *error, const char *what, const char *remedy)
{
    const char *description = NULL;
    glfwGetError(&description);
    return lsf_error_set(error, LSF_ERROR_NO_GL, "%s (%s): %s", what,
                         description ? description : "no reason given", remedy);
}

static void (*find_function(void *user, const char *name))(void)
{
    (void)user;
    return glfwGetProcAddress(name);
}

static GLFWwindow *create(const lsf_window_params *params, bool robust)
{
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0); /* the window receives finished pictures alone */
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_ALPHA_BITS, 0);
    if (robust)
        glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    return glfwCreateWindow((int)params->width, (int)params->height, params->title, NULL, NULL);
}

static bool open_context(lsf_window *window, lsf_error *error)
{
    static const char *const remedy = "lightsheaf render needs no window";
    window->handle = create(window->params, true);
    if (!window->handle)
        window->handle = create(window->params, false);
    if (!window->handle)
        return fail(error, "no window with OpenGL 4.5 core", remedy);
    glfwMakeContextCurrent(window->handle);
    glfwSwapInterval(window->replaying ? 0 : 1);
    lsf_window_listen(window);
    lsf_context_wrap_params wrap = {LSF_CONTEXT_WRAP_PARAMS_DEFAULTS};
    wrap.get_proc_address = find_function;
    wrap.shader_dir = window->params->shader_dir;
    window->context = lsf_context_wrap(&wrap, error);
    if (!window->context)
        return false;
    float scale[2];
    glfwGetWindowContentScale(window->handle, &scale[0], &scale[1]);
    if (!lsf_window_gl_load() || !lsf_ui_open(scale[0]))
        return lsf_error_set(error, LSF_ERROR_NO_GL,
                             "the window's panels could not be set up in its OpenGL; %s", remedy);
    if (window->params->full_screen)
        lsf_window_toggle_full_screen(window);
    return true;
}

static void close_context(lsf_window *window)
{
    lsf_ui_close();
    if (window->context)
        lsf_canvas_close_tints();
    lsf_context_destroy(window->context);
    window->context = NULL;
    if (window->handle)
        glfwDestroyWindow(window->handle);
    window->handle = NULL;
}

/* Creates all objects of OpenGL anew, in a window at the position of the one before. */
static bool recover(lsf_window *window, lsf_error *error)
{
    int place[4];
    lsf_log(LSF_LOG_WARNING, "the OpenGL context was lost; everything is made anew");
    glfwGetWindowPos(window->handle, &place[0], &place[1]);
    glfwGetWindowSize(window->handle, &place[2], &place[3]);
    window->client->close(window->client->user);
    close_context(window);
    if (!open_context(window, error))
        return false;
    glfwSetWindowPos(window->handle, place[0], place[1]);
    glfwSetWindowSize(window->handle, place[2], place[3]);
    return window->client->open(window->client->user, window, error);
}

/* --- a frame --- */

static void save_capture(lsf_window *window)
{
    const uint32_t width = window->input.width, height = window->input.height;
    uint8_t *rgb = lsf_alloc((uint64_t)width * height, 3);
    window->capture_error = (lsf_error){LSF_OK, ""};
    if (!rgb)
        lsf_error_set(&window->capture_error, LSF_ERROR_RENDER, "%s: no memory left",
                      window->capture);
    if (rgb) {
        lsf_gl.BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
        lsf_gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
        for (uint32_t y = 0; y < height; y++)
            lsf_gl.ReadPixels(0, (GLint)(height - 1 - y), (GLsizei)width, 1, GL_RGB,
                              GL_UNSIGNED_BYTE, rgb + (size_t)y * width * 3);
        lsf_image_save_rgb8(rgb, width, height, window->capture, NULL, &window->capture_error);
    }
    free(rgb);
    free(window->captured);
    window->captured = window->capture;
    window->capture = NULL;
}

static void set_cursor(lsf_window *window)
{
    static const int shapes[] = {GLFW_ARROW_CURSOR, GLFW_IBEAM_CURSOR, GLFW_HRESIZE_CURSOR,
                                 GLFW_VRESIZE_CURSOR, GLFW_HAND_CURSOR};
    static GLFWcursor *cursors[LSF_COUNT(shapes)];
    int shape = lsf_ui_cursor();
    if (!cursors[shape])
        cursors[shape] = glfwCreateStandardCursor(shapes[shape]);
    glfwSetCursor(window->handle, cursors[shape]);
}

static bool draw(lsf_window *window, lsf_error *error)
{
    static const float black[4] = {0.0f, 0.0f, 0.0f, 1.0f};
    lsf_input *input = &window->input;
    bool buttons[LSF_BUTTON_COUNT];
    /* A click that is shorter than a frame still counts. */
    for (int i = 0; i < LSF_BUTTON_COUNT; i++)
        buttons[i] = window->button[i] || window->just_pressed[i];
    lsf_ui_set_scale(input->scale);
    lsf_ui_begin(input, buttons, window->wheel, window->characters, window->character_count);
    lsf_window_hide_taken(window);
    lsf_gl.Disable(GL_SCISSOR_TEST);
    lsf_gl.ClearNamedFramebufferfv(0, GL_COLOR, 0, black);
    bool good = window->client->frame(window->client->user, window, input, error);
    lsf_gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    lsf_gl.Viewport(0, 0, (GLsizei)input->width, (GLsizei)input->height);
    lsf_ui_end();
    if (window->capture && good)
        save_capture(window);
    if (!window->replaying)
        set_cursor(window);
    glfwSwapBuffers(window->handle);
    return good;
}

static void wait_for_events(lsf_window *window)
{
    bool minimised = glfwGetWindowAttrib(window->handle, GLFW_ICONIFIED) != 0;
    if (window->replaying || (window->awake > 0 && !minimised) || window->event_count > 0)
        glfwPollEvents();
    else if (minimised)
        glfwWaitEventsTimeout(0.25);
    else if (!window->busy && window->rest > 0.0)
        glfwWaitEventsTimeout(window->rest);
    else
        glfwPollEvents();
}

static bool loop(lsf_window *window, lsf_error *error)
{
    uint32_t losses = 0;
    while (!window->closing) {
        wait_for_events(window);
        if (glfwGetWindowAttrib(window->handle, GLFW_ICONIFIED) && !window->replaying &&
            window->event_count == 0)
            continue;
        if (!lsf_window_take_input(window, error))
            return false;
        if (window->closing)
            break;
        bool good = window->lost || draw(window, error);
        window->lost = window->lost || !lsf_context_check(window->context, NULL);
        if (!good && !window->lost)
            return false;
        losses = window->lost ? losses + 1 : 0;
        if (losses > MOST_LOSSES)
            return lsf_error_set(error, LSF_ERROR_RENDER,
                                 "the OpenGL context was lost again and again; the driver's "
                                 "messages may say why");
        if (window->lost && !recover(window, error))
            return false;
        window->lost = false;
        window->awake -= window->awake > 0;
        window->input.frame++;
        for (; window->event_count == 0 && window->dropped_copy_count > 0;)
            free(window->dropped_copies[--window->dropped_copy_count]);
    }
    return true;
}

/* --- the run --- */

static bool open_files(lsf_window *window, lsf_error *error)
{
    const lsf_window_params *params = window->params;
    window->replaying = params->replay != NULL;
    if (params->replay && !lsf_replay_load(&window->replay, params->replay, error))
        return false;
    window->record = params->record ? fopen(params->record, "w") : NULL;
    if (params->record && !window->record)
        return lsf_error_set(error, LSF_ERROR_FILE, "%s: cannot be written: %s", params->record,
                             strerror(errno));
    if (window->record)
        fprintf(window->record, "# Frame, what was done, and with what.\n0 size %u %u\n",
                params->width, params->height);
    return true;
}

bool lsf_window_run(const lsf_window_params *params, const lsf_window_client *client,
                    lsf_error *error)
{
    lsf_window *window = lsf_alloc(1, sizeof *window);
    if (!window)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    window->params = params;
    window->client = client;
    window->clicked_at = -1.0;
    window->awake = 3;
    if (params->coverage)
        lsf_reach_start();
    bool good = open_files(window, error);
    bool started = good && glfwInit();
    if (good && !started)
        good = fail(error, "no display",
                    "start it in a desktop session, over ssh -X, or as xvfb-run -a lightsheaf ...");
    good = good && open_context(window, error);
    if (good) {
        window->start = lsf_now();
        good = client->open(client->user, window, error) && loop(window, error);
        client->close(client->user);
    }
    if (started)
        close_context(window);
    good = good && (!params->coverage || lsf_reach_write(params->coverage, error));
    if (window->record && fclose(window->record) != 0 && good)
        good = lsf_error_set(error, LSF_ERROR_FILE, "%s: cannot be written: %s", params->record,
                             strerror(errno));
    lsf_replay_finish(&window->replay);
    while (window->dropped_copy_count > 0)
        free(window->dropped_copies[--window->dropped_copy_count]);
    free(window->capture);
    free(window->captured);
    free(window);
    return good;
}

/* --- for the client --- */

lsf_context *lsf_window_context(lsf_window *window)
{
    return window->context;
}

void lsf_window_close(lsf_window *window)
{
    window->closing = true;
}

void lsf_window_set_title(lsf_window *window, const char *title)
{
    glfwSetWindowTitle(window->handle, title);
}

void lsf_window_toggle_full_screen(lsf_window *window)
{
    int *place = window->restored;
    if (glfwGetWindowMonitor(window->handle)) {
        glfwSetWindowMonitor(window->handle, NULL, place[0], place[1], place[2], place[3],
                             GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor *monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode *mode = monitor ? glfwGetVideoMode(monitor) : NULL;
    if (!mode)
        return;
    glfwGetWindowPos(window->handle, &place[0], &place[1]);
    glfwGetWindowSize(window->handle, &place[2], &place[3]);
    glfwSetWindowMonitor(window->handle, monitor, 0, 0, mode->width, mode->height,
                         mode->refreshRate);
}

void lsf_window_copy(lsf_window *window, const char *text)
{
    glfwSetClipboardString(window->handle, text);
}

void lsf_window_capture(lsf_window *window, const char *path)
{
    free(window->capture);
    window->capture = strdup(path);
}

const char *lsf_window_captured(lsf_window *window, lsf_error *error)
{
    static char path[4096];
    if (!window->captured)
        return NULL;
    *error = window->capture_error;
    lsf_print(path, sizeof path, "%s", window->captured);
    free(window->captured);
    window->captured = NULL;
    return path;
}

void lsf_window_rest(lsf_window *window, bool busy, double seconds)
{
    window->busy = busy;
    window->rest = seconds;
}

bool lsf_window_waits(lsf_window *window)
{
    if (window->replaying)
        return false;
    glfwPollEvents();
    bool held = window->button[0] || window->button[1] || window->button[2];
    for (uint32_t i = 0; i < window->event_count; i++)
        if (held || window->events[i].kind != LSF_EVENT_MOVE)
            return true;
    return false;
}
