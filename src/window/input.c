#include "window/window_parts.h"

#include "base/base.h"
#include "window/ui_frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The longest time between the two clicks of a double click, and the farthest that the cursor
 * may move meanwhile. */
#define DOUBLE_SECONDS 0.4
#define DOUBLE_PIXELS 6.0
#define REPLAY_STEP (1.0 / 60.0)
enum { PATIENCE = 30 }; /* frames within which a label has to appear */

bool lsf_input_key(const lsf_input *input, int key, uint32_t modifiers)
{
    for (uint32_t i = 0; i < input->key_count; i++)
        if (input->keys[i] == key && input->modifiers == modifiers)
            return true;
    return false;
}

/* --- GLFW's callbacks --- */

void lsf_window_push(lsf_window *window, lsf_event event)
{
    lsf_event *last = window->event_count ? &window->events[window->event_count - 1] : NULL;
    if (last && last->kind == LSF_EVENT_MOVE && event.kind == LSF_EVENT_MOVE)
        *last = event;
    else if (window->event_count < LSF_EVENTS_A_FRAME)
        window->events[window->event_count++] = event;
}

static void on_key(GLFWwindow *handle, int key, int scancode, int action, int modifiers)
{
    (void)scancode, (void)modifiers;
    if (key >= 0 && key < LSF_KEY_LIMIT)
        lsf_window_push(
            glfwGetWindowUserPointer(handle),
            (lsf_event){.kind = action == GLFW_RELEASE ? LSF_EVENT_KEY_UP : LSF_EVENT_KEY_DOWN,
                        .code = key});
}

static void on_character(GLFWwindow *handle, unsigned character)
{
    lsf_window_push(glfwGetWindowUserPointer(handle),
                    (lsf_event){.kind = LSF_EVENT_TEXT, .code = (int)character});
}

static void on_button(GLFWwindow *handle, int button, int action, int modifiers)
{
    (void)modifiers;
    if (button < LSF_BUTTON_COUNT)
        lsf_window_push(glfwGetWindowUserPointer(handle),
                        (lsf_event){.kind = action == GLFW_RELEASE ? LSF_EVENT_BUTTON_UP
                                                                   : LSF_EVENT_BUTTON_DOWN,
                                    .code = button});
}

/* GLFW counts in screen coordinates, which may be larger than a pixel. */
static void on_cursor(GLFWwindow *handle, double x, double y)
{
    int width, height;
    lsf_window *window = glfwGetWindowUserPointer(handle);
    glfwGetWindowSize(handle, &width, &height);
    double sx = width > 0 ? (double)window->input.width / width : 1.0;
    double sy = height > 0 ? (double)window->input.height / height : 1.0;
    lsf_window_push(window, (lsf_event){.kind = LSF_EVENT_MOVE, .x = x * sx, .y = y * sy});
}

static void on_scroll(GLFWwindow *handle, double x, double y)
{
    (void)x;
    lsf_window_push(glfwGetWindowUserPointer(handle),
                    (lsf_event){.kind = LSF_EVENT_SCROLL, .x = y});
}

static void on_drop(GLFWwindow *handle, int count, const char **paths)
{
    lsf_window *window = glfwGetWindowUserPointer(handle);
    for (int i = 0; i < count && window->dropped_copy_count < LSF_DROPPED_A_FRAME; i++) {
        char *copy = strdup(paths[i]);
        if (!copy)
            return;
        window->dropped_copies[window->dropped_copy_count++] = copy;
        lsf_window_push(window, (lsf_event){.kind = LSF_EVENT_DROP, .text = copy});
    }
}

static void on_close(GLFWwindow *handle)
{
    lsf_window_push(glfwGetWindowUserPointer(handle), (lsf_event){.kind = LSF_EVENT_CLOSE});
}

void lsf_window_listen(lsf_window *window)
{
    glfwSetWindowUserPointer(window->handle, window);
    glfwSetWindowCloseCallback(window->handle, on_close);
    if (window->replaying)
        return; /* the user looks on */
    glfwSetKeyCallback(window->handle, on_key);
    glfwSetCharCallback(window->handle, on_character);
    glfwSetMouseButtonCallback(window->handle, on_button);
    glfwSetCursorPosCallback(window->handle, on_cursor);
    glfwSetScrollCallback(window->handle, on_scroll);
    glfwSetDropCallback(window->handle, on_drop);
}

/* --- one event --- */

static void resize(lsf_window *window, double width, double height)
{
    glfwSetWindowSize(window->handle, (int)width, (int)height);
    for (int i = 0; i < 100; i++) { /* the display's server needs some time */
        int now[2];
        glfwGetWindowSize(window->handle, &now[0], &now[1]);
        if (now[0] == (int)width && now[1] == (int)height)
            break;
        glfwWaitEventsTimeout(0.01);
    }
}

