/* Input of the sandbox's window: for the shader, the clock and the camera. */
#include "easel/app.h"

#include "base/base.h"
#include "window/reach.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* JavaScript's code of a key, by which Shadertoy knows it; 0: it has none. */
static int script_code(int key)
{
    static const struct {
        int key, code;
    } others[] = {{LSF_KEY_ESCAPE, 27},
                  {LSF_KEY_ENTER, 13},
                  {LSF_KEY_TAB, 9},
                  {LSF_KEY_BACKSPACE, 8},
                  {LSF_KEY_DELETE, 46},
                  {LSF_KEY_RIGHT, 39},
                  {LSF_KEY_LEFT, 37},
                  {LSF_KEY_DOWN, 40},
                  {LSF_KEY_UP, 38},
                  {LSF_KEY_PAGE_UP, 33},
                  {LSF_KEY_PAGE_DOWN, 34},
                  {LSF_KEY_HOME, 36},
                  {LSF_KEY_END, 35},
                  {340, 16},
                  {344, 16},
                  {341, 17},
                  {345, 17},
                  {342, 18},
                  {346, 18}};
    if ((key >= 'A' && key <= 'Z') || (key >= '0' && key <= '9') || key == ' ')
        return key;
    if (key >= LSF_KEY_F1 && key <= LSF_KEY_F12)
        return 112 + key - LSF_KEY_F1;
    if (key >= LSF_KEY_PAD_0 && key <= LSF_KEY_PAD_0 + 9)
        return 96 + key - LSF_KEY_PAD_0;
    for (size_t i = 0; i < LSF_COUNT(others); i++)
        if (others[i].key == key)
            return others[i].code;
    return 0;
}

static void follow_keys(lsf_easel *easel)
{
    bool down[LSF_SANDBOX_KEYS] = {false};
    for (int key = 0; key < LSF_KEY_LIMIT; key++)
        if (easel->input->held[key] && script_code(key) > 0)
            down[script_code(key)] = true;
    for (int code = 0; code < LSF_SANDBOX_KEYS; code++) {
        if (down[code] && !easel->keys[0][code]) {
            easel->keys[1][code] = 1; /* until a request has told it */
            easel->keys[2][code] ^= 1;
            easel->dirty = true;
        }
        easel->keys[0][code] = down[code];
    }
}

/* Shadertoy's conventions: where the button is held; where it went down, negative once it is up, in
 * z, and but in the frame in which it went down in w. */
static void follow_mouse(lsf_easel *easel)
{
    const lsf_input *input = easel->input;
    float scale = 1.0f / (float)easel->reduction, *m = easel->mouse;
    bool down = input->down[LSF_BUTTON_LEFT];
    const float position[2] = {(float)input->x * scale,
                               ((float)input->height - (float)input->y) * scale};
    if (down) {
        easel->dirty |= m[0] != position[0] || m[1] != position[1] || !easel->was_down;
        memcpy(m, position, sizeof position);
        if (!easel->was_down)
            memcpy(m + 2, position, sizeof position);
    } else if (easel->was_down) {
        m[2] = -m[2];
        easel->dirty = true;
    }
    easel->was_down = down;
}

static void follow_camera(lsf_easel *easel)
{
    const lsf_input *input = easel->input;
    double unit = 1.0 / input->height;
    bool moves = input->dx != 0.0 || input->dy != 0.0;
    if (!easel->has_camera)
        return;
    if (moves && input->down[LSF_BUTTON_RIGHT])
        lsf_viewer_camera_orbit(&easel->camera, input->dx * unit, input->dy * unit);
    else if (moves && input->down[LSF_BUTTON_MIDDLE])
        lsf_viewer_camera_pan(&easel->camera, input->dx * unit, input->dy * unit);
    else if (input->scroll != 0.0)
        lsf_viewer_camera_zoom(&easel->camera, input->scroll);
    else
        return;
    easel->dirty = true;
}

void lsf_easel_restart(lsf_easel *easel)
{
    easel->time = easel->time_of_last = 0.0;
    easel->number = 0;
    easel->restart = easel->dirty = true;
}

static void take_shot(lsf_easel *easel)
{
    char path[40];
    do
        snprintf(path, sizeof path, "lightsheaf-%04u.png", ++easel->shots);
    while (access(path, F_OK) == 0 && easel->shots < 9999);
    lsf_window_capture(easel->window, path);
}

static void toggle_panels(lsf_easel *easel)
{
    easel->panels = !easel->panels;
}

static void toggle_play(lsf_easel *easel)
{
    easel->playing = !easel->playing;
}

static void step(lsf_easel *easel)
{
    easel->step = true;
}

static void toggle_full_screen(lsf_easel *easel)
{
    lsf_window_toggle_full_screen(easel->window);
}

static const struct {
    const char *name;
    int key;
    void (*act)(lsf_easel *easel);
} keys[] = {{"Tab", LSF_KEY_TAB, toggle_panels},      {"F5", LSF_KEY_F5, lsf_easel_restart},
            {"F6", LSF_KEY_F5 + 1, toggle_play},      {"F7", LSF_KEY_F5 + 2, step},
            {"F11", LSF_KEY_F11, toggle_full_screen}, {"F12", LSF_KEY_F12, take_shot}};

void lsf_easel_list_keys(void)
{
    for (size_t i = 0; i < LSF_COUNT(keys); i++)
        lsf_reach_key(i, keys[i].name, false);
}

void lsf_easel_handle(lsf_easel *easel)
{
    for (size_t i = 0; i < LSF_COUNT(keys); i++)
        if (lsf_input_key(easel->input, keys[i].key, 0)) {
            keys[i].act(easel);
            lsf_reach_key(i, keys[i].name, true);
        }
    follow_keys(easel);
    follow_mouse(easel);
    follow_camera(easel);
}