static void press_button(lsf_window *window, int button)
{
    lsf_input *input = &window->input;
    window->button[button] = window->just_pressed[button] = true;
    input->pressed[button] = true;
    if (button != LSF_BUTTON_LEFT)
        return;
    double far = hypot(input->x - window->clicked_x, input->y - window->clicked_y);
    input->double_clicked =
        input->time - window->clicked_at < DOUBLE_SECONDS && far < DOUBLE_PIXELS;
    window->clicked_at = input->double_clicked ? -1.0 : input->time;
    window->clicked_x = input->x;
    window->clicked_y = input->y;
}

static void press_key(lsf_input *input, int key)
{
    input->held[key] = true;
    if (input->key_count < LSF_KEYS_A_FRAME)
        input->keys[input->key_count++] = key;
}

static void apply(lsf_window *window, const lsf_event *event)
{
    lsf_input *input = &window->input;
    switch (event->kind) {
    case LSF_EVENT_KEY_DOWN:
        press_key(input, event->code);
        break;
    case LSF_EVENT_KEY_UP:
        input->held[event->code] = false;
        break;
    case LSF_EVENT_TEXT:
        if (window->character_count < LSF_CHARACTERS_A_FRAME)
            window->characters[window->character_count++] = (uint32_t)event->code;
        break;
    case LSF_EVENT_MOVE:
        input->dx += event->x - input->x;
        input->dy += event->y - input->y;
        input->x = event->x;
        input->y = event->y;
        break;
    case LSF_EVENT_BUTTON_DOWN:
        press_button(window, event->code);
        break;
    case LSF_EVENT_BUTTON_UP:
        window->button[event->code] = false;
        input->released[event->code] = true;
        break;
    case LSF_EVENT_SCROLL:
        window->wheel += event->x;
        break;
    case LSF_EVENT_DROP:
        if (input->dropped_count < LSF_DROPPED_A_FRAME)
            window->dropped[input->dropped_count++] = event->text;
        break;
    case LSF_EVENT_SIZE:
        resize(window, event->x, event->y);
        break;
    case LSF_EVENT_STEP:
        input->time += event->x - input->step;
        input->step = event->x;
        break;
    case LSF_EVENT_CLOSE:
        window->closing = true;
        break;
    case LSF_EVENT_MINIMISE:
        glfwIconifyWindow(window->handle);
        glfwPollEvents();
        glfwRestoreWindow(window->handle);
        break;
    case LSF_EVENT_LOSE:
        window->lost = true;
        break;
    case LSF_EVENT_SET:
        lsf_ui_assign(event->text);
        break;
    case LSF_EVENT_SNAPSHOT:
        input->snapshot = event->text;
        break;
    case LSF_EVENT_PRESS:
    case LSF_EVENT_DRAG:
    case LSF_EVENT_SETTLE:
    case LSF_EVENT_COUNT:
        break;
    }
}

/* --- a replay --- */

/* The next step of a click on a labelled thing. False: nothing has that label. */
static bool go_on_pressing(lsf_window *window, lsf_error *error)
{
    lsf_event event = {.kind = LSF_EVENT_MOVE, .code = LSF_BUTTON_LEFT};
    const char *label = window->pressed->text;
    double x, y;
    /* Panels may have been laid out anew since the cursor moved there. */
    if (window->press == LSF_PRESS_DOWN && lsf_ui_find(label, &x, &y) &&
        hypot(x - window->input.x, y - window->input.y) > 1.0 && window->patience++ < PATIENCE)
        window->press = LSF_PRESS_MOVE;
    switch (window->press) {
    case LSF_PRESS_MOVE:
        if (!lsf_ui_find(label, &event.x, &event.y))
            return window->patience++ < PATIENCE ||
                   lsf_error_set(error, LSF_ERROR_FILE, "%s: %s: nothing of that label is shown",
                                 window->params->replay, label);
        window->press = LSF_PRESS_DOWN;
        break;
    case LSF_PRESS_DOWN:
        event.kind = LSF_EVENT_BUTTON_DOWN;
        window->press = window->pressed->kind == LSF_EVENT_DRAG ? LSF_PRESS_DRAG : LSF_PRESS_UP;
        break;
    case LSF_PRESS_DRAG:
        event.x = window->input.x + window->pressed->x;
        event.y = window->input.y + window->pressed->y;
        window->press = LSF_PRESS_UP;
        break;
    default:
        event.kind = LSF_EVENT_BUTTON_UP;
        window->press = LSF_PRESS_NONE;
        break;
    }
    apply(window, &event);
    return true;
}

/* The lines of the replay for this frame, up to the next one that takes several frames. */
static bool take_replayed(lsf_window *window, lsf_error *error)
{
    if (!lsf_ui_assigned())
        return window->patience++ < PATIENCE ||
               lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: set %s: it is not shown, or does not take that value",
                             window->params->replay, window->pressed->text);
    if (window->press != LSF_PRESS_NONE)
        return go_on_pressing(window, error);
    window->settling = window->settling && (window->busy || window->awake > 0);
    if (window->settling)
        return true;
    window->closing = window->closing ||
                      (lsf_replay_ended(&window->replay) && window->awake == 0 && !window->capture);
    const lsf_event *event;
    while ((event = lsf_replay_take(&window->replay, window->script_frame)) != NULL) {
        window->awake = 3;
        window->patience = 0;
        window->settling = event->kind == LSF_EVENT_SETTLE;
        window->pressed = event;
        if (event->kind == LSF_EVENT_PRESS || event->kind == LSF_EVENT_DRAG) {
            window->press = LSF_PRESS_MOVE;
            return go_on_pressing(window, error);
        }
        apply(window, event);
        if (window->settling || event->kind == LSF_EVENT_SET)
            return true;
    }
    window->script_frame++;
    return true;
}

/* --- one frame --- */

static void take_waiting(lsf_window *window)
{
    lsf_input *input = &window->input;
    if (window->record && (window->event_count || window->busy || window->awake))
        lsf_event_write(window->record, input->frame,
                        &(lsf_event){.kind = LSF_EVENT_STEP, .x = input->step});
    for (uint32_t i = 0; i < window->event_count; i++) {
        apply(window, &window->events[i]);
        if (window->record)
            lsf_event_write(window->record, input->frame, &window->events[i]);
    }
    if (window->event_count)
        window->awake = 3;
    window->event_count = 0;
}

static uint32_t modifiers_held(const bool *held)
{
    return (held[GLFW_KEY_LEFT_SHIFT] || held[GLFW_KEY_RIGHT_SHIFT] ? LSF_SHIFT : 0u) |
           (held[GLFW_KEY_LEFT_CONTROL] || held[GLFW_KEY_RIGHT_CONTROL] ? LSF_CONTROL : 0u) |
           (held[GLFW_KEY_LEFT_ALT] || held[GLFW_KEY_RIGHT_ALT] ? LSF_ALT : 0u);
}

static void forget_frame_before(lsf_window *window)
{
    lsf_input *input = &window->input;
    input->dx = input->dy = input->scroll = 0.0;
    input->key_count = input->dropped_count = 0;
    input->snapshot = NULL;
    input->double_clicked = false;
    window->wheel = 0.0;
    window->character_count = 0;
    for (int i = 0; i < LSF_BUTTON_COUNT; i++)
        input->pressed[i] = input->released[i] = window->just_pressed[i] = false;
}

bool lsf_window_take_input(lsf_window *window, lsf_error *error)
{
    int size[2];
    lsf_input *input = &window->input;
    forget_frame_before(window);
    double now = lsf_now() - window->start;
    input->step = window->replaying ? REPLAY_STEP : now - window->before;
    input->time += input->step;
    window->before = now;
    bool good = true;
    if (window->replaying)
        good = take_replayed(window, error);
    else
        take_waiting(window);
    glfwGetFramebufferSize(window->handle, &size[0], &size[1]);
    if (window->record && input->frame > 0 && size[0] > 0 && size[1] > 0 &&
        ((uint32_t)size[0] != input->width || (uint32_t)size[1] != input->height))
        lsf_event_write(window->record, input->frame,
                        &(lsf_event){.kind = LSF_EVENT_SIZE, .x = size[0], .y = size[1]});
    input->width = size[0] > 0 ? (uint32_t)size[0] : 1;
    input->height = size[1] > 0 ? (uint32_t)size[1] : 1;
    float scale[2];
    glfwGetWindowContentScale(window->handle, &scale[0], &scale[1]);
    input->scale = scale[0] > 0.25f ? scale[0] : 1.0f;
    input->modifiers = modifiers_held(input->held);
    input->dropped = window->dropped;
    return good;
}

void lsf_window_hide_taken(lsf_window *window)
{
    lsf_input *input = &window->input;
    bool cursor = lsf_ui_takes_cursor();
    for (int i = 0; i < LSF_BUTTON_COUNT; i++) {
        input->pressed[i] = input->pressed[i] && !cursor;
        /* Also in the frame in which the button is released: the cursor may have moved in it. */
        bool held = window->button[i] || input->released[i];
        input->down[i] = (input->down[i] && held) || input->pressed[i];
    }
    input->double_clicked = input->double_clicked && !cursor;
    input->scroll = cursor ? 0.0 : window->wheel;
    if (lsf_ui_takes_keys())
        input->key_count = 0;
}
